# summary.json from the tools' own summaries: jq -s -f merge.jq run.json gauges.json [slide.json] [impulse.json]
reduce .[] as $part ({}; . * $part)
| {case, particles, steps, wall_time_s, particle_steps_per_s, left_out, gauges, runup_m, slide_volume_m3,
   immersed_volume_m3, max_slide_speed_m_s, mass_error, density_error} + .
