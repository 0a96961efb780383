# Tab-separated: what runs at several spacings cost and gave, beside published values. Of spacings.json (summaries), convergence.json
# and the text of reference.csv (name,quantity,published,low,high,note; # comments), "" where there is none.
def round3: if type != "number" then "-" elif . == 0 then "0" else (fabs | log10 | floor) as $e
  | if $e >= 2 then (. | round | tostring) else (pow(10; 2 - $e) as $p | . * $p | round / $p | tostring) end end;
def shown($unit): if type != "number" then "-" elif ($unit == "m3" and fabs >= 1e5) then (. / 1e6 | round3) + "e6" else round3 end;
def cell: if . == null or . == "" then "-" else . end;
def number: if . == null or . == "" then null else tonumber end;
($runs[0] | sort_by(-.particle_spacing_m)) as $runs
| $convergence[0] as $c
| ($c.particle_spacing_m | to_entries | sort_by(-.value) | map(.key)) as $order
| [$reference | split("\n")[] | select(test("^[^#]")) | split(",")][1:] as $published
| (["", "", ""] + ($runs | map("dp \(.particle_spacing_m) m")) + ["error", "by", "published", "measured"]),
  (["particles", "", ""] + ($runs | map(.particles | .water + .soil + .wall | tostring)) + ["", "", "", ""]),
  (["steps", "", ""] + ($runs | map(.steps | tostring)) + ["", "", "", ""]),
  (["wall time", "", "s"] + ($runs | map(.wall_time_s | round | tostring)) + ["", "", "", ""]),
  (["speed", "", "M/s"] + ($runs | map(.particle_steps_per_s / 1e6 | round3)) + ["", "", "", ""]),
  ($c.quantities[]
   | . as $q
   | ([$published[] | select(.[0] == $q.name and .[1] == $q.quantity)] | first) as $p
   | [.name, (.quantity | sub("_(m3|m|s)$"; "") | gsub("_"; " ")), .unit] + [.values[$order[]] | shown($q.unit)]
     + [(.error | shown($q.unit)), .used,
        ($p[2] | number | shown($q.unit)),
        (if $p == null or ($p[3] // "") == "" then "-" else "\($p[3] | number | shown($q.unit))-\($p[4] | number | shown($q.unit))" end)])
| map(cell) | @tsv
