# How the table and the figure of a sweep write a key's value; of sweep.json. For jq -L FOLDER: include "sweep/values";
def in_full: if . == null then "-" elif type == "string" then . else tojson end;
# Values too long for a column, each once and in their order: they go by their numbers.
def long_values($key): reduce (.runs[].inputs[$key] | in_full | select(length > 30)) as $v ([]; if index([$v]) then . else . + [$v] end);
def shown($long): in_full as $v | ($long | index([$v])) as $n | if $n == null then $v else "#\($n + 1)" end;
