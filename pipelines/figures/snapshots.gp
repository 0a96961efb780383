# Maps at six times: the wave, and the speed of the slide.
load "common.gp"
load "ground.gp"
times = system(sprintf("cat '%s/snapshots'", work))
wave(t) = work."/wave_".t."s.xyz"; speed(t) = work."/slide_speed_".t."s.xyz"
has_slide = present(speed(word(times, 1)))
# The largest value of all times; a wave is drawn alike up and down.
largest(what) = real(system(sprintf("awk 'NF > 2 && $3 != \"nan\" {v = $3 < 0 ? -$3 : $3; if (v > m) m = v} END {print m + 0}' '%s'/%s_*s.xyz", work, what)))
# Splash and thin sheets on the banks are higher than the waves: what 99.5 % of the water stays below bounds the scale.
usual(what) = real(system(sprintf("awk 'NF > 2 && $3 != \"nan\" {print $3 < 0 ? -$3 : $3}' '%s'/%s_*s.xyz | sort -g | awk '{v[NR] = $1} END {print NR ? v[int(0.995 * NR) + 1] : 1}'", work, what)))
top = nice(usual("wave")); if (top <= 0) { top = 1 }
fast = has_slide ? nice(usual("slide_speed")) : 1; if (fast <= 0) { fast = 1 }
columns = 3; down = int((words(times) + columns - 1) / columns)
each = int(470.0 * (y1 - y0) / (x1 - x0))
height = 170 + (each + 30) * down
eval canvas(1600, height)
unset key; unset xlabel; unset ylabel; unset grid
set format x ""; set format y ""
# Waves in [-1, 1] of the palette, speeds in [2, 3].
set palette defined (-1 "#8c510a", -0.4 "#dfc27d", 0 "#f5f5f5", 0.4 "#67a9cf", 1 "#053061", 1.5 "#ffffff", 2 "#fff3b0", 2.4 "#f28e2b", 3 "#7f0000")
set cbrange [-1:3]; unset colorbox
clip(v, low, high) = v < low ? low : v > high ? high : v
set multiplot layout down, columns title sprintf("%s: wave from -%g m (brown) over 0 (white) to %g m (dark blue)%s", case, top, top, has_slide ? sprintf("; speed of the slide from 0 (yellow) to %g m/s (dark red)", fast) : "") \
  font ",15" margins 0.01, 0.99, 0.01, 1 - 70.0 / height spacing 0.01, 45.0 / height
do for [k = 1:words(times)] {
  t = word(times, k)
  set title sprintf("%s s", t) offset 0, -0.6
  plot [x0:x1] [y0:y1] hillshade using 1:2:(light($3)):(light($3)):(0.97 * light($3)) with rgbimage, \
    wave(t) using 1:2:(clip($3 / top, -1, 1)) with image, \
    for [i = 1:has_slide] speed(t) using 1:2:(2 + clip($3 / fast, 0, 1)) with image
}
unset multiplot
