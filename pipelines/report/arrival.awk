# Arrival times that a wave can have: it comes to a cell through a neighbour, so no cell is reached before the earliest
# of its neighbours is. Where the surface moved by the threshold for another reason the time is that of the neighbours.
# awk -v none=1e9 -f arrival.awk times.xyz     (rows of x, y, time, a whole grid by rows; `none`: not reached)
NF == 3 {
  if ($2 != y) { row++; column = 0; y = $2 }
  column++
  if (column > columns) columns = column
  place[row, column] = $1 " " $2
  time[row, column] = $3 + 0
  reached[row, column] = none
}
END {
  # The source: the earliest of the cells that lie among cells that were reached, by the mean over these.
  earliest = none
  for (r = 2; r < row; ++r)
    for (c = 2; c < columns; ++c) {
      mean = 0
      for (i = -1; i <= 1; ++i)
        for (j = -1; j <= 1; ++j) mean += time[r + i, c + j] / 9
      if (mean < earliest) { earliest = mean; source = r SUBSEP c }
    }
  if (earliest < none / 10) reached[source] = time[source]
  do {
    changed = 0
    for (r = 1; r <= row; ++r)
      for (c = 1; c <= columns; ++c) {
        if (time[r, c] >= none || (r SUBSEP c) == source) continue
        before = none
        for (i = -1; i <= 1; ++i)
          for (j = -1; j <= 1; ++j)
            if ((i || j) && ((r + i, c + j) in reached) && reached[r + i, c + j] < before) before = reached[r + i, c + j]
        at = before > time[r, c] ? before : time[r, c]
        if (before < none && at < reached[r, c]) { reached[r, c] = at; changed = 1 }
      }
  } while (changed)
  for (r = 1; r <= row; ++r)
    for (c = 1; c <= columns; ++c) print place[r, c], reached[r, c]
}
