# Greatest wave height at each gauge on water, by spacing, with what was measured (reference.csv: name "any").
load "common.gp"
eval canvas(1100, 560)
peaks(dp) = out."/dp".dp."/peaks.csv"
water(dp) = "< awk -F, '!/^#/ && ++n > 1 && $2 == \"water\"' '".peaks(dp)."'"
set title case.": greatest wave height at the gauges"
set ylabel "above still level (m)"; set yrange [*<0:1e-6<*]; set offsets 0.6, 0.6, graph 0.12, 0
set key outside top center horizontal
low = measured(reference, "any", "max_height_m", 4); high = measured(reference, "any", "max_height_m", 5)
if (low ne "") { set arrow from graph 0, first real(low) to graph 1, first real(low) nohead dt 2 lw 1.5 }
if (high ne "") { set arrow from graph 0, first real(high) to graph 1, first real(high) nohead dt 2 lw 1.5 }
plot for [k = 1:words(spacings)] water(word(spacings, k)) using 0:6:xtic(1) with linespoints pt 7 ps 1.3 lw 1.6 \
    lc rgb line_colour(k) title "dp ".word(spacings, k)." m", \
  (low ne "" ? real(low) : NaN) with lines lc rgb "black" dt 2 lw 1.5 title (low ne "" ? (high ne "" ? "measured: between" : "measured: above") : "")
