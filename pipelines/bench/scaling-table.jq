# scaling.json as tables.
include "run-record";
def percent(share): "\(share * 100 | round) %";
([["scene", "particles", "of them walls", "steps", "neighbours", "ns/particle-step", "rounds differ by", "peak bytes/particle"]]
  + [.sizes[] | .scene as $scene | .runs[] | [$scene, .total, .particles.wall, .steps, (.neighbours_per_particle | round),
     (.ns_per_particle_step | rounded(1)), percent(.rounds_differ_by), (.peak_memory_bytes / .total | round)]] | table),
(.sizes[] | "\(.scene): cost per particle-step differs by \(.spread * 100 | round) % between \(.runs[0].total) and \(.runs[-1].total) particles: \(if .within_bar then "within" else "MORE THAN" end) \(.bar * 100) %"),
(.sizes[] | select(.by_kind) | "\(.scene): with \(.by_kind.ns_per_moving | round) ns a step for what moves and \(.by_kind.ns_per_wall | round) ns for a wall particle, by \(.by_kind.spread * 100 | round) %"),
(select(.threads | length > 0) | "",
  ([["scene", "threads", "M particle-steps/s", "rounds differ by", "efficiency"]]
    + [.threads[] | .scene as $scene | .runs[] | [$scene, .threads, (.particle_steps_per_s / 1e6 | rounded(2)), percent(.rounds_differ_by), (.efficiency | rounded(2))]] | table))
