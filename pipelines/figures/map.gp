# Map: hillshade, largest wave height, final thickness of the slide, gauges, section lines.
load "common.gp"
load "ground.gp"
stats work."/max_elevation.xyz" using ($3 - level) nooutput; top = STATS_max > 0 ? STATS_max : 1  # nothing has arrived
slide = work."/thickness.xyz"; gauges = out."/peaks.csv"; profiles = out."/profiles.csv"
has_slide = present(slide); has_gauges = present(gauges); has_sections = present(profiles)
gauge_labels = has_gauges ? gauge_points(gauges) : "< true"

set contour base; set cntrparam levels discrete level; unset surface
set table work."/shoreline.txt"
splot work."/ground.xyz" notitle
unset table; unset contour; set surface

eval canvas(1400, 250 + map_height(1400))
set title sprintf("%s: largest wave height and final slide deposit", case)
set palette defined (0 "#eaf4fc", 1 "#9ecae1", 2 "#3182bd", 3 "#08306b", 4 "#5a0f6b")
set cbrange [0:top]; set format cb "%g"
set cblabel sprintf("largest water surface above the still level of %g m (m)", level) offset 1.5

plot [x0:x1] [y0:y1] hillshade using 1:2:(light($3)):(light($3)):(0.97 * light($3)) with rgbimage notitle, \
     work."/max_elevation.xyz" using 1:2:($3 - level) with image notitle, \
     for [i = 1:has_slide] slide using 1:2:(shade($3) >> 16):((shade($3) >> 8) & 255):(shade($3) & 255): \
       ($3 >= 0.5 ? 225 : 0) with rgbalpha notitle, \
     work."/shoreline.txt" using 1:2 with lines lc rgb "#0b3c66" lw 1.2 dt 2 title "initial shoreline", \
     for [i = 1:has_sections] section_lines(profiles) using 1:2 with lines lc rgb red lw 2 title "section", \
     for [i = 1:has_sections] section_ends(profiles) using 1:2:3 with labels tc rgb red font ",15" offset 1.2,0.6 notitle, \
     for [i = 1:has_gauges] gauge_points(gauges) using 1:2 with points pt 7 ps 1.3 lc rgb "black" title "gauge", \
     side(gauge_labels, "<", 0.1, 1, 0) using 1:2:3 with labels left boxed offset 1,0.4 font ",12" notitle, \
     side(gauge_labels, ">=", 0.1, 1, 0) using 1:2:3 with labels right boxed offset -1,0.4 font ",12" notitle, \
     for [i = 1:has_slide] keyentry with boxes fs solid fc rgb thin title "slide 0.5-5 m", \
     for [i = 1:has_slide] keyentry with boxes fs solid fc rgb middle title "slide 5-20 m", \
     for [i = 1:has_slide] keyentry with boxes fs solid fc rgb thick title "slide over 20 m"
