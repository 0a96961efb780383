# Run-up along the shores at rest: a panel a shore, the longest ones.
load "common.gp"
set datafile separator whitespace
table = work."/shore-runup.txt"  # shore, distance, run-up
shores = system(sprintf("awk '{if ($2 > far[$1]) far[$1] = $2} END {for (s in far) print far[s], s}' '%s' | sort -rn | head -n 4 | awk '{print $2}' | sort -n", table))
n = words(shores)
eval canvas(1100, 80 + 250 * n)
set multiplot layout n, 1 title case.": highest run-up along the shores" font ",16"
set ylabel "run-up above\nstill level (m)"; set xlabel "distance along the shore (m)" offset 0, 0.5
stats table using 3 nooutput
set autoscale xfix; set yrange [0:(STATS_max > 0 ? 1.1 * STATS_max : 1)]; unset key; set lmargin 11; set rmargin 3
do for [s in shores] {
  set label 1 "shore ".s at graph 0.01, 0.9 font ",14"
  plot table using ($1 == real(s) ? $2 : NaN):3 with filledcurves y1=0 fc rgb pale_blue, table using ($1 == real(s) ? $2 : NaN):3 with lines lw 2 lc rgb blue
}
unset multiplot
