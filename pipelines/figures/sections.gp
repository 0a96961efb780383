# Cross-sections at several times: bed, soil, water, slip line. A block of panels a section, a panel a time.
load "common.gp"
table = out."/profiles.csv"
sections = column_words(table, "1", 1); times = column_words(table, "1", 2)
columns = 2; down = int((words(times) + columns - 1) / columns) * words(sections)
# Columns: section, time, distance, x, y, ground, bed, soil, water, slip.
stats rows(table) using 3 nooutput; length = STATS_max
stats rows(table) using 7 nooutput; low = STATS_min
stats rows(table) using 6 nooutput; high = STATS_max
set xrange [0:length]; set yrange [low - 0.12 * (high - low) : high + 0.06 * (high - low)]
floor_z = low - 0.12 * (high - low)
has(z) = z == z
upper(bed, soil) = has(soil) ? soil : bed

eval canvas(1500, 130 + 340 * down)
set multiplot layout down, columns title case.": cross-sections" font ",17" margins 0.06, 0.985, 60.0 / (130 + 340 * down), \
  1 - 95.0 / (130 + 340 * down) spacing 0.045, 0.055
set tics front; set grid back
do for [s in sections] {
  k = 0
  do for [t in times] {
    k = k + 1
    at(z) = strcol(1) eq s && strcol(2) eq t ? z : NaN
    if (k > words(times) - columns) { set xlabel "distance along section ".s." (m)" offset 0, 0.4 } else { unset xlabel }
    if (k % columns == 1) { set ylabel "elevation (m)" offset 1 } else { unset ylabel }
    if (k == 1) { set key at screen 0.5, screen 1 - 64.0 / (130 + 340 * down) center center horizontal width 2 } else { unset key }
    set label 1 sprintf(real(t) >= 10 ? "%.0f s" : "%.2g s", real(t)) at graph 0.5, 0.92 center font ",15"
    set label 2 s at graph 0.01, 0.06 tc rgb red font ",15" front; set label 3 s."'" at graph 0.99, 0.06 right tc rgb red font ",15" front
    plot rows(table) using 3:(at($9)):(at(upper($7, $8))) with filledcurves fc rgb pale_blue title "water", \
         rows(table) using 3:(at($8)):(at($7)) with filledcurves fc rgb "#d3a97c" title "soil", \
         rows(table) using 3:(at($7)):(floor_z) with filledcurves fc rgb "#d0d0d0" notitle, \
         rows(table) using 3:(at($6)) with lines lc rgb "#505050" dt 3 lw 1.5 title "ground before", \
         rows(table) using 3:(at($7)) with lines lc rgb "#505050" lw 1.5 title "bed", \
         rows(table) using 3:(at($8)) with lines lc rgb brown lw 1.5 notitle, \
         rows(table) using 3:(at($9)) with lines lc rgb blue lw 2 notitle, \
         level with lines lc rgb blue lw 0.8 dt 4 title "still level", \
         rows(table) using 3:(at($10)) with lines lc rgb red lw 2 title "slip line"
  }
}
unset multiplot
