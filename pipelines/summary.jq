# One page from summary.json: jq -r -L FOLDER --arg uncertainty "a line" -f summary.jq summary.json
include "numbers";
def pad($width): (" " * ([$width - length, 0] | max) // "") + .;
def fill($width): . + (" " * ([$width - length, 0] | max) // "");

"Case \(.case)",
"",
"  particles        water \(.particles.water | thousands), soil \(.particles.soil | thousands), " +
  "wall \(.particles.wall | thousands); wall particles left out \(.particles.left_out | thousands)",
"  run              \(.steps | thousands) steps in \(.wall_time_s | fixed(0)) s, " +
  "\(.particle_steps_per_s / 1e6 | fixed(2)) million particle-steps/s",
"  slide            \(.slide_volume_m3 | volume), of which \(.immersed_volume_m3 | volume) entered the water; " +
  "fastest \(.max_slide_speed_m_s | short) m/s",
"  run-up           \(.runup_m | short) m above still level on the opposite bank",
"  conservation     mass error \(.mass_error | scientific), density error \(.density_error | scientific)",
"  uncertainty      \($uncertainty)",
((.warnings // [])[] | "  warning          \(.)"),
"  left out         \(if (.left_out | length) == 0 then "nothing" else (.left_out | join("\n                   ")) end)",
"",
"  \("gauge" | fill(10)) \("x (m)" | pad(10)) \("y (m)" | pad(11)) \("highest (m)" | pad(12)) " +
  "\("height (m)" | pad(11)) \("arrival (s)" | pad(12))",
(.gauges[] | "  \(.name | fill(10)) \(.x | place | pad(10)) \(.y | place | pad(11)) " +
  "\(.max_elevation_m | short | pad(12)) \(.max_height_m | short | pad(11)) \(.arrival_s | short | pad(12))")
