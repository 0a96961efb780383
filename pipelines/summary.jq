# One page from summary.json: jq -r --arg uncertainty "a line" -f summary.jq summary.json
def fixed($digits): # a number with so many decimals; jq 1.6 has no printf
  if . == null then "-"
  else pow(10; $digits) as $p | (. * $p | round) as $n | ($n | fabs) as $a
    | (if $n < 0 then "-" else "" end) + ($a / $p | floor | tostring)
    + (if $digits == 0 then "" else "." + (($a % $p + $p) | tostring | .[1:]) end)
  end;
def pad($width): (" " * ([$width - length, 0] | max) // "") + .;
def fill($width): . + (" " * ([$width - length, 0] | max) // "");
def thousands: tostring | [match("\\d{1,3}(?=(\\d{3})*$)"; "g").string] | join(",");
def scientific: # two significant digits
  if . == null then "-" elif . == 0 then "0"
  else (fabs | log10 | floor) as $e | (. / pow(10; $e) | fixed(1)) + "e" + ($e | tostring) end;
def short: # fewer decimals the larger: from flumes to canyons
  if . == null then "-" elif fabs >= 10 then fixed(1) elif fabs >= 1 then fixed(2) else fixed(4) end;
def place: if fabs >= 1000 then fixed(0) else fixed(2) end;
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
def volume: if . == null then "-" elif fabs >= 1e5 then (. / 1e6 | fixed(2)) + " million m3" else short + " m3" end;

"Case \(.case)",
"",
"  particles        water \(.particles.water | thousands), soil \(.particles.soil | thousands), " +
  "wall \(.particles.wall | thousands); wall particles left out \(.particles.left_out | thousands)",
"  run              \(.steps | thousands) steps in \(.wall_time_s | fixed(0)) s, " +
  "\(.particle_steps_per_s / 1e6 | fixed(2)) million particle-steps/s",
"  slide            \(.slide_volume_m3 | volume), of which \(.immersed_volume_m3 | volume) entered the water; " +
  "fastest \(.max_slide_speed_m_s | short) m/s",
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
