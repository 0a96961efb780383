# One table from sensitivity.json: jq -r -f sensitivity-text.jq sensitivity.json
def fill($width): . + (" " * ([$width - length, 0] | max) // "");
def pad($width): (" " * ([$width - length, 0] | max) // "") + .;
def significant: # four digits
  if . == null then "-" elif . == 0 then "0"
  else (fabs | log10 | floor) as $e | pow(10; 3 - $e) as $p | (. * $p | round) / $p | tostring end;
def percent: if . == null then "-" else (. * 10 | round / 10 | tostring) + " %" end;

"What moves the results of \(.case): largest change against the case as it is",
"",
"  \("quantity" | fill(20)) \("value" | pad(12)) \(.sources.friction | pad(22)) \(.sources.level | pad(20)) " +
  "\("numerical error" | pad(17))  dominates",
(.rows[] | "  \("\(.label) (\(.unit))" | fill(20)) \(.value | significant | pad(12)) " +
  "\(.percent.friction | percent | pad(22)) \(.percent.level | percent | pad(20)) " +
  "\(.percent.numerical | percent | pad(17))  \(.dominates // "-")"),
"",
"  numerical error from \(.sources.numerical): " +
  ([.rows[] | "\(.label) by \(if .basis == "gci" then "grid convergence index" else .basis end)"] | join(", ")),
"  \(.line)"
