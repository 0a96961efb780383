# The highest run-up of each shore, the highest first, from the layer shore_runup as GeoJSON.
[.features | map(.properties + {at: (.geometry.coordinates | .[length / 2 | floor])}) | group_by(.shore)[]
 | (map(.distance_m) | max) as $length | map(select(.runup_m != null)) | select(length > 0) | max_by(.runup_m)
 | {shore, length_m: $length, runup_m, elevation_m, distance_m, x: .at[0], y: .at[1]}] | sort_by(-.runup_m)
