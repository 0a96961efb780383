# A sweep as people read it, a line a run: jq -r -L FOLDER -f text.jq sweep.json
include "numbers";
include "sweep/values";
def pad($width): (" " * ([$width - length, 0] | max) // "") + .;
def fill($width): . + (" " * ([$width - length, 0] | max) // "");
# Volumes in one unit for all runs, millions where they are that large.
def volumes($large): if . == null then "-" elif $large then . / 1e6 | fixed(2) else short end;
# Rows of texts; the first column is left-aligned.
def table: (transpose | map(map(length) | max)) as $widths
  | .[] | [[., $widths] | transpose[] | {text: .[0], width: .[1]}] | to_entries
  | map(if .key == 0 then .value.text as $t | .value.width as $w | $t | fill($w) else .value.text as $t | .value.width as $w | $t | pad($w) end)
  | "  " + join("  ") | sub(" +$"; "");
def range_of(f): [.[] | f | select(. != null)] | if length == 0 then null else {low: min, high: max} end;

. as $sweep
| ([.runs[] | select(.error | not)]) as $done
| ([.runs[].gauges[]?.name] | reduce .[] as $name ([]; if index([$name]) then . else . + [$name] end)) as $gauges
| (([$done[].slide_volume_m3 // 0] | max) as $v | $v != null and $v >= 1e5) as $large
| (if $large then "million m3" else "m3" end) as $unit
| [.keys[] as $key | {$key, values: long_values($key)}] as $long
| def height($name): first((.gauges // [])[] | select(.name == $name) | .max_height_m) // null;
  def results: [($gauges[] as $name | height($name) | short), (.runup_m | short), (.slide_volume_m3 | volumes($large)), (.immersed_volume_m3 | volumes($large))];
  def line($title; f): [$title] + ($sweep.keys | map("")) + [($gauges[] as $name | $done | range_of(height($name)) | if . then f else null end | short),
    ($done | range_of(.runup_m) | if . then f else null end | short),
    ($done | range_of(.slide_volume_m3) | if . then f else null end | volumes($large)),
    ($done | range_of(.immersed_volume_m3) | if . then f else null end | volumes($large))] + ["", "", ""];
"Sweep of \(.case): \(.runs | length) runs\(if ($done | length) < (.runs | length) then ", \((.runs | length) - ($done | length)) of them failed" else "" end)",
"",
([["run"] + .keys + ($gauges | map("\(.) (m)")) + ["run-up (m)", "slide (\($unit))", "immersed", "time (s)", "threads", "warnings"]]
 + [.runs[] | . as $run | [.name] + [$long[] as $l | .inputs[$l.key] | shown($l.values)]
     + if .error then ($gauges | map("-")) + ["-", "-", "-", "-", "-", "FAILED"]
       else results + [(.wall_time_s | fixed(0)), (.threads | in_full), (.warnings | length | if . == 0 then "-" else tostring end)] end]
 + (if ($done | length) > 1 then [line("lowest"; .low), line("highest"; .high)] else [] end)
 | table),
"",
"  Columns of gauges: greatest height of the surface above the still water level (of the ground on land).",
($long[] | .key as $key | .values | to_entries[]
  | "  \($key) #\(.key + 1): \(.value | if length > 100 then .[:100] + "... (in full in sweep.csv)" else . end)"),
([$done[] | .name as $name | .warnings[] | {warning: ., $name}] | group_by(.warning)[]
  | "  warning: \(.[0].warning) (\(if length == ($done | length) then "all runs" else map(.name) | join("; ") end))"),
(.runs[] | select(.error) | "  failed:  \(.name): \(.error)")
