# Maps of the differences from the finest run, a panel a map.
load "common.gp"
set datafile separator whitespace
columns = 3; down = int((words(maps) + columns - 1) / columns)
eval canvas(1650, 90 + 520 * down)
set multiplot layout down, columns title case.": differences from the finest run (m)" font ",17"
set size ratio -1; set format "%.0f"; unset grid; set xtics 1000; set ytics 1000
set palette defined (-1 "#08519c", -0.4 "#9ecae1", 0 "#f7f7f7", 0.4 "#fdae6b", 1 "#a63603"); set format cb "%g"
do for [map in maps] {
  file = work."/".map.".xyz"
  # By their spread: single nodes at the edge of a surface differ much more than all others.
  stats file using (abs($3)) nooutput
  set cbrange [-2.5 * STATS_stddev - 1e-6 : 2.5 * STATS_stddev + 1e-6]
  title_of = system("echo '".map."' | sed 's/_/ /g'")
  set title title_of font ",12"
  plot file using 1:2:3 with image notitle
}
unset multiplot
