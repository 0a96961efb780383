# Areas of the hazard classes and the highest wave of the lake, as JSON.
# awk -v level=740 -v cell=225 -f zones.awk zones.xyz     (x, y, hazard class, zone, highest surface; zone 1 lake, 2 land); a NaN surface is dry
NF == 5 {
  area[$4, $3] += cell
  if ($4 == 1 && $5 !~ /[nN]/ && (!found || $5 > top)) { top = $5; x = $1; y = $2; found = 1 }
}
END {
  printf "{\"lake_maximum\": "
  if (found) printf "{\"height_m\": %.6g, \"elevation_m\": %.8g, \"x\": %.10g, \"y\": %.10g}", top - level, top, x, y
  else printf "null"
  printf ", \"hazard_area_m2\": {"
  for (zone = 1; zone <= 2; ++zone)
    printf "%s\"%s\": [%.10g, %.10g, %.10g]", (zone > 1 ? ", " : ""), (zone == 1 ? "lake" : "land"), area[zone, 1], area[zone, 2], area[zone, 3]
  print "}}"
}
