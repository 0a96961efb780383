# Summaries of lgiw-run, named scene.who.round.json -> one object a scene: the medians over the rounds.
include "run-record";
def median: sort | .[(length - 1) / 2 | floor];
def path_parts: input_filename | split("/") | last | split(".");
[inputs | . + {scene: path_parts[0], who: path_parts[1]}]
| group_by(.scene)
| map(
    map(select(.who == "this")) as $this | map(select(.who == "other")) as $other | $this[0] as $s
    | {
        scene: $s.scene,
        particles: $s.particles,
        steps: $s.steps
      }
      + ($s | machine)
      + {
        rounds: ($this | length),
        particle_steps_per_s: ($this | map(.stepping_particle_steps_per_s) | median),
        lowest_and_highest: ($this | map(.stepping_particle_steps_per_s) | [min, max]),
        neighbours_per_particle: $s.neighbours_per_particle,
        phase_shares: ($s.phase_seconds | (map(values) | add) as $sum | map_values(. / $sum)),
        wall_time_shares: ($s | wall_time_shares),
        bytes_per_particle: ($s.bytes / ($s.particles | .water + .soil + .wall)),
        bytes_of: $s.bytes_per_particle,
        peak_memory_bytes: ($this | map(.peak_memory_bytes) | max),
        start_and_output_s: ($this | map(.wall_time_s - .stepping_time_s) | median)
      }
      + if $other == [] then {} else {
          other_version: $other[0].version,
          ratio: (($this | map(.stepping_particle_steps_per_s) | median) / ($other | map(.stepping_particle_steps_per_s) | median))
        } end)
