# The end of the runs along the first section: soil and water surface and slip line by spacing, and differences from the finest.
load "common.gp"
n = words(spacings)
profiles(dp) = out."/dp".dp."/profiles.csv"
section = word(column_words(profiles(word(spacings, 1)), "1", 1), 1)
# Rows of the last time; times differ a little from run to run.
final(dp) = sprintf("< awk -F, '!/^#/ && ++n > 1 && $1 == \"%s\" {if ($2 != t) {t = $2; m = 0}; row[++m] = $0} END {for (k = 1; k <= m; ++k) print row[k]}' '%s'", \
  section, profiles(dp))
finest = word(spacings, n)
# Beside each station of a run the elevation of the finest there, linear between its stations. Columns: distance, difference.
difference(dp, column) = sprintf("< awk -F, -v c=%d '!/^#/ && $1 == \"%s\" {if (FILENAME != f) {f = FILENAME; ++which; t = \"\"}; " \
  ."if ($2 != t) {t = $2; m[which] = 0}; k = ++m[which]; d[which, k] = $3; z[which, k] = $c} END {j = 1; for (k = 1; k <= m[2]; ++k) { " \
  ."x = d[2, k]; while (j < m[1] - 1 && d[1, j + 1] < x) ++j; if (z[2, k] == \"nan\" || z[1, j] == \"nan\" || z[1, j + 1] == \"nan\") {print \"\"; continue}; " \
  ."u = (x - d[1, j]) / (d[1, j + 1] - d[1, j]); print x \",\" z[2, k] - z[1, j] - u * (z[1, j + 1] - z[1, j])}}' '%s' '%s'", \
  column, section, profiles(finest), profiles(dp))
stats rows(profiles(finest)) using 3 nooutput; set xrange [0:STATS_max]
eval canvas(1500, 1000)
set multiplot title case.": section ".section." at the end by particle spacing" font ",17"
set lmargin at screen 0.06; set rmargin at screen 0.985
set tmargin at screen 0.93; set bmargin at screen 0.37; set format x ""; set ylabel "elevation (m)" offset 1; set key top right
plot final(finest) using 3:7 with lines lc rgb "#505050" lw 1.5 title "bed", final(finest) using 3:6 with lines lc rgb "#505050" dt 3 title "ground before", \
  for [k = 1:n] final(word(spacings, k)) using 3:8 with lines lw 2 lc rgb line_colour(k) title "soil, dp ".word(spacings, k)." m", \
  for [k = 1:n] final(word(spacings, k)) using 3:9 with lines lw 2 dt 4 lc rgb line_colour(k) title "water", \
  for [k = 1:n] final(word(spacings, k)) using 3:10 with lines lw 1.2 dt 2 lc rgb line_colour(k) title (k == n ? "slip line" : "")
set tmargin at screen 0.34; set bmargin at screen 0.07; set format x "%g"; set xlabel "distance along section (m)" offset 0, 0.4
set ylabel "less the finest (m)"; set xzeroaxis lc rgb "#808080"; set key top right
plot for [k = 1:n - 1] difference(word(spacings, k), 8) using 1:2 with lines lw 2 lc rgb line_colour(k) title "soil, dp ".word(spacings, k)." m", \
  for [k = 1:n - 1] difference(word(spacings, k), 9) using 1:2 with lines lw 2 dt 4 lc rgb line_colour(k) title "water"
unset multiplot
