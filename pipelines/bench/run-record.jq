# What the records of all benchmarks take from a summary of lgiw-run.

# A GPU goes by its name, a CPU by its threads and instructions.
def machine:
  {device, threads, instructions: (.model | split(", ") | map(select(endswith(" instructions"))) | first // null | if . then rtrimstr(" instructions") else . end)}
  | if .device == "CPU" then . else del(.threads, .instructions) end;

def total_particles: .particles | .water + .soil + .wall;

# Of all that a run takes but reading its particles: the phases of a step, diagnostics, and the rest.
def wall_time_shares:
  (.wall_time_s + .set_up_time_s) as $all
  | (.phase_seconds | map_values(. / $all)) + {"start-up and output": (1 - (.phase_seconds | add) / $all)};

def padded($n): tostring | . + (" " * ([0, $n - length] | max));
# Rows of cells -> lines, the columns but the last as wide as their widest cell.
def table:
  . as $rows | ($rows | map(length) | max) as $columns
  | [range($columns - 1) as $k | $rows | map(.[$k] // "" | tostring | length) | max] as $widths
  | .[] | [to_entries[] | .key as $k | .value | padded($widths[$k] // 0)] | join("  ");
def rounded($digits): . * pow(10; $digits) | round / pow(10; $digits);
