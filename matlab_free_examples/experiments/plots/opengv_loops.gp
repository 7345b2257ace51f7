# Median errors and times of RANSAC loops by the share of outliers.
data = folder . "/opengv_loops.csv"
outliers = "0 30 50"
stats data using (strcol(4) eq word(outliers, 1) ? 1 : NaN) nooutput
methods = STATS_records
eval "set terminal " . terminal(1200, 120 + 20 * methods)
set output output("opengv_loops")
set multiplot layout 1, 3 title "RANSAC loops, medians by share of outliers; focal length true, guessed, estimated by HybridGV, or unknown" margins 0.17, 0.98, 0.1, 0.86 spacing 0.02, 0
set style fill solid 0.6
set logscale x
set grid noytics xtics
set yrange [-methods + 0.4:0.6]
set key at screen 0.5, screen 0.92 center horizontal maxrows 1 width -2
least = "0.05 0.05 0.1"
do for [i = 1:3] {
  set xlabel i == 1 ? "rotation error [deg]" : i == 2 ? "position error [units; cube side 10]" : "time [ms]"
  if (i > 1) { set ytics textcolor rgb "#ff000000" }
  value = i == 1 ? 6 : i == 2 ? 7 : 9
  x0 = word(least, i) + 0
  set xrange [x0:*]
  plot for [k = 1:3] data every ::(k - 1) * methods::k * methods - 1 \
    using (x0):(-$0):(x0):(column(value) / (i == 3 ? 1000 : 1)):(-$0 + 0.4 - 0.27 * k):(-$0 + 0.67 - 0.27 * k):ytic(strcol(2) . ", " . strcol(3)) \
    with boxxyerror lt word("1 4 5", k) + 0 title word(outliers, k) . " % outliers"
  set key off
}
unset multiplot
