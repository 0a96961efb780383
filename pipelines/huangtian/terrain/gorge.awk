# A gorge such as that of the Lancang at Huangtian, as an Arc/Info ASCII grid: awk -f gorge.awk > gorge.asc
#
# Synthetic: no survey of the site is open. Made to the numbers that are printed of it (README.md); only its CRS and its corner
# are near the site. A valley floor 160 m wide at 985 m comes from the east, bends, and runs south between banks of 35 degrees.
BEGIN {
  side = 3000; cell = 10; west = 610000; south = 2729000                 # m; EPSG:32647
  bed = 985; upper = 0.46631; knee = 1600                                # m; tangent of 25 degrees; m
  if (!half_width) half_width = 80                                       # m; -v takes another
  if (!steep) steep = 0.70021                                            # tangent of 35 degrees; -v takes another
  n = split("700 -200 1200 150 1600 600 1700 1000 1700 2000 1790 2260 1990 2460 2270 2560 2650 2600 3200 2500", axis, " ") / 2

  cells = side / cell
  printf "ncols %d\nnrows %d\nxllcorner %d\nyllcorner %d\ncellsize %d\n", cells, cells, west, south, cell
  for (row = cells - 1; row >= 0; --row) {
    for (column = 0; column < cells; ++column) {
      x = (column + 0.5) * cell; y = (row + 0.5) * cell
      printf "%.2f%s", bank(distance_to_axis(x, y) - half_width), column < cells - 1 ? " " : "\n"
    }
  }
}

function bank(from_foot,   corner) {
  corner = (knee - bed) / steep
  return from_foot < 0 ? bed : from_foot < corner ? bed + steep * from_foot : knee + upper * (from_foot - corner)
}

function distance_to_axis(x, y,   k, ax, ay, bx, by, t, d, least) {
  for (k = 1; k < n; ++k) {
    ax = axis[2 * k - 1]; ay = axis[2 * k]; bx = axis[2 * k + 1] - ax; by = axis[2 * k + 2] - ay
    t = ((x - ax) * bx + (y - ay) * by) / (bx * bx + by * by)
    t = t < 0 ? 0 : t > 1 ? 1 : t
    d = (x - ax - t * bx) ^ 2 + (y - ay - t * by) ^ 2
    if (k == 1 || d < least) least = d
  }
  return sqrt(least)
}
