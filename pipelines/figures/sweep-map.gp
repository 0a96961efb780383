# Maps over all runs of a sweep: highest wave, earliest arrival, and the share of runs that exceed 1 m and 3 m.
load "common.gp"
load "ground.gp"
set datafile separator whitespace
height = work."/envelope_height.xyz"; arrival = work."/envelope_arrival.xyz"
# Not by stats, which wants a value: where no wave has arrived there is none.
largest(file) = real(system(sprintf("awk 'BEGIN {m = 1e-6} NF == 3 && $3 != \"nan\" && $3 > m {m = $3} END {printf \"%%.6f\", m}' '%s'", file)))
top = largest(height); latest = largest(arrival)
gauges = out."/peaks.csv"; has_gauges = present(gauges)
panel = int(700 * (y1 - y0) / (x1 - x0)) + 60
eval canvas(1700, 2 * panel + 60)
set multiplot layout 2, 2 title case.": over all runs of the sweep" font ",17" margins 0.06, 0.94, 0.05, 1 - 80.0 / (2 * panel + 60) spacing 0.12, 80.0 / (2 * panel + 60)
unset xlabel; unset ylabel
unset key
base = "hillshade using 1:2:(light($3)):(light($3)):(0.97 * light($3)) with rgbimage"
over(file, value) = sprintf("plot [x0:x1] [y0:y1] %s, '%s' using 1:2:%s with image, for [i = 1:has_gauges] gauge_points(gauges) using 1:2 with points pt 7 ps 0.9 lc rgb '#7a2e8c', for [i = 1:has_gauges] gauge_points(gauges) using 1:2:3 with labels left boxed offset 0.7,0.4 font ',10'", base, file, value)
set format cb "%g"
set title "highest water surface above the still level (m)" font ",14"
set palette defined (0 "#eaf4fc", 1 "#9ecae1", 2 "#3182bd", 3 "#08306b", 4 "#5a0f6b"); set cbrange [0:top]
eval over(height, "3")
set title "earliest arrival of the wave (s)"
set palette defined (0 "#b30000", 1 "#fc8d59", 2 "#fee08b", 3 "#99d594", 4 "#3288bd"); set cbrange [0:latest]
eval over(arrival, "3")
set palette defined (0 "#ffffcc", 0.25 "#fed976", 0.5 "#fd8d3c", 0.75 "#e31a1c", 1 "#800026"); set cbrange [0:1]
set title "share of runs in which the wave exceeds 1 m"
eval over(work."/share_above_1m.xyz", "($3 > 0 ? $3 : NaN)")
set title "share of runs in which the wave exceeds 3 m"
eval over(work."/share_above_3m.xyz", "($3 > 0 ? $3 : NaN)")
unset multiplot
