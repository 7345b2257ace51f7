# Median error of the focal length over the distortion, for lenses of two models.
data = folder . "/distortion_strength.csv"
cameras = "pinhole free selected"
# The rows of one curve, behind the names of the columns.
rows(lens, camera) = sprintf("< awk -F, '/^lens/ || ($1 == \"%s\" && $3 == \"%s\")' %s", lens, camera, data)
eval "set terminal " . terminal(1000, 420)
set output output("distortion_strength")
set multiplot layout 1, 2 title "Error of the focal length over the lens distortion; 30 % outliers"
set logscale y
set yrange [0.03:20]
set ylabel "median error of the focal length [%]"
set key top right
do for [lens in "SIMPLE_RADIAL division"] {
  set title lens
  set xlabel lens eq "division" ? "distortion [1 / (half diagonal)^2]" : "k1"
  plot for [c = 1:3] rows(lens, word(cameras, c)) using 2:5 with linespoints lt c + 2 pt 7 title word(cameras, c)
}
unset multiplot
