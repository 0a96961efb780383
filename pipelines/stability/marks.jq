# For the figure: blocks of tab-separated lines "column row colour value", a block a variant, and a block "row name"; of stability.json.
def colour: if .expect == "refused" and .pass then 3 elif .pass then 1 else 2 end;
(group_by([.axis, .scene]) | sort_by(.[0].id)) as $rows
| (["2-D", "2-D fine", "3-D"][] as $variant
  | ($rows | to_entries[] | .key as $row | .value | (map(.value | tostring) | reduce .[] as $v ([]; if index($v) then . else . + [$v] end)) as $values
    | .[] | select(.variant == $variant) | (.value | tostring) as $value | [($values | index($value)), $row, colour, $value] | @tsv),
    "", ""),
($rows | to_entries[] | [.key, (.value[0] | "\(.axis), \(.scene)")] | @tsv)
