# Energy of the whole scene against time, from the diagnostics.
load "common.gp"
table = out."/diagnostics.csv"
set datafile columnheaders
stats table using "time" nooutput; set xrange [0:STATS_max]
first(name) = real(system(sprintf("awk -F, -v name=%s 'NR == 1 {for (k = 1; k <= NF; ++k) if ($k == name) c = k} NR == 2 {print $c; exit}' '%s'", name, table)))
potential = first("potential_energy"); total = first("total_energy")
stats table using (abs(potential - column("potential_energy"))) nooutput
unit = 1000 ** int(STATS_max > 0 ? log10(STATS_max) / 3 : 0)
name = unit >= 1e15 ? "PJ" : unit >= 1e12 ? "TJ" : unit >= 1e9 ? "GJ" : unit >= 1e6 ? "MJ" : unit >= 1e3 ? "kJ" : "J"
unit = unit > 1e15 ? 1e15 : unit
eval canvas(1000, 480)
set title case.": energy"; set xlabel "time (s)"; set ylabel "energy (".name.")"
set key outside bottom center horizontal; set autoscale ymin; set autoscale yfixmin; set offsets 0, 0, graph 0.05, 0
plot table using "time":((potential - column("potential_energy")) / unit) with lines lw 2.5 lc rgb brown title "potential, released", \
     table using "time":(column("kinetic_energy") / unit) with lines lw 2.5 lc rgb blue title "kinetic", \
     table using "time":((total - column("total_energy")) / unit) with lines lw 2.5 lc rgb grey title "lost (friction, breaking, sides)"
