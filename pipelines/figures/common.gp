# What all figures share: fonts, line weights, and the colours of the field: water blue, soil brown, bed grey.
water_colour = "#2b7bba"; soil_colour = "#a0622d"; bed_colour = "#6b6b6b"; slip_colour = "#c00000"
set encoding utf8
set border 31 lw 1 lc rgb "#404040"
set tics nomirror out scale 0.6
set grid lc rgb "#d8d8d8" lw 0.7 lt 1
set key spacing 1.2 samplen 2
