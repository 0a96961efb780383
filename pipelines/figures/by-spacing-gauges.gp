# Surface at each gauge against time, a panel a gauge, a line a spacing.
load "common.gp"
finest = out."/dp".word(spacings, words(spacings))
peaks = finest."/peaks.csv"; names = column_words(peaks, "1", 1)
columns = 3; down = int((words(names) + columns - 1) / columns)
eval canvas(1500, 120 + 230 * down)
series(dp) = out."/dp".dp."/gauges.csv"
stats rows(series(word(spacings, 1))) using 1 nooutput; set xrange [0:STATS_max]
set multiplot layout down, columns title case.": change of the surface at the gauges by particle spacing" font ",17" \
  margins 0.05, 0.985, 55.0 / (120 + 230 * down), 1 - 85.0 / (120 + 230 * down) spacing 0.045, 0.035
set xzeroaxis lc rgb "#808080" lw 1
do for [i = 1:words(names)] {
  name = word(names, i)
  if (i > words(names) - columns) { set xlabel "time (s)" offset 0, 0.4; set format x "%g" } else { unset xlabel; set format x "" }
  if (i % columns == 1) { set ylabel "m" offset 1 } else { unset ylabel }
  if (i == 1) { set key at screen 0.5, screen 1 - 58.0 / (120 + 230 * down) center center horizontal width 2 } else { unset key }
  set label 1 name at graph 0.03, 0.9 font ",14"
  plot for [k = 1:words(spacings)] rows(series(word(spacings, k))) using 1:(strcol(2) eq name ? $5 : NaN) with lines \
    lw (k == words(spacings) ? 2.2 : 1.4) lc rgb line_colour(k) title "dp ".word(spacings, k)." m"
}
unset multiplot
