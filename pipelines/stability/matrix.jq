# The stability matrix: a list of points {id, axis, value, scene, variant, dimension, rest, expect, case}, each with its whole case.
# jq -n -f matrix.jq. Scenes are sections in metres, from which the axes depart one at a time; expect is "pass", or "refused" where
# a one-line refusal is the right answer. rest: nothing may move.
def pi: 3.141592653589793;
def tangent($degrees): ($degrees * pi / 180) | (sin / cos);

# --- Scenes ----------------------------------------------------------------------------------------------------------
def soil: {density: 2000, friction_angle: 30, cohesion: 1000, young_modulus: 5e7, poisson_ratio: 0.3};
# A wedge on a slope of 35 degrees, its foot at the water's edge, slides into a lake 36 m deep.
def slide: {dimension: 2, particle_spacing: 2,
  terrain: {profile: [[0, 70], [100, 0], [240, 0], [300, 42]]}, water: {level: 36},
  slide: {bodies: [[[20, 56], [52, 33.6], [52, 52], [44, 56]]]}, soil: (soil + {friction_angle: 20}), output: {end_time: 10}};
# Soil under water, both level and at rest.
def bed: {dimension: 2, particle_spacing: 1.5, rest: true,
  terrain: {profile: [[0, 0], [45, 0]]}, water: {level: 30, bodies: [[[0, 15], [45, 15], [45, 30], [0, 30]]]},
  slide: {bodies: [[[0, 0], [45, 0], [45, 15], [0, 15]]]}, soil: soil, output: {end_time: 10}};
# A column of soil that falls apart on dry ground.
def column: {dimension: 2, particle_spacing: 1, terrain: {profile: [[0, 0], [80, 0]], wall_top: 30},
  slide: {bodies: [[[0, 0], [16, 0], [16, 16], [0, 16]]]}, soil: soil, output: {end_time: 6}};
# A level layer of dry soil at rest.
def layer: {dimension: 2, particle_spacing: 1, rest: true, terrain: {profile: [[0, 0], [30, 0]], wall_top: 20},
  slide: {bodies: [[[0, 0], [30, 0], [30, 10], [0, 10]]]}, soil: soil, output: {end_time: 8}};
# A column of water that breaks over dry ground.
def dam: {dimension: 2, particle_spacing: 1, terrain: {profile: [[0, 0], [100, 0]], wall_top: 60},
  water: {level: 20, bodies: [[[0, 0], [30, 0], [30, 20], [0, 20]]]}, output: {end_time: 6}};
# A lake at rest between banks of 45 degrees.
def lake: {dimension: 2, particle_spacing: 1.5, rest: true, terrain: {profile: [[0, 40], [40, 0], [80, 0], [120, 40]]},
  water: {level: 30}, output: {end_time: 20}};

# --- Ways to depart from one ----------------------------------------------------------------------------------------------
def sound: . as $s | .water.sound_speed = 20 * (9.81 * ($s.water.level - ([$s.terrain.profile[][1]] | min)) | sqrt);
# Every length times $f, every time times its root; stresses and moduli times $f, so that it is the same flow.
def lengths($f): walk(if type == "number" then . * $f else . end);
def scaled($f): .particle_spacing *= $f | .terrain |= lengths($f)
  | (if .water then .water |= ((if .bodies then .bodies |= lengths($f) else . end) | .level *= $f) else . end)
  | (if .slide then .slide |= lengths($f) | .soil.cohesion *= $f | .soil.young_modulus *= $f else . end)
  | .output.end_time *= ($f | sqrt);
def moved($east; $up): .terrain.profile |= map([.[0] + $east, .[1] + $up])
  | (if .water then .water.level += $up | (if .water.bodies then .water.bodies |= map(map([.[0] + $east, .[1] + $up])) else . end) else . end)
  | (if .slide then .slide.bodies |= map(map([.[0] + $east, .[1] + $up])) else . end);
def steep($degrees): (40 / tangent($degrees)) as $run
  | .terrain.profile = [[0, 40], [$run, 0], [$run + 60, 0], [2 * $run + 60, 40]];
# A layer of soil $n particles thick on the slope of the scene slide, measured vertically.
def thin($n): (.particle_spacing * $n) as $t
  | .slide.bodies = [[[20, 56], [60, 28], [60, 28 + $t], [20, 56 + $t]]];

# --- The axes --------------------------------------------------------------------------------------------------------
# at("axis"; value; "scene"; case): one row. Values stand as they are written in the table.
def at($axis; $value; $scene; c): {axis: $axis, value: $value, scene: $scene, expect: "pass", case: c};
def refused: .expect = "refused";
def only2d: .flat = true;

[
  # Stiffness.
  (5e6, 5e7, 5e8, 5e9, 5e10 | . as $e
    | (if . > 1e9 then 2 elif . > 1e8 then 5 else 10 end) as $t
    | at("Young modulus (Pa)"; $e; "slide"; slide | .soil.young_modulus = $e | .output.end_time = $t),
      at("Young modulus (Pa)"; $e; "bed"; bed | .soil.young_modulus = $e | .output.end_time = ($t / 2))),
  (1e5, 1e6 | . as $e | at("Young modulus (Pa)"; $e; "slide"; slide | .soil.young_modulus = $e)),
  (0.1, 0.2, 0.4, 0.45, 0.49 | . as $nu
    | at("Poisson ratio"; $nu; "slide"; slide | .soil.poisson_ratio = $nu),
      at("Poisson ratio"; $nu; "bed"; bed | .soil.poisson_ratio = $nu)),
  (5, 10, 20, 40 | . as $n
    | at("water sound speed / fastest water"; $n; "slide"; slide | .water.sound_speed = $n * 14),
      at("water sound speed / fastest water"; $n; "dam"; dam | .water.sound_speed = $n * 24)),
  (0.1, 0.3, 1, 3, 10, 30 | . as $r
    | at("soil / water wave speed"; $r; "slide"; slide | .water.sound_speed = 380 | .soil.young_modulus = (($r * 380) | . * . * 2000 / 1.346)
      | .output.end_time = (if $r > 3 then 1.5 elif $r > 1 then 4 else 10 end))),
  # Strength.
  (0, 100, 1000, 1e4, 1e6 | . as $c
    | at("cohesion (Pa)"; $c; "slide"; slide | .soil.cohesion = $c),
      at("cohesion (Pa)"; $c; "column"; column | .soil.cohesion = $c),
      at("cohesion (Pa)"; $c; "layer"; layer | .soil.cohesion = $c)),
  (2, 10, 20, 30, 45, 60 | . as $phi
    | at("friction angle (degrees)"; $phi; "slide"; slide | .soil.friction_angle = $phi),
      at("friction angle (degrees)"; $phi; "column"; column | .soil.friction_angle = $phi)),
  at("friction angle (degrees)"; 0; "column"; column | .soil.friction_angle = 0 | .soil.cohesion = 2e4),
  at("friction angle (degrees)"; 0; "slide"; slide | .soil.friction_angle = 0 | .soil.cohesion = 2e4),
  (1, 15, 30 | . as $psi
    | at("dilatancy angle (degrees)"; $psi; "column"; column | .soil.dilatancy_angle = $psi),
      at("dilatancy angle (degrees)"; $psi; "layer"; layer | .soil.dilatancy_angle = $psi)),
  # Terrain.
  (5, 20, 45, 60, 80, 89 | . as $a | at("bank (degrees)"; $a; "lake"; lake | steep($a))),
  (at("bank (degrees)"; "overhang"; "lake"; lake | .terrain.profile = [[0, 40], [20, 20], [10, 0], [80, 0], [120, 40]]) | refused),
  # Densities.
  (0.9, 1.01, 1.2, 3, 5 | . as $r
    | at("density soil / water"; $r; "slide"; slide | .soil.density = 1000 * $r),
      (if $r >= 1 then at("density soil / water"; $r; "bed"; bed | .soil.density = 1000 * $r) else empty end)),
  # Impact.
  (0.1, 1, 3, 5, 10 | . as $f
    | at("slide Froude number"; $f; "slide"; slide | .slide.velocity = [$f * 18.8 * 0.819, -$f * 18.8 * 0.574]
      | .water.sound_speed = ([380, 10 * $f * 18.8] | max) | .output.end_time = (if $f > 3 then 5 else 10 end) | .terrain.wall_top = 200)),
  (at("slide Froude number"; "5, slow sound"; "slide"; slide | .slide.velocity = [77, -54] | .water.sound_speed = 200 | .output.end_time = 5
    | .terrain.wall_top = 200)),
  at("where the slide starts"; "falls 30 m into water"; "slide"; slide | .slide.bodies = [[[150, 66], [170, 66], [170, 86], [150, 86]]]),
  at("where the slide starts"; "submerged"; "slide"; slide | .slide.bodies = [[[55, 31.5], [80, 14], [80, 31.5]]]),
  at("where the slide starts"; "half in water"; "slide"; slide | .slide.bodies = [[[35, 45.5], [75, 17.5], [75, 45.5]]]),
  at("where the slide starts"; "no water"; "slide"; slide | del(.water) | .terrain.wall_top = 100),
  # Thin things.
  (1, 2, 3, 5, 10 | . as $n
    | at("soil layer (particles)"; $n; "slide"; slide | thin($n)),
      at("water layer (particles)"; $n; "lake"; lake | .terrain.profile = [[0, 10], [0.1, 0], [60, 0], [60.1, 10]] | .water.level = $n * 1.5)),
  at("small things"; "one particle of soil"; "slide"; slide | .slide.bodies = [[[150, 46], [152, 46], [152, 48], [150, 48]]]),
  at("small things"; "one particle of water"; "dam"; dam | .water.bodies = [[[40, 10], [41, 10], [41, 11], [40, 11]]]),
  at("small things"; "drops"; "dam"; dam | .water.bodies += [[[60, 30], [61, 30], [61, 31], [60, 31]], [[70, 20], [72, 20], [72, 22], [70, 22]]]),
  at("small things"; "slivers in corners"; "lake"; lake | .terrain.profile = [[0, 20], [60, 0], [61, 2], [62, 0], [122, 20]] | .water.level = 6),
  at("small things"; "film on a slope"; "dam"; dam | .terrain.profile = [[0, 40], [60, 10], [100, 10]] | .water.level = 45
    | .water.bodies = [[[5, 37.6], [45, 17.6], [45, 18.8], [5, 38.8]]]),
  at("small things"; "slide onto a film"; "slide"; slide | .water.level = 4),
  # Scale, from dp 1 mm to 50 m.
  (0.0005, 0.01, 1, 25 | . as $f
    | at("scale (dp, m)"; 2 * $f; "slide"; slide | scaled($f)),
      at("scale (dp, m)"; 1.5 * $f; "bed"; bed | scaled($f))),
  at("place"; "x 4e6 m"; "slide"; slide | moved(4e6; 0)),
  at("place"; "z 8000 m"; "slide"; slide | moved(0; 8000)),
  at("place"; "x 4e6, z 8000 m"; "bed"; bed | moved(4e6; 8000)),
  # Gravity.
  at("gravity (m/s2)"; 98.1; "slide"; slide | .gravity = [0, 0, -98.1] | .output.end_time = 4),
  at("gravity (m/s2)"; 1.62; "slide"; slide | .gravity = [0, 0, -1.62]),
  at("gravity (m/s2)"; "tilted 20 degrees"; "column"; column | .gravity = [3.355, 0, -9.218]),
  (at("gravity (m/s2)"; "tilted, with water"; "slide"; slide | .gravity = [3.355, 0, -9.218]) | refused),
  (at("gravity (m/s2)"; 0; "slide"; slide | .gravity = [0, 0, 0]) | refused),
  # Time step.
  (0.05, 0.1, 0.2, 0.4, 0.6, 0.8, 1 | . as $c
    | at("CFL number"; $c; "slide"; slide | .numerics.cfl = $c),
      at("CFL number"; $c; "column"; column | .numerics.cfl = $c),
      at("CFL number"; $c; "dam"; dam | .numerics.cfl = $c),
      at("CFL number"; $c; "bed"; bed | .numerics.cfl = $c)),
  (0.1, 0.2, 0.3 | . as $c
    | at("CFL number, Verlet"; $c; "slide"; slide | .numerics = {integrator: "verlet", cfl: $c}),
      at("CFL number, Verlet"; $c; "dam"; dam | .numerics = {integrator: "verlet", cfl: $c})),
  (at("CFL number, Verlet"; 0.4; "dam"; dam | .numerics = {integrator: "verlet", cfl: 0.4}) | refused),
  # Choices.
  (1, 1.2, 1.5, 2, 3 | . as $h | at("h / dp"; $h; "slide"; slide | .numerics.h_over_dp = $h)),
  at("choices"; "cubic kernel"; "slide"; slide | .numerics.kernel = "cubic"),
  at("choices"; "single precision"; "slide"; slide | .numerics.precision = "single"),
  at("choices"; "double precision"; "slide"; slide | .numerics.precision = "double"),
  at("choices"; "no density diffusion"; "slide"; slide | .water.density_diffusion = 0),
  at("choices"; "no viscosity"; "dam"; dam | .water.viscosity_alpha = 0),
  at("choices"; "shifting 2"; "dam"; dam | .numerics.shifting = 2),
  at("choices"; "rate form"; "column"; column | .numerics.constitutive = "rate_form"),
  at("choices"; "mu(I)"; "column"; column | .soil.rate = {friction_angle_fast: 40, inertial_number: 0.279, grain_diameter: 0.1}),
  at("choices"; "scheme huang2023"; "slide"; slide | .numerics.scheme = "huang2023"),
  # A million steps.
  (at("steps at rest"; 1e6; "lake"; lake | .particle_spacing = 3 | .terrain.profile = [[0, 0], [30, 0]] | .water.level = 15
    | .water.sound_speed = 243 | .output.end_time = 7200 | .output.frame_interval = 720) | only2d),
  # Degenerate scenes.
  (at("degenerate"; "empty reservoir"; "lake"; lake | .water.level = -5) | refused),
  (at("degenerate"; "no phase"; "lake"; lake | del(.water)) | refused),
  (at("degenerate"; "all wall"; "lake"; lake | .water.level = 0.1) | refused),
  at("degenerate"; "soil twice in one place"; "column"; column | .slide.bodies += .slide.bodies),
  at("degenerate"; "water twice in one place"; "dam"; dam | .water.bodies += .water.bodies),
  (at("degenerate"; "water in the rock"; "dam"; dam | .water.bodies = [[[0, -20], [30, -20], [30, -10], [0, -10]]]) | refused),
  # Verlet feeds on noise as well as on what diffuses.
  (0.1, 0.2 | . as $c
    | at("CFL number, Verlet, no density diffusion"; $c; "dam";
        dam | .water.density_diffusion = 0 | .numerics = {integrator: "verlet", cfl: $c}))
]

# --- Every point at two spacings in 2-D and one in 3-D ----------------------------------------------------------------------
| [ .[] | . as $row
    | (if .expect == "refused" then ["2-D"] elif .flat then ["2-D"] else ["2-D", "2-D fine", "3-D"] end)[] as $variant
    | $row | .variant = $variant | .rest = (.case.rest // false) | del(.flat, .case.rest)
    | if $variant == "2-D fine" then .case.particle_spacing *= (2 / 3)
      elif $variant == "3-D" then
        .case.dimension = 3 | .case.particle_spacing *= 1.25 | .case.terrain.width = 8 * .case.particle_spacing
        | (if .case.slide.velocity then .case.slide.velocity |= [.[0], 0, .[1]] else . end)
      else . end
    | .dimension = .case.dimension
    | .case.name = "point"
    | .case.output.frame_interval //= .case.output.end_time / 5
    | .case.numerics.retakes = 0
  ]
| to_entries | map(.value + {id: (.key + 1 | tostring | "000"[:3 - length] + .)})
