# From the position of the block's trailing edge to the motion of its chord (README.md: x_te + 0.0293 m, the chord's two ends on the
# bed): awk -F, -f motion.awk RUN_slide_position.csv > RUN_motion.csv
# With -v outline=1: the block's outline at t = 0 as one line of YAML, counterclockwise from the trailing edge.
function bed(x, u) {
  if (x <= 1.297) return -x * 0.2679491924
  if (x >= 1.807) return -0.435
  u = x - 1.297
  return 0.19 * u^3 + 0.1024 * u^2 - 0.2728 * u - 0.34753
}
# x of the leading end: 0.5 m from the trailing one at x, both on the bed.
function leading(x, low, high, middle) {
  low = x + 0.4; high = x + 0.501
  while (high - low > 1e-9) {
    middle = (low + high) / 2
    if ((middle - x)^2 + (bed(middle) - bed(x))^2 < 0.25) low = middle; else high = middle
  }
  return low
}
function slope(x, lead) { lead = leading(x); return atan2(bed(x) - bed(lead), lead - x) }  # radians, down to the east
NR == 1 { if (!outline) print "t_s,dx_m,dz_m,pitch_deg"; next }
{
  x = $2 + 0.0293
  if (NR == 2) {
    x0 = x; a0 = slope(x)
    if (outline) {
      n = 16; line = "["
      for (k = 0; k <= n; ++k) {
        s = 0.25 - 0.25 * cos(3.14159265 * k / n); h = 0.026 * sin(3.14159265 * k / n)
        line = line (k ? "," : "") sprintf("[%.4f,%.4f]", x + s * cos(a0) + h * sin(a0), bed(x) - s * sin(a0) + h * cos(a0))
      }
      print line "]"; exit
    }
  }
  printf "%s,%.5f,%.5f,%.3f\n", $1, x - x0, bed(x) - bed(x0), (slope(x) - a0) * 57.29577951
}
