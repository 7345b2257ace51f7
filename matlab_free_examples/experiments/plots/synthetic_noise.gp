# Box plots of synthetic_noise.csv: box = quartiles, black line = median, whiskers = 5 % and 95 %. What is cut off at the upper
# edge has no solution or a useless one.
data = folder . "/synthetic_noise.csv"
solvers = "P4Pf P3.5Pf H13f H32f H51f[1] H51f[5]"
errors = "rotation_deg position focal_percent"
label(i) = i == 1 ? "rotation error [deg]" : i == 2 ? "position error [units; cube side 10]" : "focal length error [%]"
bottom(i) = i == 1 ? 0.1 : i == 2 ? 0.05 : 0.5
top(i) = i == 1 ? 180 : i == 2 ? 100 : 1000

set style fill solid 0.35 border -1
set boxwidth 0.11
set logscale y
set xrange [-0.5:5.5]
cut(y, i) = y < top(i) ? y : top(i)
x(series, motion, s, i) = strcol(1) eq series && strcol(2) eq motion && strcol(6) eq word(solvers, s) && strcol(7) eq word(errors, i) ? $3 + 0.14 * (s - 3.5) : NaN

# The levels of the noise, column 4 (3D points) or 5 (images), under the boxes.
levels(series, column) = system(sprintf("awk -F, '$1 == \"%s\" && $2 == \"random\" { print $%d }' %s | uniq", series, column, data))
showLevels = 'set xtics (); do for [l = 1:words(names)] { set xtics add (word(names, l) l - 1) }'

boxes = 'set yrange [bottom(i):top(i)]; set ylabel label(i) offset 1.5; \
  plot for [s = 1:6] data using (x(series, motion, s, i)):(cut($11, i)):(cut($10, i)):(cut($14, i)):(cut($13, i)) with candlesticks lt s title word(solvers, s) whiskerbars 0.5, \
    for [s = 1:6] data using (x(series, motion, s, i)):(cut($12, i)):(cut($12, i)):(cut($12, i)):(cut($12, i)) with candlesticks lt -1 lw 2 notitle'

eval "set terminal " . terminal(1500, 1000)
set output output("synthetic_noise3d")
series = "noise3d"
names = levels(series, 4)
eval showLevels
set multiplot layout 3, 3 title "Errors of minimal solvers over the noise of the 3D points; image noise 2 px" margins 0.05, 0.99, 0.08, 0.9 spacing 0.045, 0.06
do for [i = 1:3] {
  do for [motion in "random forward sideways"] {
    if (i == 1) { set title motion . " motion" } else { unset title }
    if (i == 3) { set xlabel "standard deviation of the 3D points [% of their depth]" } else { unset xlabel }
    if (i == 1 && motion eq "random") { set key at screen 0.5, screen 0.945 center horizontal maxrows 1 } else { set key off }
    eval boxes
  }
}
unset multiplot

eval "set terminal " . terminal(1500, 420)
set output output("synthetic_image_noise")
series = "image_noise"
motion = "random"
names = levels(series, 5)
eval showLevels
set multiplot layout 1, 3 title "Errors of minimal solvers over the image noise; noise of the 3D points 1 % of their depth, random motion" margins 0.05, 0.99, 0.13, 0.84 spacing 0.045, 0.06
unset title
set xlabel "standard deviation of the image points [px]"
do for [i = 1:3] {
  if (i == 1) { set key at screen 0.5, screen 0.9 center horizontal maxrows 1 } else { set key off }
  eval boxes
}
unset multiplot
