# What all maps share: the extent (x0 to x1, y0 to y1), the hillshade, tics, and a box for labels. A map plots hillshade first.
set datafile separator whitespace
stats work."/ground.xyz" using 1 nooutput; x0 = STATS_min; x1 = STATS_max
stats work."/ground.xyz" using 2 nooutput; y0 = STATS_min; y1 = STATS_max
set size ratio -1
set xlabel "easting (m)"; set ylabel "northing (m)" offset 1
set format "%.0f"; set xtics tic_step(x1 - x0, 5); set ytics tic_step(y1 - y0, 5)
set grid front lc rgb "#ffffff" lw 0.5 dt 3
set key outside bottom center horizontal width 2
set style textbox opaque noborder fillcolor rgb "#40ffffff" margins 0.4,0.4
map_height(width) = int(width * 0.77 * (y1 - y0) / (x1 - x0))
# Slopes towards the light are grey as well: white looks as if nothing were known there.
light(s) = 60 + 0.62 * s
hillshade = work."/hillshade.xyz"
present(file) = int(system(sprintf("test -s '%s' && echo 1 || echo 0", file)))
# Gauges as x, y, name; sections as x, y, name, and their ends. Profiles have a section once a time; the first one is enough.
gauge_points(file) = sprintf("< awk -F, '!/^#/ && ++n > 1 {print $3, $4, $1}' '%s'", file)
of_first_time = "/^#/ || ++n == 1 {next} n == 2 {t = $2} $2 != t {next} "
section_lines(file) = sprintf("< awk -F, '%s n > 2 && $1 != s {print \"\"} {print $4, $5; s = $1}' '%s'", of_first_time, file)
section_ends(file) = sprintf("< awk -F, '%s $1 != s {if (s) print p; print $4, $5, $1} {s = $1; p = $4 \" \" $5 \" \" $1 \"\\047\"} END {print p}' '%s'", \
  of_first_time, file)
# Labels of points in the easternmost `part` of the map stand west of these. Of the points on one side, every `step`th from `k` on;
# a point far outside stands for none, as gnuplot warns of empty data.
side(points, sign, part, step, k) = sprintf("%s | awk '$1 %s %.3f && n++ %% %d == %d {found = 1; print} END {if (!found) print 1e9, 1e9, 0, 0}'", \
  points, sign, x1 - part * (x1 - x0), step, k)
# One colour a class of thickness of the slide; thinner than half a metre is not drawn.
thin = 0xd9a066; middle = 0xa0622d; thick = 0x5b2c0c
shade(t) = int(t < 5 ? thin : t < 20 ? middle : thick)
