# The report of a run as one page of HTML. Named arguments: the contents of style.css; sentences of the case that call it
# `invented`; the `date` of the run; the summary's line of `uncertainty`; the arrival `threshold` (m); the JSON files of
# the run, by name. What a file says is escaped on its way into the page (text, items, paragraph, table); only this program
# writes markup, such that it is XML as well.
include "numbers";

def text: @html "\(.)";
# Three digits and no more than it has; volumes and the like in full.
def amount:
  if . == null then "-" elif . == 0 then "0" elif . < 0 then "-" + (-. | amount)
  elif . >= 1000 then fixed(0) | thousands
  elif . == floor then tostring
  elif . >= 0.001 then (2 - (log10 | floor)) as $digits | fixed([$digits, 1] | max)
  else scientific end;
def with_unit($unit): if . == null then "-" else "\(amount) \($unit)" end;
def elevation: if . == null then "-" elif fabs < 10 then amount else fixed(1) end; # to the decimetre also high above the datum
def given: . * 1e6 | round / 1e6 | tostring; # as the case gives it
def percent: if . == null then "-" else "\(100 * . | if . == 0 then "0" elif fabs < 0.01 then scientific else fixed(if fabs >= 10 then 0 elif fabs >= 1 then 1 else 2 end) end) %" end;
def paragraph: if . == null or . == "" then empty else "<p>\(text)</p>" end;
def items: if length == 0 then empty else "<ul>", (.[] | "<li>\(text)</li>"), "</ul>" end;
# Columns are [heading, program of a cell]; numbers stand to the right.
def table($caption; $headings; rows):
  [rows] as $rows
  | if ($rows | length) == 0 then empty else
      ([range($headings | length)] | map(. as $c | $rows | any(.[$c] | type == "number" or (type == "string" and test("^-?[0-9][0-9.,]*(e-?[0-9]+)?( to -?[0-9.,]+(e-?[0-9]+)?)?( %|\\*)?$"))))) as $numbers
      | def cell($tag; $c): "<\($tag)\(if $numbers[$c] then " class=\"number\"" else "" end)>\(. // "-" | text)</\($tag)>";
      "<div class=\"scroll\"><table><caption>\($caption | text)</caption>",
      "<thead><tr>" + ([range($headings | length) as $c | $headings[$c] | cell("th"; $c)] | add) + "</tr></thead><tbody>",
      ($rows[] | . as $row | "<tr>" + ([range($headings | length) as $c | $row[$c] | cell("td"; $c)] | add) + "</tr>"),
      "</tbody></table></div>"
    end;
def file($name): $ARGS.named[$name][0]?;
def figure($name; $caption): file("pictures")[$name] as $data
  | if $data then "<figure class=\"\($name)\"><img src=\"\($data)\" alt=\"\($caption | text)\"/><figcaption>\($caption | text)</figcaption></figure>" else empty end;
def section($title; body): [body] | if length == 0 then empty else "<section><h2>\($title | text)</h2>", .[], "</section>" end;
def subsection($title; body): [body] | if length == 0 then empty else "<h3>\($title | text)</h3>", .[] end;
# first_crest_m: first crest (m)
def words: sub("_m_s$"; " (m/s)") | sub("_kg_m3$"; " (kg/m3)") | sub("_(?<unit>m|m3|s)$"; " (\(.unit))") | sub("_deg$"; " (degrees)") | gsub("_"; " ");
# What a reader opens who wants it; on paper it is open.
def folded($summary; body): [body] | if length == 0 then empty else "<details><summary>\($summary | text)</summary>", .[], "</details>" end;
def span: map(select(. != null)) | if length == 0 then "-" else (min | amount) as $low | (max | amount) as $high | if $low == $high then $low else "\($low) to \($high)" end end;
# Empirical formulas beside the run, as impulse-wave sums them up: a row a formula and quantity over all places, those within
# the tests that they were fitted to first; then each place.
def starred: "\(.formula)\(if .verified then "" else "*" end)";
def outside: if .limits_known == false then "not known" else [.limits_broken[]?.quantity] | unique | join(", ") | if . == "" then "-" else . end end;
def families:
  [.places[]? | . as $place | .estimates[]? | . + {place: $place.kind}]
  | reduce .[] as $e ({}; .["\($e.quantity) \($e.formula)"] += [$e])
  | map({quantity: (.[0].quantity | words), formula: (.[0] | starred), compared: map(select(.simulated != null and .predicted != null)), all: .,
         outside: ({limits_known: .[0].limits_known, limits_broken: map(.limits_broken[]?)} | outside)})
  | to_entries | sort_by((.value.outside | if . == "-" then 0 elif . == "not known" then 2 else 1 end), .key) | map(.value);
def empirical:
  (families) as $families
  | ($families | map(select(.outside == "-")) | length) as $within
  | (if ($families | length) == 0 then empty
     elif $within == 0 then "None of these formulas is within the tests that it was fitted to: they show the order of magnitude at best."
     else "\($within) of \($families | length) are within the tests that they were fitted to, and stand first." end | paragraph),
  table("Formulas beside this run, over all places that have both; * recalled, not checked against its source";
    ["quantity", "formula", "places", "estimate", "this run", "run / estimate", "outside its tests in"];
    $families[] | (if (.compared | length) > 0 then .compared else .all end) as $shown
      | [.quantity, .formula, ($shown | length), ($shown | map(.predicted) | span), ($shown | map(.simulated) | span),
         ([.compared[] | select(.predicted > 0) | .simulated / .predicted] | span), .outside]),
  (.notes // [] | items),
  folded("The slide at its impact, as the formulas take it";
    table("Numbers as defined in docs/impulse-wave.md"; ["quantity", "value"];
      (.slide // {} | to_entries[] | select(.value | type == "number") | [(.key | words), (.value | amount)]),
      (.numbers // {} | to_entries[] | [.key, (.value | amount)]))),
  folded("Each formula at each place";
    table("Estimates beside this run; * recalled, not checked against its source";
      ["place", "distance (m)", "quantity", "formula", "estimate", "this run", "outside its tests in"];
      .places[]? | . as $place | .estimates[]? | [($place | .name | if . == "" then $place.kind else . end), ($place.distance_m | amount), (.quantity | words),
        starred, (.predicted | amount), (.simulated | amount), outside])),
  folded("Where the slide lies outside the tests that the formulas were fitted to";
    table("Values and tests"; ["formula", "source", "quantity", "value", "tested from", "to"];
      [.places[]?.estimates[]? | {formula, source} + .limits_broken[]?] | unique[] | [.formula, .source, .quantity, (.value | amount), (.low | amount), (.high | amount)]));

file("summary") as $s | file("run_attributes") as $run | file("particles_attributes") as $particles | file("plan") as $plan
| file("shores") as $shores | file("zones") as $zones
| (file("sensitivity") | if .line? == $ARGS.named.uncertainty then . else null end) as $study
| $s.still_water_level_m as $level | ($s.dimension == 2) as $flat | $s.end_time_s as $duration
| (($run.vertical_datum // "") | if . == "" then "the case's datum" else . end) as $datum
| (($run.attribution // "") | if . == "" then "" else " Terrain: \(.)." end) as $credit
| (if $flat then " (2-D; volumes are per metre of width)" else "" end) as $per_metre
| def where: if $flat then "x \(.x | place) m" else "E \(.x | place) m, N \(.y | place) m" end;
  # A maximum in the last fiftieth of the run may not be one.
  def unfinished($time): $time != null and $time > 0.98 * $duration;
  def change($quantity): if $study then ($study.rows[] | select(.quantity == $quantity) | .changes | map(.) | map(select(. != null)) | [(. + [0] | min), (. + [0] | max)]) else empty end;
  def range_of($quantity; $value; show): [change($quantity)] | if length == 0 then "" else .[0] as $c | " (\($value + $c[0] | show) to \($value + $c[1] | show) in the sensitivity study)" end;
  def m: with_unit("m");

  ([$s.gauges[]? | select(.surface == "water" and .max_height_m != null and .max_height_m > 0)] | max_by(.max_height_m)) as $wave
| ([$s.sections[]? | select(.runup_m != null)] | max_by(.runup_m)) as $section
| ($s.warnings // []) as $warnings
| ([$s.gauges[]? | select(.surface == "water" and unfinished(.time_of_max_s)) | .name]) as $rising
| ($ARGS.named.invented | split("\n") | map(select(length > 0))) as $invented

| "<!DOCTYPE html>", "<html lang=\"en\">", "<head>", "<meta charset=\"utf-8\"/>",
"<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>",
"<title>\("Impulse wave: \($s.case)" | text)</title>", "<style>", $ARGS.named.style, "</style>", "</head>", "<body>",
"<h1>\("Impulse wave: \($s.case)" | text)</h1>",
("<p class=\"meta\">\("Report of one run, computed \($ARGS.named.date) by lgiw \($s.version // "")\($per_metre). Lengths in m, times in s since the start of the run\(if $level != null then "; heights above the still water level, \($level | given) m above \($datum)" else "" end)." | text)</p>"),
(if ($invented | length) > 0 then
  "<div class=\"disclaimer\"><p><strong>Not an assessment of a real site.</strong> The case says of itself:</p>", ($invented | items), "</div>" else empty end),

"<div class=\"answer\">",
([ (if $wave then "The largest wave at the gauges is \($wave.max_height_m | m)\(range_of("max_wave_height_m"; $wave.max_height_m; m)) above still level, at \($wave.name) (\($wave | where)), \($wave.time_of_max_s | with_unit("s")) after the start." else empty end),
   (if $zones.lake_maximum? then "In the lake as a whole the surface rises by up to \($zones.lake_maximum.height_m | m) (\($zones.lake_maximum | where))." else empty end),
   (if $shores and ($shores | length) > 0 then "Run-up is highest on shore \($shores[0].shore): \($shores[0].runup_m | m) above still level, to \($shores[0].elevation_m | elevation) m (\($shores[0] | where))." else empty end),
   (if $section then "On the bank opposite the slide, along section \($section.name), run-up is \($section.runup_m | m)\(range_of("runup_m"; $section.runup_m; m))." else empty end),
   (if $zones then if ($zones.hazard_area_m2.land | add) == 0 then "No land is flooded." else "\($zones.hazard_area_m2.land | add / 1e4 | amount) ha of land are flooded, \($zones.hazard_area_m2.land[2] / 1e4 | amount) ha of it more than 3 m deep." end else empty end),
   (if $s.slide_volume_m3 != null then "The slide moves \($s.slide_volume_m3 | volume)\(range_of("slide_volume_m3"; $s.slide_volume_m3; volume)), of which \($s.immersed_volume_m3 | volume)\(range_of("immersed_volume_m3"; $s.immersed_volume_m3; volume)) enter the water." else empty end),
   (if $study then "What moves each most: \($study.line | sub("^dominated by: "; ""))." else "The uncertainty of these numbers was \($ARGS.named.uncertainty | sub(";.*"; ""))." end),
   (if ($warnings | length) > 0 then "Warnings of the run: \($warnings | length), listed below." else empty end),
   (if ($rising | length) > 0 then "At \($rising | join(", ")) the surface was highest at the end of the run: the crest may not have passed." else empty end)
 ] | join(" ") | paragraph),
"</div>",

section("Wave";
  figure("wave-map"; "Highest water surface during the run above hillshade, arrival of the wave in seconds\($ARGS.named.threshold | if . == "" then "" else " (a change of the surface by \(.) m)" end), shoreline at rest and limit of inundation. Isochrones are smoothed by medians of 5 x 5 cells.\($credit)")),

section("Hazard classes";
  figure("hazard-map"; "Strong colours: largest flow depth on flooded land. Pale colours: largest wave height in the lake at rest.\($credit)"),
  (if $zones then table("Areas by class (ha)"; ["", "below 1 m", "1 m to 3 m", "above 3 m"];
     ["land, by largest flow depth", ($zones.hazard_area_m2.land[] / 1e4 | amount)], ["lake at rest, by largest wave height", ($zones.hazard_area_m2.lake[] / 1e4 | amount)]) else empty end)),

section("Run-up";
  figure("shores"; "Highest run-up along each shore; distances from the shore's first point. Shores are numbered as on the map of the wave."),
  (if $shores then table("Highest run-up of each shore, and where"; ["shore", "length (m)", "run-up (m)", "elevation (m)", "at distance (m)", "easting (m)", "northing (m)"];
     $shores[] | [.shore, (.length_m | fixed(0)), (.runup_m | amount), (.elevation_m | elevation), (.distance_m | fixed(0)), (.x | fixed(0)), (.y | fixed(0))]) else empty end),
  table("Run-up along the sections, on the bank opposite the slide"; ["section", "run-up (m)", "elevation (m)", "time (s)"];
     $s.sections[]? | select(.runup_m != null) | [.name, (.runup_m | amount), (.runup_elevation_m | elevation), (.time_of_runup_s | amount)]),
  figure("runup"; "Water's edge on the bank opposite the slide against time.")),

section("Gauges";
  ($s.gauges // [] | map(keys_unsorted[]) | unique | map(select(test("^arrival_.*m_s$")))) as $more
  | ($s.resolution.gauge_depth_particles? // {}) as $depths
  | table("Heights above still level on water, above the first surface on soil. The depth at rest in particles tells how well the wave is resolved there.";
      ["gauge", "x (m)"] + (if $flat then [] else ["y (m)"] end) + ["surface", "highest (m)", "crest (m)", "at (s)", "first trough (m)", "at (s)", "arrival at \($ARGS.named.threshold) m (s)"]
        + ($more | map(sub("arrival_"; "arrival at ") | sub("m_s$"; " m (s)"))) + ["depth (particles)"];
      $s.gauges[]? | . as $g | [.name, (.x | place)] + (if $flat then [] else [.y | place] end) + [.surface, (.max_elevation_m | elevation), (.max_height_m | amount),
        ((.time_of_max_s | amount) + (if .surface == "water" and unfinished(.time_of_max_s) then "*" else "" end)), (.first_trough_m | amount), (.time_of_trough_s | amount), (.arrival_s | amount)]
        + ($more | map($g[.] | amount)) + [$depths[.name] // "-"]),
  (if ($rising | length) > 0 then "* highest at the end of the run: the crest may not have passed." | paragraph else empty end),
  table("Pressure gauges"; ["gauge", "highest pressure (Pa)", "at (s)"]; $s.pressure_gauges[]? | [.name, (.max_pressure_pa | amount), (.time_of_max_s | amount)]),
  figure("gauges"; "Change of the surface at the gauges; dashed: arrival.")),

section("Slide";
  (if $s.slide_volume_m3 == null then empty else table("Slide\($per_metre)"; ["quantity", "value", "unit"];
    (["volume that moved", ($s.slide_volume_m3 | amount), "m3"], ["of which entered the water", ($s.immersed_volume_m3 | amount), "m3"],
     ["volume that stayed", ($s.unmoved_volume_m3 | amount), "m3"], ["volume that left the domain", ($s.lost_soil_volume_m3 | amount), "m3"],
     ["highest speed (99th percentile of the slide)", ($s.max_slide_speed_m_s | amount), "m/s"],
     ["run-out of the centre of mass", ($s.deposit.runout_of_centre_m? | amount), "m"], ["run-out of the front", ($s.deposit.runout_of_front_m? | amount), "m"],
     ["direction of the run-out, from north", ($s.deposit.direction_deg? | amount), "degrees"],
     ["length of the deposit", ($s.deposit.length_m? | amount), "m"], ["width of the deposit", ($s.deposit.width_m? | amount), "m"],
     ["deposit above still level", ($s.deposit.height_above_water_m? | amount), "m"])
    | select(.[1] != "-")) end),
  figure("volumes"; "Volume of the slide, volume that entered the water, and speeds."),
  figure("deposit-map"; "Thickness of the slide at the end of the run.\($credit)"),
  figure("slices"; "Particles in a slice along the first section at several times: plastic strain of the soil, speed of the water."),
  figure("sections"; "Sections: ground before the slide, bed, soil and water at several times.")),

section("How far to trust these numbers";
  subsection("Expected error and warnings";
    (($plan.expected_error? // "") | if . == "" then "" else (.[:1] | ascii_upcase) + .[1:] + "." end | paragraph),
    (if ($warnings | length) > 0 then "<div class=\"warning\">", ($warnings | items), "</div>" else "The run gave no warning." | paragraph end),
    ($s.resolution // {} | table("Resolution, in particles"; ["quantity", "particles"];
      (["particle spacing \($s.particle_spacing_m | given) m; slide thickness, median", .slide_thickness_particles.median?],
       ["slide thickness, thinnest tenth", .slide_thickness_particles.tenth?], ["greatest depth of the water", .water_depth_particles?]) | select(.[1] != null)))),
  subsection("Energy and error budget";
    figure("energy"; "Energy of the scene\(if $flat then " per metre of width" else "" end): what the fall releases, what moves, what is lost to friction, breaking and the sides."),
    ($s.error_budget // {} | table("Error budget of the run"; ["quantity", "value"];
      (["mass that left / mass at the start", (.mass_residual | scientific)], ["momentum: residual of internal forces / sum of forces", (.momentum_residual | scientific)],
       ["energy created / released (or weight x spacing, where more)", (.energy_created | percent)], ["energy released", (if .energy_released_J == null then "-" else "\(.energy_released_J | scientific) J" end)],
       ["density error of the water, 99.9th percentile", (.density_error_p999 | percent)], ["density error of the water, largest", (.density_error | percent)],
       ["Mach number (fastest particle / speed of sound)", (.mach_number | amount)], ["particles of one phase within the other, share", (.interpenetrating_share | percent)],
       ["particles below the bed", .below_bed], ["particles that left the domain: water, soil", (if $s.lost then "\($s.lost.water), \($s.lost.soil)" else "-" end)])
      | select(.[1] != null and .[1] != "-")))),
  subsection("Sensitivity";
    (if $study then table("Changes against the run as it is; friction: \($study.sources.friction), level: \($study.sources.level), numerical error: \($study.sources.numerical)";
       ["quantity", "this run", "unit", "lowest", "highest", "friction", "level", "numerical error", "dominated by"];
       $study.rows[] | . as $r | [.label, (.value | amount), .unit] + ([change(.quantity)][0] | map($r.value + . | amount)) +
         [(.percent.friction, .percent.level, .percent.numerical | if . == null then "-" else "\(fixed(1)) %" end), .dominates])
     else "Not studied: \($ARGS.named.uncertainty | sub("^not studied;? ?"; ""))" | paragraph end))),

section("Empirical cross-check"; $s.impulse_wave // empty | empirical),

section("Provenance";
  ([$particles.provenance, $run.provenance | select(. != null and . != "") | fromjson? | select(.tool)] + [($s.provenance // {})[]]) as $made
  | table("Model"; ["item", "value"];
      (["particles", "water \($s.particles.water | thousands), soil \($s.particles.soil | thousands), wall \($s.particles.wall | thousands); spacing \($s.particle_spacing_m | given) m"],
       ["numerics", "\($s.model // ""); scheme \($s.scheme // "-"), kernel \($s.kernel // "-"), h/dp \($s.h_over_dp // "-"), \($s.integrator // "-"), CFL \($s.cfl // "-")"],
       ["speed of sound of the water", ($s.sound_speed_m_s | with_unit("m/s"))],
       ["run", "\($s.steps | thousands) steps to \($duration | amount) s in \($s.wall_time_s | fixed(0)) s on \($s.device // "-"), \($s.threads // "-") threads"],
       (if $credit == "" then empty else ["terrain", $run.attribution] end),
       ["coordinates", (($run.crs // "") | if . == "" then "none" else capture("^[A-Z]+\\[\"(?<n>[^\"]*)\"").n? // "as in the case" end)], ["vertical datum", $datum])),
    subsection("Commands and versions"; $made[] | "<p>\("\(.tool) \(.version)" | text)<br/><code>\(.command_line | text)</code></p>"),
    subsection("Inputs, with their SHA-256"; [$made[].inputs[]?] | unique_by(.path)[] | "<p>\(.path | text)<br/><code>\(.sha256 | text)</code></p>"),
    (if ($run.case_text // "") == "" then empty else subsection("The case"; "<pre>\($run.case_text | text)</pre>") end)),

section("Left out";
  (if ($s.left_out // [] | length) > 0 then "Not part of this run (with the memory that each would take):" | paragraph, ($s.left_out | items)
   else "No part of the model was left out." | paragraph end),
  (if ($s.particles.left_out // 0) > 0 then "\($s.particles.left_out | thousands) wall particles that nothing can reach were left out." | paragraph else empty end)),
"</body>", "</html>"
