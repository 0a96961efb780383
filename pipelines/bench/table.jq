# bench.json as a table.
include "run-record";
def millions: . / 1e6 | rounded(2);
[["scene", "particles", "M particle-steps/s", "(rounds)", "on", "neighbours", "bytes (water, soil, wall)"]
  + (if .[0].ratio then ["against the other"] else [] end) + ["largest shares of wall time"]]
+ map([
    .scene,
    (.particles | "\(.water) + \(.soil) + \(.wall)"),
    (.particle_steps_per_s | millions),
    (.lowest_and_highest | map(millions | tostring) | join("-")),
    (if .threads then "\(.threads) threads, \(.instructions)" else .device end),
    (.neighbours_per_particle | round),
    "\(.bytes_per_particle | round) (\(.bytes_of | [.water, .soil, .wall] | map(if . then round else "-" end) | map(tostring) | join(", ")))"
  ] + (if .ratio then [.ratio | rounded(2)] else [] end)
  + [.wall_time_shares | to_entries | sort_by(-.value) | .[:4] | map("\(.key) \(.value * 100 | round) %") | join(", ")])
| table
