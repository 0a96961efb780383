# Whether a run of the stability matrix is sound: $point[0] of the matrix, $run[0] its summary (null without one), $rows the header,
# the first and the last row of its diagnostics, $error its stderr, $status its exit status. The first criterion that is broken is
# named, with its value.
def number: try tonumber catch null;
def rows: $rows | split("\n") | map(select(. != "") | split(",")) | .[0] as $names
  | .[1:] | map([$names, map(number)] | transpose | map({key: .[0], value: .[1]}) | from_entries);
def size: if fabs >= 0.01 then . * 1000 | round / 1000 else . end | tostring;
$point[0] as $p | $run[0] as $r | ($error | split("\n") | map(select(. != ""))) as $lines
# What must hold, each {name, value, limit}; value null: the scene has none of it.
| (if $r == null then [] else
    rows as $rows | $rows[0] as $first | $rows[-1] as $last
    | ($p.case.gravity // [0, 0, -9.81] | map(. * .) | add | sqrt) as $g | $p.case.particle_spacing as $dp
    | ([$p.case.terrain.profile[][1]] | min) as $low
    | ([($p.case.water.level // $low) - $low, ($p.case.slide.bodies // [] | map(map(.[1])[] - $low) | max // 0)] | max) as $height
    | ($r.particles.water + $r.particles.soil) as $moving
    | [{name: "energy created", value: $r.error_budget.energy_created, limit: 0.02},
       {name: "density error", value: $r.error_budget.density_error_p999, limit: 0.03},
       {name: "interpenetration", value: $r.error_budget.interpenetrating_share, limit: 0.05},
       {name: "momentum residual", value: $r.error_budget.momentum_residual, limit: 1e-4},
       {name: "lost", value: (($r.lost.water + $r.lost.soil) / $moving), limit: 0.01},
       {name: "below the bed", value: ($r.below_bed / $moving), limit: 0.02}]
      + (if $p.rest then
          [{name: "water moves at rest", value: (if $r.particles.water > 0 then $last.max_water_speed / ($g * $height | sqrt) else null end), limit: 0.05},
           {name: "soil moves at rest", value: (if $r.particles.soil > 0 then $last.max_soil_speed / ($g * $height | sqrt) else null end), limit: 0.05},
           {name: "displacement at rest (dp)", value: (($last.potential_energy - $first.potential_energy) / ($last.mass * $g * $dp) | fabs), limit: 0.1},
           {name: "soil displaced at rest (dp)", value: (if $r.particles.soil > 0 then
               ([$last.soil_x - $first.soil_x, $last.soil_z - $first.soil_z] | map(. * .) | add | sqrt) / $dp else null end), limit: 0.1}]
        else [] end)
  end) as $criteria
| ($criteria | map(select(.value != null and (.value <= .limit | not))) | first) as $broken
| (if $status == 2 then {outcome: "refused", pass: ($p.expect == "refused" and ($lines | length) == 1), criterion: "refused"}
   elif $status == 124 then {outcome: "time limit", pass: false, criterion: "time limit"}
   elif $status == 1 then {outcome: "stopped", pass: false, criterion: "finite"}
   elif $status != 0 or $r == null then {outcome: "crashed", pass: false, criterion: "exit status \($status)"}
   elif $p.expect == "refused" then {outcome: "ran", pass: false, criterion: "not refused"}
   elif $broken then {outcome: "ran", pass: false, criterion: "\($broken.name) \($broken.value | size)"}
   else {outcome: "ran", pass: true, criterion: "all"} end)
+ ($p | {id, axis, value, scene, variant, dimension, expect}) + {
  particle_spacing_m: $p.case.particle_spacing,
  particles: ($r | if . then .particles | .water + .soil + .wall else null end),
  dt_s: $r.time_step_s.mean, cfl: $r.cfl,
  dt_limited_by: ($r.time_step_limited_by // {} | to_entries | max_by(.value) | .key),
  wall_time_s: $seconds,
  announced: (if $r == null then $lines[0] else $r.warnings | join("; ") end)}
