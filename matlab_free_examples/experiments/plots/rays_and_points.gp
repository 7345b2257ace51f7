# Median error of the focal length by rays alone, points alone and both, over the number of matches; a panel for each share of outliers.
data = folder . "/rays_and_points.csv"
# The rows of one curve, behind the names of the columns.
rows(kinds, outliers, noise) = sprintf("< awk -F, '/^kinds/ || ($1 == \"%s\" && $3 == \"%s\" && $4 == \"%s\")' %s", kinds, outliers, noise, data)
eval "set terminal " . terminal(1300, 420)
set output output("rays_and_points")
set multiplot layout 1, 4 title "Error of the focal length by rays alone, points alone and both; noise of the 3D points in % of the depth"
set logscale xy
set xrange [8:600]
set xtics (10, 20, 50, 100, 200, 500)
set yrange [0.1:100]
set xlabel "matches of each kind"
set ylabel "median error of the focal length [%]"
set key top right
finite(x) = x < 1e9 ? x : NaN
do for [outliers in "0 30 50 70"] {
  set title sprintf("%s %% outliers", outliers)
  plot rows("rays", outliers, "0") using 2:(finite($8)) with linespoints lt 2 pt 7 title "rays alone", \
       for [i = 1:3] rows("points", outliers, word("0 0.5 1.5", i)) using 2:(finite($8)) with linespoints lt 3 + i pt 5 \
         title sprintf("points alone, %s %%", word("0 0.5 1.5", i)), \
       rows("both", outliers, "0.5") using 2:(finite($8)) with linespoints lt 3 pt 9 title "both, 0.5 %"
  set key off
}
unset multiplot
