# Map of the slide at the end: thickness, shoreline at rest, section lines.
load "common.gp"
load "ground.gp"
slide = work."/thickness.xyz"; profiles = out."/profiles.csv"; shoreline = work."/shoreline-at-rest.txt"
has_sections = present(profiles); has_shore = present(shoreline)
stats slide using 3 nooutput; top = exists("STATS_max") ? (STATS_max > 1 ? STATS_max : 1) : 1

eval canvas(1400, 200 + map_height(1400))
set title sprintf("%s: thickness of the slide at the end", case)
set palette defined (0 "#f6e8c3", 1 "#dfc27d", 2 "#bf812d", 3 "#8c510a", 4 "#402000")
set cbrange [0:top]; set format cb "%g"; set cblabel "thickness (m); below 0.5 m not drawn" offset 1.5
plot [x0:x1] [y0:y1] hillshade using 1:2:(light($3)):(light($3)):(0.97 * light($3)) with rgbimage notitle, \
     slide using 1:2:($3 >= 0.5 ? $3 : NaN) with image notitle, \
     for [i = 1:has_shore] shoreline using 1:2 with lines lc rgb "#0b3c66" lw 1.4 dt 2 title "shoreline at rest", \
     for [i = 1:has_sections] section_lines(profiles) using 1:2 with lines lc rgb red lw 2 title "section", \
     for [i = 1:has_sections] section_ends(profiles) using 1:2:3 with labels tc rgb red font ",15" offset 1.2,0.6 notitle
