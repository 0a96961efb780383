# Error against run time: a panel a case, a curve a scheme, dp falling along each curve.
load "common.gp"
cases = column_words(table, "1", 1)
n = words(cases)
columns = 2
panel_rows = (n + columns - 1) / columns
eval canvas(1500, 40 + 520 * panel_rows)
set multiplot layout panel_rows, columns
set logscale xy
set format y "%g"; set format x "%g"
set xlabel "wall time (s)"
set autoscale xfix
set key outside right top font ",10" spacing 1.0
do for [i = 1:n] {
  name = word(cases, i)
  norm = system(sprintf("awk -F, '$1 == \"%s\" {print $17; exit}' '%s'", name, table))
  schemes = column_words(table, sprintf("$1 == \"%s\"", name), 2)
  set title name.": ".norm
  set ylabel "error" offset 1
  plot for [k = 1:words(schemes)] sprintf("< awk -F, '$1 == \"%s\" && $2 == \"%s\" {print $14 \",\" ($18 < 0 ? -$18 : $18)}' '%s'", name, word(schemes, k), table) \
    using 1:2 with linespoints lw (k == 1 ? 3 : 1.5) pt (k <= 14 ? k : k - 14) ps 1 title word(schemes, k)
}
unset multiplot
