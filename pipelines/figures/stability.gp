# The stability matrix: a row an axis and scene, a box a value; three marks in it for 2-D, finer 2-D and 3-D.
# data: a shell command that prints the blocks of stability/marks.jq.
set datafile separator "\t"
stats data index 3 using 1 nooutput
rows = STATS_max + 1
set terminal pngcairo size 2000, 60 + 24 * rows font "sans,10"
set yrange [rows - 0.4:-1.2]
set xrange [-0.7:7.7]
unset border; unset xtics
set ytics scale 0
set lmargin 40; set tmargin 3; set bmargin 1
set title "Stability: 2-D, finer 2-D, 3-D of each value. Green: passes; red: breaks a criterion; grey: refused, as it should be" font "sans,12"
colour(k) = k == 1 ? 0x2e8b57 : (k == 2 ? 0xc0392b : 0x9e9e9e)
plot for [k=0:2] data index k using ($1 - 0.3 + 0.07 * k):2:(colour($3)) with points pt 5 ps 1.3 lc rgb variable notitle, \
     data index 0 using ($1 - 0.1):2:4 with labels left font "sans,9" notitle, \
     data index 3 using (NaN):1:ytic(2) notitle
