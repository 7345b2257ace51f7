# How many queries are localized with a known focal length, without it, and where it is set right afterwards, over the outliers; a panel
# for each number of matches.
data = folder . "/known_focal_length.csv"
kinds = "'known' 'unknown' 'set afterwards'"
noise = "1"
# The rows of one curve, behind the names of the columns.
rows(kind, matches) = sprintf("< awk -F, '/^focal_length/ || ($1 == \"%s\" && $2 == \"%s\" && $3 == \"%s\")' %s", kind, matches, noise, data)
eval "set terminal " . terminal(1300, 400)
set output output("known_focal_length")
set multiplot layout 1, 4 title "Queries localized with a known focal length and without it; noise of the 3D points 1 % of the depth"
set xrange [0:75]
set yrange [0:105]
set xlabel "outliers [%]"
set ylabel "within 5 degrees and 20 % of focal length [%]"
set key bottom left
do for [matches in "200 20 12 8"] {
  set title sprintf("%s matches of each kind", matches)
  plot for [k = 1:3] rows(word(kinds, k), matches) using 4:5 with linespoints lt word("3 4 1", k) + 0 pt (word("7 5 9", k) + 0) title word(kinds, k)
  set key off
}
unset multiplot
