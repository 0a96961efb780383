# bars.json as a table.
include "run-record";
([["run", "particles (left out)", "computed", "M particle-steps/s", "wall time", "whole run", "of its bar", "bar"]]
  + map([.name, "\(.total) (\(.particles.left_out))", "\(.computed_s | rounded(3)) of \(.end_time_s) s",
         (.particle_steps_per_s / 1e6 | rounded(2)), "\(.wall_time_s | round) s",
         "\(.whole_s / 60 | rounded(1)) min\(if .extrapolated then ", EXTRAPOLATED" else "" end)", (.times_the_bar | rounded(2)), .bar]) | table),
(if any(.extrapolated) then
   "Extrapolated in proportion to model time, from a start in which nothing is fast yet and steps are longest; WHOLE=1 runs all of it."
 else empty end),
(.[] | "\(.name): \(if .threads then "\(.threads) threads, \(.instructions)" else .device end); \(.note); its bar would do for \(.model_time_within_bar_s | rounded(1)) s of model time")
