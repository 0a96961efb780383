# Slide volume, volume that entered the water, speed, and run-up on the opposite bank by spacing, with what was measured.
load "common.gp"
has_runup = int(system("test -e '".out."/dp".word(spacings, 1)."/runup.csv' && echo 1 || echo 0"))
eval canvas(1400, 860)
slide(dp) = out."/dp".dp."/slide.csv"; runup(dp) = out."/dp".dp."/runup.csv"
stats rows(slide(word(spacings, words(spacings)))) using 1 nooutput; set xrange [0:STATS_max]
stats rows(slide(word(spacings, words(spacings)))) using 2 nooutput
unit = STATS_max >= 1e5 ? 1e6 : 1; unit_name = unit > 1 ? "million m\302\263" : "m\302\263"
number(text) = text eq "" ? NaN : real(text)
bound(name, quantity, k, per) = number(measured(reference, name, quantity, k)) / per
set multiplot layout 2, 2 title case.": slide and run-up by particle spacing" font ",17"
set yrange [0:1e-6<*]; set offsets 0, 0, graph 0.06, 0; set key bottom right; set xlabel "time (s)" offset 0, 0.4
set title "moving or moved"; set ylabel unit_name offset 1
plot for [k = 1:words(spacings)] rows(slide(word(spacings, k))) using 1:($2 / unit) with lines lw 2 lc rgb line_colour(k) title "dp ".word(spacings, k)." m", \
  for [k = 4:5] bound("slide", "slide_volume_m3", k, unit) with lines lc rgb "black" dt 2 lw 1.5 title (k == 4 && reference ne "" ? "measured: between" : "")
set title "entered the water"
plot for [k = 1:words(spacings)] rows(slide(word(spacings, k))) using 1:($3 / unit) with lines lw 2 lc rgb line_colour(k) notitle, \
  for [k = 4:5] bound("slide", "immersed_volume_m3", k, unit) with lines lc rgb "black" dt 2 lw 1.5 notitle
set title "speed of the slide: 99th percentile, and mean (thin)"; set ylabel "m/s" offset 1
plot for [k = 1:words(spacings)] rows(slide(word(spacings, k))) using 1:7 with lines lw 2 lc rgb line_colour(k) notitle, \
  for [k = 1:words(spacings)] rows(slide(word(spacings, k))) using 1:6 with lines lw 1 lc rgb line_colour(k) notitle
if (has_runup) {
  header = system("awk '!/^#/ {gsub(\",\", \" \"); print; exit}' '".runup(word(spacings, 1))."'")
  section = substr(word(header, 3), 1, strlen(word(header, 3)) - strlen("_height_m"))
  set title "run-up on the opposite bank, section ".section; set ylabel "above still level (m)" offset 1; set yrange [*:*]
  plot for [k = 1:words(spacings)] rows(runup(word(spacings, k))) using 1:3 with lines lw 2 lc rgb line_colour(k) notitle, \
    for [k = 4:5] bound(section, "runup_m", k, 1) with lines lc rgb "black" dt 2 lw 1.5 notitle
}
unset multiplot
