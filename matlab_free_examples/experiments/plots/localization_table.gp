# Share of the images localized within the bounds, by solvers; a panel for each scene.
data = folder . "/localization_table.csv"
scenes = system(sprintf("awk -F, '!/^#/ && $1 != \"scene\" { print $1 }' %s | uniq", data))
eval "set terminal " . terminal(150 + 350 * words(scenes), 420)
set output output("localization_table")
set multiplot layout 1, words(scenes) title "Query images localized within the bounds, by solvers"
set ylabel "share of the images [%]"
set xrange [-0.6:]
set yrange [0:119]
set style fill solid 0.6
set boxwidth 0.38
set xtics rotate by -35
set key top right horizontal
first = 0
do for [scene in scenes] {
  set title scene
  stats data using (strcol(1) eq scene ? 1 : NaN) nooutput
  last = first + STATS_records - 1
  # Rows without and with local optimization take turns.
  plot data every 2::first::last using ($0 - 0.2):6:xtic(3) with boxes lt 1 title "plain", \
       data every 2::first + 1::last using ($0 + 0.2):6 with boxes lt 3 title "optimized"
  first = last + 1
}
unset multiplot
