# What is varied and how, from the case's gauges.json: {steps, variants: {name: ["key=value", ...]}}
.parameters as $p
| ($friction_step | tonumber) as $friction
| (if $level_step == "auto" then [1, 0.02 * ($p.still_water_depth_m // 0)] | min else $level_step | tonumber end) as $level
| ($dp_factors | [splits(" +") | select(. != "") | tonumber]) as $factors
| def both($name; f): {"\($name)_low": f | .low, "\($name)_high": f | .high};
  def friction($sign): ["soil.friction_angle=\($p.friction_angle_deg + $sign * $friction)"]
    + if $p.bed_friction_angle_deg then ["soil.bed_friction_angle=\($p.bed_friction_angle_deg + $sign * $friction)"] else [] end;
  def level($sign): ["water.level=\($p.still_water_level_m + $sign * $level)"];
  {steps: {friction_angle_deg: $friction, level_m: $level, dp_factors: $factors},
   variants: (
     # Undrained clay has no angle to vary; water given as bodies does not follow the level.
     (if ($p.friction_angle_deg // 0) > 0 then {friction_low: friction(-1), friction_high: friction(1)} else {} end)
     + (if $p.water_fills_to_level and $level > 0 then {level_low: level(-1), level_high: level(1)} else {} end)
     + ($factors | map({"dp_x\(.)": ["particle_spacing=\($p.particle_spacing_m * .)"]}) | add // {}))}
