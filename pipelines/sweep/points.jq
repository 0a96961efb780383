# What the figure of a sweep draws, a row a point: key, quantity, x, label of x, value: jq -r -L FOLDER -f points.jq sweep.json
# Keys whose values are no numbers are drawn in their order.
include "sweep/values";
[.runs[] | select(.error | not)] as $done
| {max_height_m: "highest wave (m)", runup_m: "run-up (m)",
   slide_volume_m3: "slide (million m3)", immersed_volume_m3: "immersed (million m3)"} as $names
| ($done | map(.slide_volume_m3 // 0) | max) as $largest
| .keys[] as $key
| long_values($key) as $long
| [$done[].inputs[$key]] as $values
| ($values | map(type == "number") | all) as $numbers
| ($values | reduce .[] as $v ([]; if index([$v]) then . else . + [$v] end)) as $order
| ($names | keys_unsorted[]) as $quantity
| $done[] | select(.[$quantity] != null) | .inputs[$key] as $value
| (if $quantity | endswith("m3") then if $largest >= 1e4 then 1e-6 else 1 end else 1 end) as $unit
| [$key, ($names[$quantity] | if $unit == 1 then sub("million "; "") else . end),
   (if $numbers then $value else ($order | index([$value])) end),
   ($value | shown($long) | gsub(","; "") | sub("^[^ ]*/(?=[^/ ]+$)"; "")), .[$quantity] * $unit]  # of files the name
| @csv | gsub("\""; "")
