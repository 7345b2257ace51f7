# Errors of focal length and position of images that the map lacks, by kind of map and method; bars from the median to the 90 % quantile.
data = folder . "/real_photos.csv"
methods = "'colmap image_registrator' 'hybridgv image_registrator' 'hybrid; verified matches' '2D-3D only; verified matches' 'hybrid; raw matches' '2D-3D only; raw matches'"
# number of the map, its name, median, 90 % quantile
rows(method, column) = sprintf("< awk -F, '/^#/ || /^set,/ { next } $1 $2 != last { last = $1 $2; ++n } BEGIN { print \"n,map,a,b\" } $3 == \"%s\" { print n \",\" $1 \" \" $2 \",\" $%d \",\" $%d }' %s", method, column, column + 1, data)
kinds = int(system(sprintf("awk -F, '!/^#/ && !/^set,/ && $1 $2 != last { last = $1 $2; ++n } END { print n }' %s", data)))
eval "set terminal " . terminal(1000, 440)
set output output("real_photos")
set multiplot layout 1, 2 title "Images that the map lacks: median to 90 % quantile of the error"
set logscale y
set xrange [0.5:kinds + 0.5]
set xtics rotate by -35
set key top right font ",8"
set offsets 0, 0, graph 0.25, 0
set bars 0
do for [column in "7 11"] {
  set ylabel column eq "7" ? "focal length [%]" : "position [% of the depth]"
  plot rows(word(methods, 3), int(column)) using 1:3:xtic(2) with dots lc rgb "white" notitle, \
       for [m = 1:6] rows(word(methods, m), int(column)) using ($1 + 0.13 * (m - 3.5)):3:3:4 \
         with yerrorbars lt m pt 7 ps 0.7 title word(methods, m)
  unset key
}
unset multiplot
