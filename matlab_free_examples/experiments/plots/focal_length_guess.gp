# P3P at a guess of the focal length beside P4Pf: means over all scenes of one share of outliers, or of one field of view.
data = folder . "/focal_length_guess.csv"
searches = "'P3P at a guess' 'P4Pf'"
# Means of the share localized [%] and of the time [ms] for each value of a column.
means(search, column) = sprintf("< awk -F, 'BEGIN { print \"value,good,milliseconds\" } $7 == \"%s\" { n[$%d]++; good[$%d] += $8; time[$%d] += $12 } " \
  . "END { for (value in n) print value \",\" good[value] / n[value] \",\" time[value] / n[value] / 1000 }' %s | sort -t, -k1,1g", \
  search, column, column, column, data)
eval "set terminal " . terminal(1300, 400)
set output output("focal_length_guess")
set multiplot layout 1, 4 title "P3P at a guess of the focal length beside P4Pf; means over all other conditions"
set key bottom left
do for [panel = 1:4] {
  column = panel <= 2 ? 6 : 1
  set xlabel panel <= 2 ? "outliers [%]" : "field of view [degrees]"
  set ylabel panel % 2 == 1 ? "within 5 degrees and 20 % of focal length [%]" : "mean of the median times [ms]"
  if (panel % 2 == 1) { set yrange [0:105] } else { set yrange [0:*] }
  plot for [k = 1:2] means(word(searches, k), column) using 1:(panel % 2 == 1 ? $2 : $3) with linespoints lt word("3 4", k) + 0 pt (word("7 5", k) + 0) title word(searches, k)
  set key off
}
unset multiplot
