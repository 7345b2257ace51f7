# Median errors and time of OpenGV's solvers, by the focal length that they are given, beside HybridGV's.
data = folder . "/opengv_solvers.csv"
stats data using (strcol(1) eq "" ? NaN : 1) nooutput
methods = STATS_records
eval "set terminal " . terminal(1100, 60 + 20 * methods)
set output output("opengv_solvers")
set multiplot layout 1, 3 title "Solvers on scenes without outliers, medians; focal length true, guessed, estimated by HybridGV, or unknown" margins 0.17, 0.98, 0.08, 0.95 spacing 0.02, 0
set style fill solid 0.6
set logscale x
set grid noytics xtics
set yrange [-methods + 0.4:0.6]
set key off
colour(focalLength) = focalLength eq "unknown" ? 6 : focalLength eq "true" ? 3 : focalLength eq "guess" ? 5 : 2
least = "0.01 0.01 1"
do for [i = 1:3] {
  set xlabel i == 1 ? "rotation error [deg]" : i == 2 ? "position error [units; cube side 10]" : "time of a call [microseconds]"
  if (i > 1) { set ytics textcolor rgb "#ff000000" }
  value = i == 1 ? 6 : i == 2 ? 7 : 9
  x0 = word(least, i) + 0
  set xrange [x0:*]
  plot data using (x0):(-$0):(x0):value:(-$0 - 0.35):(-$0 + 0.35):(colour(strcol(3))):ytic(strcol(2) . ", " . strcol(3)) with boxxyerror lc variable
}
unset multiplot
