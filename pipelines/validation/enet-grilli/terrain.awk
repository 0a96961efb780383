# Ground with the slide on it (layer=ground) or the slide's vertical thickness (layer=thickness), as an ESRI ASCII grid of 0.03 m:
# awk -v d=0.061 -v layer=ground -f terrain.awk > ground.asc. Geometry: README.md; the top of the slide is at d / tan 15 + 0.086 / sin 15.
function sech(a) { return 2 / (exp(a) + exp(-a)) }
# Height of the slide above the slope, normal to it, at distances xi down the slope and chi across it from its centre.
function zeta(xi, chi, h) {
  h = T / (1 - e) * (sech(kb * xi) * sech(kw * chi) - e)
  return h > 0 ? h + 0.004 : 0
}
# Vertical thickness above (x, y): where the vertical meets the slide's surface.
function thickness(x, y, n, h, u) {
  h = 0
  for (n = 0; n < 40; ++n) { u = (x - xc) / c - h * s; h = zeta(u, y) / c }  # the foot of the normal lies h sin 15 up the slope
  return h
}
BEGIN {
  c = cos(0.2617993878); s = sin(0.2617993878)
  T = 0.082; e = 0.717; C = log(1 / e + sqrt(1 / e^2 - 1)); kb = 2 * C / 0.395; kw = 2 * C / 0.68
  xt = d / (s / c) + 0.086 / s   # of the slope below the highest point, on a vertical
  xc = xt - 0.086 * s            # of the slope below it, on the normal
  dx = 0.03; nx = 194; ny = 123; x0 = -0.75; y0 = -1.83
  printf "ncols %d\nnrows %d\nxllcorner %g\nyllcorner %g\ncellsize %g\nNODATA_value -9999\n", nx, ny, x0 - dx / 2, y0 - dx / 2, dx
  for (j = ny - 1; j >= 0; --j) {
    for (i = 0; i < nx; ++i) {
      x = x0 + i * dx; t = thickness(x, y0 + j * dx); bed = -x * s / c
      if (bed < -1.5) bed = -1.5
      printf "%.5f ", layer == "ground" ? bed + t : t
    }
    printf "\n"
  }
}
