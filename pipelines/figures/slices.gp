# Particles in a slice along the first section at several times: strain of the soil, speed of the water.
load "common.gp"
table = out."/slices.csv"; profiles = out."/profiles.csv"
section = word(column_words(table, "1", 1), 1)
times = column_words(table, "$1 == \"".section."\"", 2)
columns = 2; down = int((words(times) + columns - 1) / columns)
in_section = "$1 == \"".section."\""
line = sprintf("< awk -F, '!/^#/ && ++n > 1 && %s' '%s'", in_section, profiles)
slice(t, phase) = sprintf("< awk -F, '!/^#/ && ++n > 1 && %s && $2 == \"%s\" && $5 == \"%s\"' '%s'", in_section, t, phase, table)
# Frames of the profiles have the same times as those of the slices.
bed(t) = sprintf("< awk -F, '!/^#/ && ++n > 1 && %s && $2 == \"%s\"' '%s'", in_section, t, profiles)
stats line using 3 nooutput; length = STATS_max
stats line using 7 nooutput; low = STATS_min
stats line using 6 nooutput; high = STATS_max
fastest = system(sprintf("awk -F, '!/^#/ && $5 == \"water\" && $6 + 0 > m {m = $6 + 0} END {print m + 0}' '%s'", table)) + 0
top = fastest > 0 ? nice(fastest / 2) * 2 : 1
strain_top = 2.0
set xrange [0:length]; set yrange [low - 0.05 * (high - low) : high + 0.05 * (high - low)]
# Smaller dots where there are more of them.
most = system(sprintf("awk -F, '!/^#/ {n[$2]++} END {for (t in n) if (n[t] > m) m = n[t]; print m + 0}' '%s'", table)) + 0
dot = most > 20000 ? 0.15 : most > 4000 ? 0.3 : most > 1000 ? 0.55 : 0.9
# Both scales in one palette: strain in [0, 1], speed in [2, 3].
set palette defined (0 "#f2e6d5", 0.1 "#e2b277", 0.5 "#b0521c", 1 "#5a0f0f", 1.001 "#ffffff", 1.999 "#ffffff", 2 "#dcebf7", 2.4 "#6baed6", 2.8 "#08519c", 3 "#3f007d")
set cbrange [0:3]; unset colorbox
clip(v) = v < 0 ? 0 : v > 1 ? 1 : v
height = 150 + 330 * down
eval canvas(1500, height)
set multiplot layout down, columns title sprintf("%s: section %s; accumulated plastic strain of the soil (0 light, %g and more dark), speed of the water (0 light, %g m/s dark)", case, section, strain_top, top) \
  font ",14" margins 0.055, 0.985, 55.0 / height, 1 - 60.0 / height spacing 0.045, 0.045
do for [k = 1:words(times)] {
  t = word(times, k)
  if (k > words(times) - columns) { set xlabel "distance along section (m)" offset 0, 0.4 } else { unset xlabel }
  if (k % columns == 1) { set ylabel "elevation (m)" offset 1 } else { unset ylabel }
  set label 1 sprintf(real(t) >= 10 ? "%.0f s" : "%.2g s", real(t)) at graph 0.5, 0.92 center font ",15"
  plot bed(t) using 3:7 with lines lc rgb "#505050" lw 1.5 notitle, \
    slice(t, "water") using 3:4:(2 + clip($6 / top)) with points pt 7 ps dot palette notitle, \
    slice(t, "soil") using 3:4:(clip($7 / strain_top)) with points pt 7 ps dot palette notitle
}
unset multiplot
