# Time per call of every minimal solver.
data = folder . "/solver_table.csv"
eval "set terminal " . terminal(1000, 480)
set output output("solver_table")
set title "Minimal solvers: time per call, one thread (box: median, line: least of the passes)"
set ylabel "microseconds per call"
set logscale y
set yrange [0.3:1000]
set style fill solid 0.6
set boxwidth 0.7
set xtics rotate by -35
set rmargin 8
set key off
plot data using 0:8:xtic(strcol(1) . " " . (strcol(2) eq "-" ? "" : strcol(2))) with boxes lt 6, \
     data using 0:8:(sprintf("%.3g", $8)) with labels offset 0, 0.7, \
     data using ($0 - 0.35):9:(0.7):(0) with vectors nohead lt -1 lw 1.5
