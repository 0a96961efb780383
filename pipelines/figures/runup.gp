# Run-up on the opposite bank against time, a line a section.
load "common.gp"
eval canvas(1000, 480)
table = out."/runup.csv"
set title case.": run-up on the opposite bank"
set xlabel "time (s)"; set ylabel "water's edge above still level (m)"
stats rows(table) using 1 nooutput; set xrange [0:STATS_max]; set offsets 0, 0, graph 0.08, graph 0.05
set key top left; set xzeroaxis lc rgb "#808080" lw 1
header = system("awk '!/^#/ {gsub(\",\", \" \"); print; exit}' '".table."'")
plot for [i = 3:words(header):2] rows(table) using 1:i with lines lw 2.5 lc rgb (i == 3 ? blue : i == 5 ? red : brown) \
  title "section ".substr(word(header, i), 1, strlen(word(header, i)) - strlen("_height_m"))
