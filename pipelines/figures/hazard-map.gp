# Map of hazard classes: strong where land is flooded (by flow depth), pale in the lake (by wave height).
load "common.gp"
load "ground.gp"
# Rows of x, y, class (0 to 3) and zone (0 dry, 1 lake at rest, 2 inundated land).
classes = work."/zones.xyz"
low = 0xffd92f; middle = 0xf57c00; high = 0xb30000
colour(c) = int(c < 2 ? low : c < 3 ? middle : high)
opacity(c, zone) = c == 0 ? 0 : zone == 2 ? 235 : 70

eval canvas(1400, 190 + map_height(1400) * 1.14)
set title sprintf("%s: hazard classes", case)
plot [x0:x1] [y0:y1] hillshade using 1:2:(light($3)):(light($3)):(0.97 * light($3)) with rgbimage notitle, \
     classes using 1:2:(colour($3) >> 16):((colour($3) >> 8) & 255):(colour($3) & 255):(opacity($3, $4)) with rgbalpha notitle, \
     work."/shoreline-at-rest.txt" using 1:2 with lines lc rgb "#0b3c66" lw 1.4 dt 2 title "shoreline at rest", \
     work."/inundation.txt" using 1:2 with lines lc rgb "#303030" lw 1 title "limit of inundation", \
     keyentry with boxes fs solid fc rgb low title "below 1 m", \
     keyentry with boxes fs solid fc rgb middle title "1 m to 3 m", \
     keyentry with boxes fs solid fc rgb high title "above 3 m"
