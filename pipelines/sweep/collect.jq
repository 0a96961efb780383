# sweep.json from runs.json and what each run gave: jq -s --arg case NAME --slurpfile plan runs.json -f collect.jq
def wave: [(.gauges // [])[] | select(.surface == "water" and .max_height_m != null)];
{case: $case, keys: $plan[0].keys,
 runs: [[$plan[0].runs, .] | transpose[] | .[0] as $run | .[1]
  | {name: $run.name, inputs: $run.inputs}
    + if .error then {error: (.error | gsub("\n"; " ") | sub(" +$"; ""))}
      else .summary | {
        gauges: ((.gauges // []) | map({name, max_height_m, arrival_s})),
        max_height_m: (wave | map(.max_height_m) | max), highest_gauge: (wave | max_by(.max_height_m) | .name?),
        runup_m, shore_runup_m, slide_volume_m3, immersed_volume_m3, max_slide_speed_m_s, still_water_level_m, particle_spacing_m,
        particles: (.particles | .water + .soil + .wall), wall_time_s, threads, warnings: (.warnings // [])} end]}
