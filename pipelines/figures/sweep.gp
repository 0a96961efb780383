# Results of a sweep against each of its keys: a column a key, a row a result; a point a run, and the mean of those that share a value.
load "common.gp"
points = work."/points.csv"
keys = system(sprintf("cut -d, -f1 '%s' | awk '!seen[$0]++'", points))
number_of(file, k) = int(system(sprintf("cut -d, -f%d '%s' | sort -u | wc -l", k, file)))
down = number_of(points, 2)
quantity(i) = system(sprintf("cut -d, -f2 '%s' | awk '!seen[$0]++' | sed -n %dp", points, i))
of(key, q) = sprintf("< awk -F, -v k='%s' -v q='%s' '$1 == k && $2 == q' '%s'", key, q, points)
mean(key, q) = sprintf("< awk -F, -v k='%s' -v q='%s' '$1 == k && $2 == q {s[$3] += $5; ++n[$3]} END {for (x in s) print x \",\" s[x] / n[x]}' '%s' | sort -g", key, q, points)
# The values of a key as tics, with labels or without.
tics_of(key, shown) = system(sprintf("awk -F, -v k='%s' -v shown=%d '$1 == k && !seen[$3]++ {printf \"%%s\\\"%%s\\\" %%s\", n++ ? \", \" : \"\", shown ? $4 : \"\", $3}' '%s'", key, shown, points))
# Long labels are slanted, and want room.
slanted(key) = int(system(sprintf("awk -F, -v k='%s' '$1 == k && length($4) > 8 {found = 1} END {print found + 0}' '%s'", key, points)))
across = words(keys)
below = 60.0
do for [k = 1:across] { if (slanted(word(keys, k))) { below = 130.0 } }
height = 30 + below + 260 * down
eval canvas(110 + 430 * across, height)
set multiplot layout down, across title case.": results of the sweep" font ",17" \
  margins 80.0 / (110 + 430 * across), 0.98, below / height, 1 - 60.0 / height spacing 0.09 / across * 2, 0.03
set offsets graph 0.08, graph 0.08, graph 0.08, 0
set yrange [*<0:1e-6<*]
do for [i = 1:down] {
  do for [k = 1:across] {
    key_name = word(keys, k)
    if (i == down) { set xlabel key_name offset 0, 0.2 } else { unset xlabel }
    if (k == 1) { set ylabel quantity(i) offset 0.5 } else { unset ylabel }
    eval "set xtics ".(slanted(key_name) ? "rotate by 25 right" : "norotate autojustify")." (".tics_of(key_name, i == down).")"
    if (i == 1 && k == 1) { set key bottom left } else { unset key }
    plot of(key_name, quantity(i)) using 3:5 with points pt 7 ps 1.1 lc rgb blue title "run", \
      mean(key_name, quantity(i)) using 1:2 with linespoints pt 6 ps 1.6 lw 2 lc rgb red title "mean"
  }
}
unset multiplot
