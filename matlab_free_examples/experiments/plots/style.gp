# What all pictures share. Set before: `format` (svg or png), `folder` (of the CSV files and the pictures).
set datafile separator ","
set datafile columnheaders
set encoding utf8
colours = "#7f7f7f #17becf #2ca02c #ff7f0e #d62728 #1f77b4 #9467bd"
do for [c = 1:words(colours)] { set linetype c lc rgb word(colours, c) }
set grid ytics back lt 1 lc rgb "#dddddd"
set border 3
set tics nomirror out
output(name) = sprintf("%s/%s.%s", folder, name, format)
terminal(width, height) = format eq "svg" ? sprintf("svg noenhanced size %d,%d font 'sans-serif,11'", width, height) \
                                          : sprintf("pngcairo noenhanced size %d,%d font 'sans-serif,9'", width, height)
