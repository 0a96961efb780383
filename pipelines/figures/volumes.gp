# Slide volume, volume that entered the water, and speeds of the slide against time.
load "common.gp"
table = out."/slide.csv"
eval canvas(1000, 760)
stats rows(table) using 2 nooutput
unit = STATS_max >= 1e5 ? 1e6 : 1; unit_name = unit > 1 ? "million m\302\263" : "m\302\263"
set multiplot layout 2, 1
stats rows(table) using 1 nooutput; set xrange [0:STATS_max]; set yrange [0:*]; set lmargin 10; set rmargin 3
set title case.": the slide"
set ylabel "volume (".unit_name.")"; set key bottom right
plot rows(table) using 1:($2 / unit) with lines lw 2.5 lc rgb brown title "moving or moved", \
     rows(table) using 1:($3 / unit) with lines lw 2.5 lc rgb blue title "entered the water"
unset title; set xlabel "time (s)"; set ylabel "speed (m/s)"; set key top right
# The line of zeros: a slide that has not moved has no speed, and gnuplot refuses to draw nothing.
plot 0 with lines lc rgb "#404040" notitle, \
     rows(table) using 1:7 with lines lw 2.5 lc rgb red title "fastest part (99th percentile)", \
     rows(table) using 1:6 with lines lw 2.5 lc rgb brown title "mean"
unset multiplot
