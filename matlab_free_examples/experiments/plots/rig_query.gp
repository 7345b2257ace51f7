# A query rig of three calibrated cameras, by the number of matches per camera.
data = folder . "/rig_query.csv"
eval "set terminal " . terminal(860, 360)
set output output("rig_query")
set multiplot layout 1, 2 title "Query rig: OpenGV's gp3p with all of its cameras, HybridGV with one of unknown focal length" margins 0.08, 0.99, 0.14, 0.9 spacing 0.1, 0.05
# The three rows of every number of matches.
methods = "'gp3p, 3 cameras, focal length known' 'hybridRansac, 1 camera, 2D-3D' 'hybridRansac, 1 camera, 2D-3D and 2D-2D'"
set xlabel "matches of each kind and query camera"
set logscale x
set xrange [4:75]
set xtics (5, 10, 20, 60)
set key bottom right
do for [i = 1:2] {
  set ylabel i == 1 ? "successes [%]" : "position error [units; cube side 10], median"
  if (i == 1) { set yrange [0:105] } else { set yrange [0:*] }
  plot for [k = 1:3] data every 3::k - 1 using 5:(i == 1 ? $6 : ($8 < 1e9 ? $8 : NaN)) with linespoints lt word("1 2 6", k) + 0 lw 2 pt 7 title word(methods, k)
  set key off
}
unset multiplot
