# Histogram of log10 of the relative focal error of noiseless problems.
data = folder . "/synthetic_stability.csv"
solvers = "P4Pf P3.5Pf H13f H32f H51f[1] H51f[5]"
eval "set terminal " . terminal(640, 380)
set output output("synthetic_stability")
set title "Numerical stability: noiseless scenes, random motion"
set xlabel "log10 of the relative error of the focal length (bins of 0.5)"
set ylabel "share of the scenes [%]"
set xrange [-16:1]
set key top right
plot for [s = 1:6] data using ($2 + 0.25):(strcol(1) eq word(solvers, s) ? $3 : NaN) with linespoints lt s pt 7 ps 0.4 lw 2 title word(solvers, s)
