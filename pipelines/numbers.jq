# Numbers as people read them; null is "-". For jq -L FOLDER: include "numbers";
def fixed($digits): # a number with so many decimals; jq 1.6 has no printf
  if . == null then "-"
  else pow(10; $digits) as $p | (. * $p | round) as $n | ($n | fabs) as $a
    | (if $n < 0 then "-" else "" end) + ($a / $p | floor | tostring)
    + (if $digits == 0 then "" else "." + (($a % $p + $p) | tostring | .[1:]) end)
  end;
def thousands: tostring | [match("\\d{1,3}(?=(\\d{3})*$)"; "g").string] | join(",");
def scientific: # two significant digits
  if . == null then "-" elif . == 0 then "0"
  else (fabs | log10 | floor) as $e | (. / pow(10; $e) | fixed(1)) + "e" + ($e | tostring) end;
def short: # fewer decimals the larger: from flumes to canyons
  if . == null then "-" elif fabs >= 10 then fixed(1) elif fabs >= 1 then fixed(2) else fixed(4) end;
def three: # three significant digits and no zeros behind them, larger numbers in full
  if type != "number" then "-" elif . == 0 then "0"
  else (fabs | log10 | floor) as $e
    | if $e >= 2 then (round | tostring) else (pow(10; 2 - $e) as $p | . * $p | round / $p | tostring) end end;
def place: if fabs >= 1000 then fixed(0) else fixed(2) end;
def volume: if . == null then "-" elif fabs >= 1e5 then (. / 1e6 | fixed(2)) + " million m3" else short + " m3" end;
