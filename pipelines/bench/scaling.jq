# Summaries of lgiw-run, named scene.sizes.N.json and scene.threads.N.json -> cost per particle-step against size, efficiency
# against threads.
include "run-record";
def path_parts: input_filename | split("/") | last | split(".");
[inputs | . + {scene: path_parts[0], what: path_parts[1]}]
| {
    sizes: (map(select(.what == "sizes")) | group_by(.scene) | map(sort_by(total_particles)
      | {scene: .[0].scene, bar: 0.15} + (.[0] | machine) + {
          runs: map({particles, steps, total: total_particles, neighbours_per_particle, peak_memory_bytes,
                     stepping_time_s, ns_per_particle_step: (1e9 / .stepping_particle_steps_per_s)})
        }
      | .spread = ((.runs | map(.ns_per_particle_step) | max / min) - 1)
      | .within_bar = (.spread <= .bar))),
    threads: (map(select(.what == "threads")) | group_by(.scene) | map(sort_by(.threads) | .[0] as $first
      | {scene: $first.scene, particles: $first.particles} + {
          runs: map({threads, steps, particle_steps_per_s: .stepping_particle_steps_per_s,
                     efficiency: (.stepping_particle_steps_per_s / $first.stepping_particle_steps_per_s * $first.threads / .threads)})
        }))
  }
