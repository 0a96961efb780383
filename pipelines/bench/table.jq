# bench.json as a table.
def millions: . / 1e6 * 100 | round / 100;
def padded($n): tostring | . + (" " * ([0, $n - length] | max));
(["scene", "particles", "M particle-steps/s", "(rounds)", "bytes", "largest phases"] + if .[0].ratio then ["against the other"] else [] end),
(.[] | [
    .scene,
    (.particles | "\(.water) + \(.soil) + \(.wall)"),
    (.particle_steps_per_s | millions),
    (.lowest_and_highest | map(millions | tostring) | join("-")),
    (.bytes_per_particle | round),
    (.phase_shares | to_entries | sort_by(-.value) | .[:3] | map("\(.key) \(.value * 100 | round) %") | join(", "))
  ] + if .ratio then [(.ratio * 100 | round / 100)] else [] end)
| [.[0] | padded(12)] + [.[1] | padded(26)] + [.[2] | padded(19)] + [.[3] | padded(12)] + [.[4] | padded(6)] + .[5:] | join(" ")
