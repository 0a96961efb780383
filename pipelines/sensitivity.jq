# How far each variant moves the results: jq -s --arg variants "a b" -f sensitivity.jq plan summary convergence variant...
def wave: [.gauges[] | select(.surface == "water" and .max_height_m != null)] | max_by(.max_height_m);
def quantities: [
  {quantity: "max_wave_height_m", label: "wave height", unit: "m", value: (wave | .max_height_m)},
  {quantity: "runup_m", label: "run-up", unit: "m", value: .runup_m},
  {quantity: "slide_volume_m3", label: "slide volume", unit: "m3", value: .slide_volume_m3},
  {quantity: "immersed_volume_m3", label: "immersed volume", unit: "m3", value: .immersed_volume_m3}];
def of($name): .[] | select(.quantity == $name) | .value;
def largest: map(select(. != null) | fabs) | max;

.[0] as $plan | .[1] as $base | .[2] as $convergence | .[3:] as $runs
| ($variants | split(" ")) as $names
| ([$names, ($runs | map(quantities))] | transpose | map({key: .[0], value: .[1]}) | from_entries) as $results
| ($base | wave | .name?) as $gauge
| (($base.sections // []) | map(select(.runup_m != null)) | max_by(.runup_m) | .name?) as $section
# The convergence of the gauge and the section that hold the maxima.
| def numerical($q): ($convergence.quantities | map(select(
    if $q == "max_wave_height_m" then .name == $gauge and .quantity == "max_height_m"
    elif $q == "runup_m" then .name == $section and .quantity == $q
    else .name == "slide" and .quantity == $q end)) | .[0]);
[$base | quantities[] | select(.value != null and .value != 0) | . as $row
  | ($names | map({key: ., value: ([$results[.] | of($row.quantity)] | .[0]
      | if . == null then null else . - $row.value end)}) | from_entries) as $changes
  | numerical(.quantity) as $n
  | . + {changes: $changes,
         friction: ([$changes.friction_low, $changes.friction_high] | largest),
         level: ([$changes.level_low, $changes.level_high] | largest),
         numerical: ($n.error? // null), basis: ($n.used? // "none")}
  | (.value | fabs) as $v
  | .percent = {friction: (if .friction then 100 * .friction / $v else null end),
                level: (if .level then 100 * .level / $v else null end),
                numerical: (if .numerical then 100 * .numerical / $v else null end)}
    | .dominates = (.percent | to_entries | map(select(.value != null and .value > 0)) | max_by(.value) | .key?)] as $rows
| ($plan.steps | {friction: "friction +-\(.friction_angle_deg) deg", level: "level +-\(.level_m) m",
                  numerical: "spacing x\(.dp_factors | map(tostring) | join(", x"))"}) as $words
| {case: $base.case, steps: $plan.steps, variants: $names, sources: $words, rows: $rows,
   line: (if ($rows | length) == 0 then "nothing to compare"
          else ($rows | map("\(.label) \(if .dominates then "\($words[.dominates]) (\(.percent[.dominates] * 10 | round / 10) %)" else "nothing" end)") | join(", ")) as $list
            | "dominated by: \($list)" end)}
