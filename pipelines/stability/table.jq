# The stability matrix as a tab-separated table, a line a point of an axis; of stability.json: jq -L FOLDER -f table.jq
include "numbers";
def mark: if . == null then "-" elif .pass then "pass" else .criterion end;
(["axis", "value", "scene", "2-D", "2-D fine", "3-D", "dt (s)", "limited by", "stable to CFL"] | @tsv),
(group_by([.axis, .scene, (.value | tostring)]) | sort_by(.[0].id)[]
  | (map({key: .variant, value: .}) | from_entries) as $v | .[0] as $p
  | [$p.axis, $p.value, $p.scene, ($v["2-D"] | mark), ($v["2-D fine"] | mark), ($v["3-D"] | mark), ($p.dt_s | three), $p.dt_limited_by // "-",
     ($p.largest_stable_cfl // "-")] | @tsv),
"",
"\(map(select(.pass)) | length) of \(length) points pass; \(map(select(.pass | not) | select(.outcome == "ran" and (.announced // "") == "")) | length) fail without a warning, \(map(select(.outcome == "crashed")) | length) crash"
