# Map: hillshade, largest wave height, final thickness of the slide, gauges, section lines.
# gnuplot -e "work='FOLDER'; level=740; title='demo'" map.gp; the folder holds {hillshade,ground,elevation,thickness}.xyz
# (grids with a blank line after each row) and {gauges,sections}.txt.
stats work."/ground.xyz" using 1 nooutput; x0 = STATS_min; x1 = STATS_max
stats work."/ground.xyz" using 2 nooutput; y0 = STATS_min; y1 = STATS_max
stats work."/elevation.xyz" using ($3 - level) nooutput; top = STATS_max

set contour base; set cntrparam levels discrete level; unset surface
set table work."/shoreline.txt"
splot work."/ground.xyz" notitle
unset table; unset contour; set surface

set terminal pngcairo size 1400, 250 + int(1130.0 * (y1 - y0) / (x1 - x0)) font "DejaVu Sans,13"
set title sprintf("%s: largest wave height and final slide deposit", title)
set size ratio -1
set xrange [x0:x1]; set yrange [y0:y1]
set xlabel "easting (m)"; set ylabel "northing (m)" offset 1
set format "%.0f"; set xtics 500; set ytics 500
set grid front lc rgb "#ffffff" lw 0.5 dt 3
set palette defined (0 "#eaf4fc", 1 "#9ecae1", 2 "#3182bd", 3 "#08306b", 4 "#5a0f6b")
set cbrange [0:top]; set cblabel sprintf("largest water surface above still level %g m (m)", level) offset 1.5; set format cb "%g"
set key outside bottom center horizontal Left reverse width 2
set style textbox opaque noborder fillcolor rgb "#40ffffff" margins 0.4,0.4

# One colour a class of thickness; thinner than half a metre is not drawn.
thin = 0xd9a066; middle = 0xa0622d; thick = 0x5b2c0c
brown(t) = t < 5 ? thin : t < 20 ? middle : thick
grey(s) = 60 + 0.76 * s
plot work."/hillshade.xyz" using 1:2:(grey($3)):(grey($3)):(0.97 * grey($3)) with rgbimage notitle, \
     work."/elevation.xyz" using 1:2:($3 - level) with image notitle, \
     work."/thickness.xyz" using 1:2:(int(brown($3)) >> 16):((int(brown($3)) >> 8) & 255):(int(brown($3)) & 255): \
       ($3 >= 0.5 ? 225 : 0) with rgbalpha notitle, \
     work."/shoreline.txt" using 1:2 with lines lc rgb "#0b3c66" lw 1.2 dt 2 title "initial shoreline", \
     work."/sections.txt" using 1:2 with lines lc rgb "#c00000" lw 2 title "section", \
     work."/sections.txt" using 1:2:3 with labels textcolor rgb "#c00000" font ",15" offset 1.2,0.6 notitle, \
     work."/gauges.txt" using 1:2 with points pt 7 ps 1.3 lc rgb "black" title "gauge", \
     work."/gauges.txt" using 1:2:3 with labels left boxed offset 1,0.4 font ",12" notitle, \
     keyentry with boxes fs solid fc rgb thin title "slide 0.5-5 m", \
     keyentry with boxes fs solid fc rgb middle title "5-20 m", \
     keyentry with boxes fs solid fc rgb thick title "over 20 m"
