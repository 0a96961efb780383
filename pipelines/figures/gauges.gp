# Surface at each gauge against time: a panel a gauge, with its peak and arrival.
load "common.gp"
series = out."/gauges.csv"; peaks = out."/peaks.csv"
names = column_words(peaks, "1", 1)
n = words(names)
peak(name, column) = system(sprintf("awk -F, '$1 == \"%s\" {v = $%d} END {print v}' '%s'", name, column, peaks)) + 0
on_soil(name) = system(sprintf("awk -F, '$1 == \"%s\" {print $2}' '%s'", name, peaks)) eq "soil"
number(v, unit) = v == v ? sprintf("%.3g %s", v, unit) : "none"

stats rows(series) using 1 nooutput; t_max = STATS_max
# Gauges on water share a scale, so that the wave is seen to spread; those on soil have theirs.
eval canvas(1100, 110 + 135 * n)
set multiplot
set title case.": change of the surface at the gauges (water: above still level; soil: since the start)"
set lmargin at screen 0.09; set rmargin at screen 0.80
set xrange [0:t_max]; set ylabel "m" offset 1
set xzeroaxis lc rgb "#808080" lw 1
unset key
bottom = 68.0 / (110 + 135 * n); top = 1 - 40.0 / (110 + 135 * n)
do for [i = 1:n] {
  name = word(names, i)
  set tmargin at screen top - (i - 1) * (top - bottom) / n - 0.004
  set bmargin at screen top - i * (top - bottom) / n + 0.004
  if (i == n) { set format x "%g"; set xlabel "time (s)" } else { set format x ""; unset xlabel }
  unset label; unset arrow
  kind = on_soil(name) ? "soil" : "water"
  set yrange [*:*]  # stats minds it
  stats rows(series) using (strcol(3) eq kind ? $5 : NaN) nooutput
  pad = STATS_max > STATS_min ? 0.1 * (STATS_max - STATS_min) : 1
  set yrange [STATS_min - pad : STATS_max + pad]; set ytics tic_step(STATS_max - STATS_min, 4)
  arrival = peak(name, 10)
  set label name at graph 1.02, 0.82 font ",15"
  set label kind." surface" at graph 1.02, 0.56 font ",11" tc rgb "#606060"
  set label "highest ".number(peak(name, 6), "m") at graph 1.02, 0.34 font ",11"
  set label "arrival ".number(arrival, "s") at graph 1.02, 0.14 font ",11"
  if (arrival == arrival) { set arrow from arrival, graph 0 to arrival, graph 1 nohead lc rgb red dt 2 }
  plot rows(series) using 1:(strcol(2) eq name ? $5 : NaN) with lines lw 2 lc rgb (kind eq "soil" ? brown : blue)
  unset title
}
unset multiplot
