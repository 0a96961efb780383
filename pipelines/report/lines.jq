# GeoJSON to lines for gnuplot: jq -r --arg shortest 200 -f lines.jq lines.json
# Rows of x, y and the feature's "value"; a blank line behind each line or ring. Lines shorter than `shortest` are left out.
def lines: .. | select(type == "array" and length > 1 and (.[0] | type) == "array" and (.[0][0] | type) == "number");
def length_m: [.[1:], .[:-1]] | transpose | map((.[0][0] - .[1][0]) * (.[0][0] - .[1][0]) + (.[0][1] - .[1][1]) * (.[0][1] - .[1][1]) | sqrt) | add;
.features[] | (.properties.value // 0) as $value | .geometry.coordinates? // empty | lines
| select(length_m >= ($shortest | tonumber)) | (.[] | "\(.[0]) \(.[1]) \($value)"), ""
