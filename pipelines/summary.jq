# One page from summary.json: jq -r -L FOLDER --arg uncertainty "a line" -f summary.jq summary.json
include "numbers";
def pad($width): (" " * ([$width - length, 0] | max) // "") + .;
def fill($width): . + (" " * ([$width - length, 0] | max) // "");
def beside($a; $b): "\($a | short) m" + (if $b == null then "" else " (simulated \($b | short))" end);
# Two lines of impulse.json: the first gauge beyond the impact zone (or else the first), the first bank, the limits.
def empirical:
  (.places | map(select(.kind == "gauge" and (.estimates | length) > 0))) as $gauges
  | ([$gauges[] | select(.in_impact_zone | not)] + $gauges)[0] as $gauge
  | ([.places[] | select(.kind == "bank" and (.estimates | length) > 0)])[0] as $bank
  | if .numbers == null then .notes | join("; ")
    else "VAW 254, P \(.numbers.P | fixed(2)): " +
      ([if $gauge then ($gauge.estimates[] | select(.formula == "VAW 254" and .quantity == "first_crest_m"))
          | "first crest at \($gauge.name) \(beside(.predicted; .simulated))"
        else (.places[0].estimates[0] | "largest crest \(.predicted | short) m") end,
        if $bank then $bank.estimates[0]
          | "run-up at \($bank.name) by \(.formula)\(if .verified then "" else " (recalled)" end) \(beside(.predicted; .simulated))" else empty end] | join(", ")) +
      "\n                   limits of its tests broken: " +
      ([.places[].estimates[] | select(.formula == "VAW 254") | .limits_broken[] | "\(.quantity) \(.value | fixed(2))"]
        | reduce .[] as $limit ([]; if any(.[]; split(" ")[0] == ($limit | split(" ")[0])) then . else . + [$limit] end)
        | if length == 0 then "none" else join(", ") end) end;

"Case \(.case)",
"",
"  particles        water \(.particles.water | thousands), soil \(.particles.soil | thousands), " +
  "wall \(.particles.wall | thousands); wall particles left out \(.particles.left_out | thousands)",
"  run              \(.steps | thousands) steps in \(.wall_time_s | fixed(0)) s, " +
  "\(.particle_steps_per_s / 1e6 | fixed(2)) million particle-steps/s",
(if .slide_volume_m3 then "  slide            \(.slide_volume_m3 | volume), of which \(.immersed_volume_m3 | volume) entered the water; " +
  "fastest \(.max_slide_speed_m_s | short) m/s" else empty end),
"  run-up           \(.runup_m | short) m above still level on the opposite bank",
(if .impulse_wave then "  empirical        \(.impulse_wave | empirical)" else empty end),
"  conservation     mass error \(.mass_error | scientific), density error \(.density_error | scientific)",
"  uncertainty      \($uncertainty)",
((.warnings // [])[] | "  warning          \(.)"),
"  left out         \(if (.left_out | length) == 0 then "nothing" else (.left_out | join("\n                   ")) end)",
"",
"  \("gauge" | fill(10)) \("x (m)" | pad(10)) \("y (m)" | pad(11)) \("highest (m)" | pad(12)) " +
  "\("height (m)" | pad(11)) \("arrival (s)" | pad(12))",
(.gauges[] | "  \(.name | fill(10)) \(.x | place | pad(10)) \(.y | place | pad(11)) " +
  "\(.max_elevation_m | short | pad(12)) \(.max_height_m | short | pad(11)) \(.arrival_s | short | pad(12))")
