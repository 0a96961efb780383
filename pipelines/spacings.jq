# Tab-separated: what runs at several spacings cost and gave, beside published values. Of spacings.json (summaries), convergence.json
# and the text of reference.csv (name,quantity,published,low,high,note; # comments), "" where there is none: jq -L FOLDER -f spacings.jq
include "numbers";
def shown($unit): if type != "number" then "-" elif ($unit == "m3" and fabs >= 1e5) then (. / 1e6 | three) + "e6" else three end;
def cell: if . == null or . == "" then "-" else . end;
def number: if . == null or . == "" then null else tonumber end;
# What was measured between two bounds, either of which may not be known.
def between($low; $high; $unit):
  if $low == null and $high == null then "-" elif $high == null then "> \($low | shown($unit))" elif $low == null then "< \($high | shown($unit))"
  elif $low == $high then $low | shown($unit) else "\($low | shown($unit)) to \($high | shown($unit))" end;
($runs[0] | sort_by(-.particle_spacing_m)) as $runs
| $convergence[0] as $c
| ($c.particle_spacing_m | to_entries | sort_by(-.value) | map(.key)) as $order
| [$reference | split("\n")[] | select(test("^[^#]")) | split(",")][1:] as $published
| (["", "", ""] + ($runs | map("dp \(.particle_spacing_m) m")) + ["error", "by", "published", "measured"]),
  (["particles", "", ""] + ($runs | map(.particles | .water + .soil + .wall | tostring)) + ["", "", "", ""]),
  (["steps", "", ""] + ($runs | map(.steps | tostring)) + ["", "", "", ""]),
  (["wall time", "", "s"] + ($runs | map(.wall_time_s | round | tostring)) + ["", "", "", ""]),
  (["speed", "", "M/s"] + ($runs | map(.particle_steps_per_s / 1e6 | three)) + ["", "", "", ""]),
  ($c.quantities[]
   | . as $q
   | ([$published[] | select(.[0] == $q.name and .[1] == $q.quantity)] | first) as $p
   | [.name, (.quantity | sub("_(m3|m|s)$"; "") | gsub("_"; " ")), .unit] + [.values[$order[]] | shown($q.unit)]
     + [(.error | shown($q.unit)), .used,
        ($p[2] | number | shown($q.unit)),
        between($p[3] | number; $p[4] | number; $q.unit)])
| map(cell) | @tsv
