# Map: hillshade, largest wave height, final thickness of the slide, gauges, section lines.
load "common.gp"
set datafile separator whitespace
stats work."/ground.xyz" using 1 nooutput; x0 = STATS_min; x1 = STATS_max
stats work."/ground.xyz" using 2 nooutput; y0 = STATS_min; y1 = STATS_max
stats work."/max_elevation.xyz" using ($3 - level) nooutput; top = STATS_max
has_slide = int(system("test -e ".work."/thickness.xyz && echo 1 || echo 0"))
has_gauges = int(system("test -e ".out."/peaks.csv && echo 1 || echo 0"))
has_sections = int(system("test -e ".out."/profiles.csv && echo 1 || echo 0"))

set contour base; set cntrparam levels discrete level; unset surface
set table work."/shoreline.txt"
splot work."/ground.xyz" notitle
unset table; unset contour; set surface

eval canvas(1400, 250 + int(1130.0 * (y1 - y0) / (x1 - x0)))
set title sprintf("%s: largest wave height and final slide deposit", case)
set size ratio -1
set xrange [x0:x1]; set yrange [y0:y1]
set xlabel "easting (m)"; set ylabel "northing (m)" offset 1
set format "%.0f"; set xtics 500; set ytics 500
set grid front lc rgb "#ffffff" lw 0.5 dt 3
set palette defined (0 "#eaf4fc", 1 "#9ecae1", 2 "#3182bd", 3 "#08306b", 4 "#5a0f6b")
set cbrange [0:top]; set format cb "%g"
set cblabel sprintf("largest water surface above the still level of %g m (m)", level) offset 1.5
set key outside bottom center horizontal width 2
set style textbox opaque noborder fillcolor rgb "#40ffffff" margins 0.4,0.4

# One colour a class of thickness; thinner than half a metre is not drawn.
thin = 0xd9a066; middle = 0xa0622d; thick = 0x5b2c0c
shade(t) = int(t < 5 ? thin : t < 20 ? middle : thick)
light(s) = 60 + 0.76 * s
slide = work."/thickness.xyz"; gauges = out."/peaks.csv"; profiles = out."/profiles.csv"
ends = "< awk -F, '!/^#/ && ++n > 1 {if ($1 != s) {if (s) print p; print $4, $5, $1} s = $1; p = $4 \" \" $5 \" \" $1 \"\\047\"} END {print p}' "
plot work."/hillshade.xyz" using 1:2:(light($3)):(light($3)):(0.97 * light($3)) with rgbimage notitle, \
     work."/max_elevation.xyz" using 1:2:($3 - level) with image notitle, \
     for [i = 1:has_slide] slide using 1:2:(shade($3) >> 16):((shade($3) >> 8) & 255):(shade($3) & 255): \
       ($3 >= 0.5 ? 225 : 0) with rgbalpha notitle, \
     work."/shoreline.txt" using 1:2 with lines lc rgb "#0b3c66" lw 1.2 dt 2 title "initial shoreline", \
     for [i = 1:has_sections] "< awk -F, '!/^#/ && ++n > 1 {if (n > 2 && $1 != s) print \"\"; print $4, $5; s = $1}' ".profiles \
       using 1:2 with lines lc rgb red lw 2 title "section", \
     for [i = 1:has_sections] ends.profiles using 1:2:3 with labels tc rgb red font ",15" offset 1.2,0.6 notitle, \
     for [i = 1:has_gauges] "< awk -F, '!/^#/ && ++n > 1 {print $3, $4, $1}' ".gauges \
       using 1:2 with points pt 7 ps 1.3 lc rgb "black" title "gauge", \
     for [i = 1:has_gauges] "< awk -F, '!/^#/ && ++n > 1 {print $3, $4, $1}' ".gauges \
       using 1:2:3 with labels left boxed offset 1,0.4 font ",12" notitle, \
     for [i = 1:has_slide] keyentry with boxes fs solid fc rgb thin title "slide 0.5-5 m", \
     for [i = 1:has_slide] keyentry with boxes fs solid fc rgb middle title "slide 5-20 m", \
     for [i = 1:has_slide] keyentry with boxes fs solid fc rgb thick title "slide over 20 m"
