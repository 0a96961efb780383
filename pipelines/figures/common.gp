# What all figures share: terminal, line weights, and the colours of the field: water blue, soil brown, bed grey.
blue = "#2b7bba"; pale_blue = "#a9d0ef"; brown = "#a0622d"; grey = "#8c8c8c"; red = "#c00000"
line_colours = "#8c8c8c #2b7bba #c00000 #2e7d32 #6a3d9a"  # of several runs
line_colour(k) = word(line_colours, (k - 1) % words(line_colours) + 1)
canvas(width, height) = sprintf("set terminal pngcairo noenhanced size %d, %d font 'DejaVu Sans,13'", width, height)
set encoding utf8
set datafile separator ","
set border 31 lw 1 lc rgb "#404040"
set tics nomirror out scale 0.6
set grid lc rgb "#d8d8d8" lw 0.7 lt 1
set key spacing 1.2 samplen 2 Left reverse
# The distance of about n tics over a range: 1, 2 or 5 times a power of ten.
power(step) = 10 ** floor(log10(step))
nice(step) = (step / power(step) < 1.5 ? 1 : step / power(step) < 3.5 ? 2 : step / power(step) < 7.5 ? 5 : 10) * power(step)
tic_step(range, n) = range > 0 ? nice(range / real(n)) : 1
# Words in a column of a table, each once, in order.
column_words(file, condition, column) = \
  system(sprintf("awk -F, '!/^#/ && ++n > 1 && (%s) && !seen[$%d]++ {print $%d}' '%s'", condition, column, column, file))
# The rows of a table below its comment and header.
rows(file) = sprintf("< awk '!/^#/ && ++n > 1' '%s'", file)
# Column k of what reference.csv says of a quantity; "" where it says nothing, or there is none.
measured(reference, name, quantity, k) = reference eq "" ? "" : \
  system(sprintf("awk -F, '$1 == \"%s\" && $2 == \"%s\" {print $%d}' '%s'", name, quantity, k, reference))
