# Summaries of lgiw-run, named scene.sizes.N.ROUND.json and scene.threads.N.ROUND.json -> cost per particle-step against size,
# efficiency against threads. Of rounds the fastest counts; rounds_differ_by tells how far the slowest was from it.
include "run-record";
# Walls cost less than what moves, and their share falls as a scene is refined: the time of a step as a sum over both, fitted so
# that the squares of the relative differences are least, and what differs beyond that.
def by_kind:
  map((.stepping_time_s / .steps * 1e9) as $t | {m: ((.total - .particles.wall) / $t), w: (.particles.wall / $t)})
  | (map(.m * .m) | add) as $mm | (map(.m * .w) | add) as $mw | (map(.w * .w) | add) as $ww
  | (map(.m) | add) as $m | (map(.w) | add) as $w | ($mm * $ww - $mw * $mw) as $det
  | if $det <= 1e-9 * $mm * $ww then null else
      (($m * $ww - $w * $mw) / $det) as $moving | (($w * $mm - $m * $mw) / $det) as $wall
      | map($moving * .m + $wall * .w) | {ns_per_moving: $moving, ns_per_wall: $wall, spread: (max / min - 1)}
    end;
def fastest(key): group_by(key) | map(sort_by(.stepping_particle_steps_per_s) | last
  + {rounds_differ_by: (last.stepping_particle_steps_per_s / first.stepping_particle_steps_per_s - 1)});
def path_parts: input_filename | split("/") | last | split(".");
[inputs | . + {scene: path_parts[0], what: path_parts[1]}]
| {
    sizes: (map(select(.what == "sizes")) | group_by(.scene) | map(fastest(total_particles)
      | {scene: .[0].scene, bar: 0.15} + (.[0] | machine) + {
          runs: map({particles, steps, total: total_particles, neighbours_per_particle, peak_memory_bytes,
                     stepping_time_s, rounds_differ_by, ns_per_particle_step: (1e9 / .stepping_particle_steps_per_s)})
        }
      | .by_kind = (.runs | by_kind)
      | .spread = ((.runs | map(.ns_per_particle_step) | max / min) - 1)
      | .within_bar = (.spread <= .bar))),
    threads: (map(select(.what == "threads")) | group_by(.scene) | map(fastest(.threads) | .[0] as $first
      | {scene: $first.scene, particles: $first.particles} + {
          runs: map({threads, steps, rounds_differ_by, particle_steps_per_s: .stepping_particle_steps_per_s,
                     efficiency: (.stepping_particle_steps_per_s / $first.stepping_particle_steps_per_s * $first.threads / .threads)})
        }))
  }
