# For the figure: blocks of tab-separated lines "column row colour value", a block a variant, and a block "row name"; of stability.json.
def colour: if .expect == "refused" and .pass then 3 elif .pass then 1 else 2 end;
def text: if type == "number" and . >= 1e5 then (log10 | floor) as $e | "\(. / pow(10; $e) * 100 | round / 100)e\($e)" else tostring end;
(group_by([.axis, .scene]) | sort_by(.[0].id)) as $rows
| (["2-D", "2-D fine", "3-D"][] as $variant
  | ("NaN\tNaN\t1\t",  # a block without lines would be none
   # Numbers in their order, then words in the order of the matrix.
   ($rows | to_entries[] | .key as $row | .value
    | (map(.value | select(type == "number")) | unique) as $numbers
    | ($numbers + (map(.value | select(type != "number")) | reduce .[] as $v ([]; if index($v) then . else . + [$v] end))) as $values
    | .[] | select(.variant == $variant) | .value as $value | [($values | index([$value])), $row, colour, ($value | text)] | @tsv)),
    "", ""),
($rows | to_entries[] | [.key, (.value[0] | "\(.axis), \(.scene)")] | @tsv)
