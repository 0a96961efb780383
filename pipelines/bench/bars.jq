# A summary of lgiw-run, with its $bar of bars.json and the $end_time of the whole run, s -> what the whole run takes against the bar.
include "run-record";
{name: $name, particles, total: total_particles, particle_spacing_m} + machine + {
  steps,
  computed_s: .end_time_s,
  end_time_s: $end_time,
  extrapolated: (.end_time_s < 0.999 * $end_time),
  wall_time_s,
  particle_steps_per_s: .stepping_particle_steps_per_s,
  neighbours_per_particle,
  wall_time_shares: wall_time_shares
}
| .whole_s = .wall_time_s * (if .extrapolated then .end_time_s / .computed_s else 1 end)
| . + $bar
| .times_the_bar = .whole_s / .bar_s
| .model_time_within_bar_s = .bar_s * .computed_s / .wall_time_s
