# The table of a sweep, a row a run: jq -r -f csv.jq sweep.json
. as $sweep
| ([.runs[].gauges[]?.name] | reduce .[] as $name ([]; if index([$name]) then . else . + [$name] end)) as $gauges
| ["max_height_m", "runup_m", "shore_runup_m", "slide_volume_m3", "immersed_volume_m3", "max_slide_speed_m_s", "particles", "wall_time_s", "threads"] as $results
| (["run"] + .keys + ["status"] + $results + ($gauges | map("height_\(.)_m", "arrival_\(.)_s")) + ["warnings", "error"]),
  (.runs[] | . as $run
   | [.name] + [.inputs[$sweep.keys[]]] + [if .error then "failed" else "done" end] + [.[$results[]]]
     + [$gauges[] as $name | first(($run.gauges // [])[] | select(.name == $name)) // {} | .max_height_m, .arrival_s]
     + [(.warnings // []) | join("; ")] + [.error])
| @csv
