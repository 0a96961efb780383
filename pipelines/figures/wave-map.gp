# Map of the wave: hillshade, largest height of the surface, isochrones of arrival, shoreline at rest, limit of
# inundation, gauges, and the highest run-up of each shore.
load "common.gp"
load "ground.gp"
stats work."/max_elevation.xyz" using ($3 - level) nooutput; top = STATS_max > 0 ? STATS_max : 1  # nothing has arrived
gauges = out."/peaks.csv"; isochrones = work."/isochrones.txt"; shores = work."/shores.txt"
has_gauges = present(gauges); has_isochrones = present(isochrones); has_shores = present(shores)
gauge_labels = has_gauges ? gauge_points(gauges) : "< true"
shore_labels = has_shores ? "< cat '".shores."'" : "< true"

eval canvas(1400, 220 + map_height(1400))
set title sprintf("%s: highest water surface and arrival of the wave", case)
set palette defined (0 "#f4f9fd", 1 "#c6dbef", 2 "#6baed6", 3 "#2171b5", 4 "#08306b")
set cbrange [0:top]; set format cb "%g"
set cblabel sprintf("highest water surface above the still level of %g m (m)", level) offset 1.5

plot [x0:x1] [y0:y1] hillshade using 1:2:(light($3)):(light($3)):(0.97 * light($3)) with rgbimage notitle, \
     work."/max_elevation.xyz" using 1:2:($3 - level) with image notitle, \
     work."/inundation.txt" using 1:2 with lines lc rgb red lw 1.2 title "limit of inundation", \
     work."/shoreline-at-rest.txt" using 1:2 with lines lc rgb "#0b3c66" lw 1.6 dt 2 title "shoreline at rest", \
     for [i = 1:has_isochrones] isochrones using 1:2 with lines lc rgb "black" lw 1.3 title "arrival of the wave (s)", \
     for [i = 1:has_isochrones] work."/isochrone-labels.txt" using 1:2:(sprintf("%g", $3)) with labels boxed font ",11" notitle, \
     for [i = 1:has_gauges] gauge_points(gauges) using 1:2 with points pt 7 ps 1.2 lc rgb "#7a2e8c" title "gauge", \
     for [k = 0:1] side(gauge_labels, "<", 0.1, 2, k) using 1:2:3 \
       with labels left boxed offset 0.8,(k ? -0.6 : 0.6) font ",12" tc rgb "#7a2e8c" notitle, \
     for [k = 0:1] side(gauge_labels, ">=", 0.1, 2, k) using 1:2:3 \
       with labels right boxed offset -0.8,(k ? -0.6 : 0.6) font ",12" tc rgb "#7a2e8c" notitle, \
     for [i = 1:has_shores] shores using 1:2 with points pt 9 ps 2 lc rgb red title "highest run-up of a shore", \
     side(shore_labels, "<", 0.25, 1, 0) using 1:2:(sprintf("shore %d: %.3g m", $3, $4)) \
       with labels left boxed offset 1.2,0.8 font ",12" tc rgb red notitle, \
     side(shore_labels, ">=", 0.25, 1, 0) using 1:2:(sprintf("shore %d: %.3g m", $3, $4)) \
       with labels right boxed offset -1.2,0.8 font ",12" tc rgb red notitle
