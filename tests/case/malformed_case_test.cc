// What is refused, where, and in which words. Each text is the sound case below with something spoilt.
#include <gtest/gtest.h>

#include <chrono>
#include <sstream>

#include "base/error.hh"
#include "case/case.hh"
#include "case/validate_case.hh"

namespace lgiw {
namespace {

const std::string sound = R"(name: demo
particle_spacing: 12
terrain:
  sources: [{file: dem.tif}]
  crs: EPSG:32611
  window: [388400, 3793300, 394200, 3798000]
water:
  level: 740
  seed: [390700, 3795400]
slide:
  polygon: [[391000, 3796000], [391500, 3796000], [391500, 3796500]]
  depth: 40
soil:
  friction_angle: 25
gauges:
- {name: G1, x: 390000, y: 3795000}
- {name: G2, x: 391000, y: 3795500}
)";

const std::string flume = R"(name: flume
dimension: 2
particle_spacing: 0.005
terrain:
  profile: [[-0.15, 0.15], [0, 0], [2.2, 0]]
water:
  level: 0.1
slide:
  bodies: [[[-0.1, 0.1], [-0.05, 0.1], [-0.05, 0.05]]]
)";

std::string message_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    parse_case(text, "c.yaml", overrides);
  } catch (const InputError& e) {
    return e.what();
  } catch (const std::exception& e) {
    return std::string("not an InputError: ") + e.what();
  }
  return "accepted";
}

struct Spoilt {
  std::string name, from, to, message;
};
void PrintTo(const Spoilt& s, std::ostream* out) { *out << s.name; }

/// `text` with its only occurrence of `from` replaced; an empty `from` appends.
std::string spoil(const std::string& text, const Spoilt& s) {
  if (s.from.empty()) return text + s.to;
  const std::size_t at = text.find(s.from);
  EXPECT_NE(at, std::string::npos) << s.from;
  EXPECT_EQ(text.find(s.from, at + 1), std::string::npos) << s.from;
  return text.substr(0, at) + s.to + text.substr(at + s.from.size());
}

class Malformed : public testing::TestWithParam<Spoilt> {};
class MalformedFlume : public testing::TestWithParam<Spoilt> {};

TEST(MalformedCase, TheTextsAreSoundBefore) {
  EXPECT_EQ(message_of(sound), "accepted");
  EXPECT_EQ(message_of(flume), "accepted");
}

TEST_P(Malformed, IsRefusedWithItsLine) { EXPECT_EQ(message_of(spoil(sound, GetParam())), GetParam().message); }
TEST(MalformedSlide, DepthOnAProfile) {
  EXPECT_EQ(
      message_of("name: p\nparticle_spacing: 5\nterrain: {profile: [[0, 50], [200, 0]], width: 100}\n"
                 "slide: {depth: 20, polygon: [[20, 20], [80, 20], [80, 80]]}\n"),
      "c.yaml:4: slide.depth without terrain rasters (it cuts into a terrain of rasters; soil on a profile is given "
      "as (x, z) outlines) use bodies");
}
TEST_P(MalformedFlume, IsRefusedWithItsLine) { EXPECT_EQ(message_of(spoil(flume, GetParam())), GetParam().message); }

std::string name_of(const testing::TestParamInfo<Spoilt>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(
    Keys, Malformed,
    testing::Values(
        Spoilt{"UnknownKey", "friction_angle", "fricton_angle",
               "c.yaml:14: unknown key \"fricton_angle\" (soil has no such key) did you mean \"friction_angle\"?"},
        Spoilt{"UnknownTopKey", "particle_spacing", "particle_spacng",
               "c.yaml:2: unknown key \"particle_spacng\" (a case has no such key) did you mean \"particle_spacing\"?"},
        Spoilt{"UnknownKeyInList", "G2, x: 391000", "G2, X: 391000",
               "c.yaml:17: unknown key \"X\" (gauges.1 has no such key) did you mean \"x\"?"},
        Spoilt{"KeyOfAnotherSection", "  level: 740", "  level: 740\n  cfl: 0.3",
               "c.yaml:9: unknown key \"cfl\" (water has no such key) it is known as numerics.cfl"},
        Spoilt{"KeyTwice", "  level: 740", "  level: 740\n  level: 720",
               "c.yaml:9: water.level is given twice (the first is at c.yaml:8) leave one of them out"},
        Spoilt{"KeyWithoutValue", "level: 740", "level:",
               "c.yaml:8: water.level has no value (a key without one means nothing) give it one or leave the key out"},
        Spoilt{"MissingName", "name: demo\n", "",
               "c.yaml:1: name is missing (outputs carry the name of the case) add name: my_case"},
        Spoilt{"MissingSpacing", "particle_spacing: 12\n", "",
               "c.yaml:1: particle_spacing is missing (the resolution has no default) add particle_spacing, in m"},
        Spoilt{"MissingLevel", "  level: 740\n", "",
               "c.yaml:7: water.level is missing (the still water level has no default) add level, in m of the "
               "terrain's vertical datum"},
        Spoilt{"ListForKey", "name: demo", "? [a, b]\n: demo",
               "c.yaml:1: a key of a case is no word (keys are plain words) write key: value"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Types, Malformed,
    testing::Values(
        Spoilt{"TextForNumber", "level: 740", "level: high",
               "c.yaml:8: water.level is \"high\" (a number is wanted) write a number"},
        Spoilt{"NumberWithUnit", "level: 740", "level: 740 m",
               "c.yaml:8: water.level is \"740 m\" (a number is wanted, without a unit) write 740"},
        Spoilt{"DecimalComma", "depth: 40", "depth: 40,5",
               "c.yaml:12: slide.depth is \"40,5\" (a decimal comma is no number) write 40.5"},
        Spoilt{"ListForNumber", "level: 740", "level: [740]",
               "c.yaml:8: water.level is a list (a number is wanted) write one number in m"},
        Spoilt{"ListForAttribution", "{file: dem.tif}", "{file: dem.tif, attribution: [A, B]}",
               "c.yaml:4: terrain.sources.0.attribution is a list (a text is wanted) write one word or quote it"},
        Spoilt{"NoAttribution", "{file: dem.tif}", "{file: dem.tif, attribution: \"\"}",
               "c.yaml:4: terrain.sources.0.attribution is empty (an empty text means nothing) leave the key out"},
        Spoilt{"SectionForText", "crs: EPSG:32611", "crs: {epsg: 32611}",
               "c.yaml:5: terrain.crs is a mapping of keys (a text is wanted) write one word or quote it"},
        Spoilt{"EmptyText", "crs: EPSG:32611", "crs: ''",
               "c.yaml:5: terrain.crs is empty (an empty text means nothing) leave the key out"},
        Spoilt{"NotANumber", "depth: 40", "depth: .nan",
               "c.yaml:12: slide.depth is \".nan\" (a finite number is wanted) write its value"},
        Spoilt{"Infinite", "depth: 40", "depth: inf",
               "c.yaml:12: slide.depth is \"inf\" (a finite number is wanted) write its value"},
        Spoilt{"Overflow", "depth: 40", "depth: 1e999",
               "c.yaml:12: slide.depth is \"1e999\" (no finite number is that large or small) check the exponent"},
        Spoilt{
            "ScalarForSection", "soil:\n  friction_angle: 25", "soil: granite",
            "c.yaml:13: soil is \"granite\" (it is a section with keys of its own) write its keys below it, indented"},
        Spoilt{"ScalarForList", "gauges:\n- {name: G1, x: 390000, y: 3795000}\n- {name: G2, x: 391000, y: 3795500}\n",
               "gauges: G1\n",
               "c.yaml:15: gauges is \"G1\" (a list is wanted) write a list of items, each beginning with -"},
        Spoilt{"ScalarForItem", "{name: G1, x: 390000, y: 3795000}", "G1",
               "c.yaml:16: gauges.0 is \"G1\" (each item is a mapping of keys) write {key: value, ...}"},
        Spoilt{"ThreeNumbersForTwo", "[390700, 3795400]", "[390700, 3795400, 740]",
               "c.yaml:9: water.seed has 3 numbers (2 are wanted) write [x, y]"},
        Spoilt{"PointOfOneNumber", "[391500, 3796500]", "391500",
               "c.yaml:11: a point of slide.polygon is \"391500\" (a point is two numbers) write [x, y]"},
        Spoilt{"UnknownWord", "", "interface:\n  repulsion: maybe\n",
               "c.yaml:19: interface.repulsion is \"maybe\" (it is either true or false) the default is true"},
        Spoilt{"UnknownChoice", "", "numerics: {integrator: leapfrg}\n",
               "c.yaml:18: numerics.integrator is \"leapfrg\" (it is one of leapfrog or verlet) did you mean "
               "\"leapfrog\"?"},
        Spoilt{"Fraction", "", "numerics: {threads: 1.5}\n",
               "c.yaml:18: numerics.threads is 1.5 (a whole number is wanted) write 2"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Units, Malformed,
    testing::Values(
        Spoilt{
            "FrictionInRadians", "friction_angle: 25", "friction_angle: 0.5",
            "c.yaml:14: soil.friction_angle is 0.5 (it must be 0 or at least 2 and at most 60 degrees; 0.5 looks like "
            "radians) write 28.6479 if it is"},
        Spoilt{
            "FrictionAbove90", "friction_angle: 25", "friction_angle: 125",
            "c.yaml:14: soil.friction_angle is 125 (it must be 0 or at least 2 and at most 60 degrees) the default is "
            "30"},
        Spoilt{
            "SoilDensityInTonnes", "friction_angle: 25", "density: 1.9",
            "c.yaml:14: soil.density is 1.9 (it must be at least 300 and at most 5000 kg/m3; 1.9 looks like t/m3 (or "
            "g/cm3)) write 1900 if it is"},
        Spoilt{
            "SoilUnitWeight", "friction_angle: 25", "density: 19.62",
            "c.yaml:14: soil.density is 19.62 (it must be at least 300 and at most 5000 kg/m3; 19.62 looks like kN/m3) "
            "write 2000 if it is"},
        Spoilt{
            "WaterDensityInTonnes", "level: 740", "level: 740\n  density: 1.025",
            "c.yaml:9: water.density is 1.025 (it must be at least 900 and at most 1300 kg/m3; 1.025 looks like t/m3) "
            "write 1025 if it is"},
        Spoilt{
            "YoungInMegapascal", "friction_angle: 25", "young_modulus: 50",
            "c.yaml:14: soil.young_modulus is 50 (it must be at least 10000 and at most 1e+12 Pa; 50 looks like MPa) "
            "write 5e+07 if it is"},
        Spoilt{
            "FastFrictionBelowTheSlow", "friction_angle: 25",
            "friction_angle: 25\n  rate: {friction_angle_fast: 24, grain_diameter: 0.001}",
            "c.yaml:15: soil.rate.friction_angle_fast is not above the friction angle (24 is not more than 25 degrees; "
            "strength grows with the rate) write a larger angle, or leave soil.rate out"},
        Spoilt{"RateWithoutGrains", "friction_angle: 25", "friction_angle: 25\n  rate: {friction_angle_fast: 35}",
               "c.yaml:15: soil.rate.grain_diameter is missing (the strength at high rates has no default) write rate: "
               "{friction_angle_fast: 41, grain_diameter: 0.001}"},
        Spoilt{
            "GrainsInMillimetres", "friction_angle: 25",
            "friction_angle: 25\n  rate: {friction_angle_fast: 35, grain_diameter: 20}",
            "c.yaml:15: soil.rate.grain_diameter is 20 (it must be at least 1e-06 and at most 10 m; 20 looks like mm) "
            "write 0.02 if it is"},
        Spoilt{"RateInTheRateForm", "friction_angle: 25",
               "friction_angle: 25\n  rate: {friction_angle_fast: 35, grain_diameter: 0.02}\nnumerics: {constitutive: "
               "rate_form}",
               "c.yaml:15: soil.rate with the rate form (mu(I) is part of the return mapping) write "
               "numerics.constitutive: return_mapping"},
        Spoilt{
            "StrainRateUnknown", "friction_angle: 25", "friction_angle: 25\nnumerics: {strain_rate: exact}",
            "c.yaml:15: numerics.strain_rate is \"exact\" (it is one of plain or corrected) did you mean \"plain\"?"},
        Spoilt{"PoissonOfOneHalf", "friction_angle: 25", "poisson_ratio: 0.5",
               "c.yaml:14: soil.poisson_ratio is 0.5 (it must be above 0 and below 0.5) the default is 0.3"},
        Spoilt{
            "DipAbove85", "depth: 40", "plane: {point: [391000, 3796000, 800], dip: 95, dip_direction: 180}",
            "c.yaml:12: slide.plane.dip is 95 (it must be at least 0 and at most 85 degrees; 95 looks like gradians) "
            "write 85.5 if it is"},
        Spoilt{"LevelInMillimetres", "level: 740", "level: 740000",
               "c.yaml:8: water.level is 740000 (it must be at least -12000 and at most 9000 m; 740000 looks like mm) "
               "write 740 if it is"},
        Spoilt{"WindowInDegrees", "[388400, 3793300, 394200, 3798000]", "[-118.2, 34.27, -118.1, 34.32]",
               "c.yaml:6: terrain.window is 0.1 m by 0.05 m (that is less than ten particles of 12 m; it looks like "
               "degrees) give it in the metres of terrain.crs"},
        Spoilt{"NegativeSpacing", "particle_spacing: 12", "particle_spacing: -12",
               "c.yaml:2: particle_spacing is -12 (it must be at least 1e-05 and at most 1000 m) give a value in that range"},
        Spoilt{"SmoothingTooLong", "", "numerics:\n  h_over_dp: 4\n",
               "c.yaml:19: numerics.h_over_dp is 4 (it must be at least 1 and at most 3) the default is 1.5"},
        Spoilt{"AutomaticKeyNegative", "depth: 40", "depth: 40\n  min_thickness: -1",
               "c.yaml:13: slide.min_thickness is -1 (it must be auto or above 0 m) leave it out for the automatic "
               "value"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Combinations, Malformed,
    testing::Values(
        Spoilt{"NoBed", "sources: [{file: dem.tif}]\n  ", "",
               "c.yaml:3: terrain has neither sources nor a profile (a case needs a bed) add sources (rasters) or a "
               "profile ([x, z] points)"},
        Spoilt{
            "SeedMissing", "  seed: [390700, 3795400]\n", "",
            "c.yaml:7: water.seed is missing (not every hollow below the level is the reservoir) add seed: [x, y], a "
            "point in the reservoir"},
        Spoilt{"SeedOutside", "[390700, 3795400]", "[380700, 3795400]",
               "c.yaml:9: water.seed lies outside the domain ((380700, 3795400) is beyond terrain.window) move it or "
               "widen "
               "the domain"},
        Spoilt{
            "TwoFailureSurfaces", "depth: 40", "depth: 40\n  base_elevation: 700",
            "c.yaml:13: slide has two failure surfaces, depth and base_elevation (the soil reaches down to one) leave "
            "one of them out"},
        Spoilt{"NoFailureSurface", "\n  depth: 40", "",
               "c.yaml:10: slide has no failure surface (the soil reaches down to it) add one of before and after, "
               "thickness, failure_surface, depth, plane, base_elevation, slbl or bodies"},
        Spoilt{"OnlyBefore", "depth: 40", "before: old.tif",
               "c.yaml:12: slide has only the ground before the event (the soil lies between the two) give both before "
               "and after"},
        Spoilt{"NoOutline", "polygon: [[391000, 3796000], [391500, 3796000], [391500, 3796500]]\n  ", "",
               "c.yaml:10: slide has no outline (depth reaches everywhere) add polygon or polygon_file"},
        Spoilt{"PolygonOfTwoPoints", ", [391500, 3796500]]", "]",
               "c.yaml:11: slide.polygon has 2 points (an outline needs three) add points around it"},
        Spoilt{
            "PolygonCrossesItself", "[391500, 3796500]]", "[391000, 3796500], [391500, 3796500]]",
            "c.yaml:11: slide.polygon crosses or touches itself (its edge from (391500, 3796000) meets another) list "
            "the points once around, in order"},
        Spoilt{
            "SlideOutside", "[391500, 3796500]]", "[399500, 3796500]]",
            "c.yaml:11: slide.polygon lies outside the domain ((399500, 3796500) is beyond terrain.window) move it or "
            "widen the domain"},
        Spoilt{"PlaneWithoutDip", "depth: 40", "plane: {point: [391000, 3796000, 800], dip_direction: 180}",
               "c.yaml:12: slide.plane.dip is missing (a plane is a point, a dip and a dip direction) write plane: "
               "{point: [x, y, z], dip: 30, dip_direction: 90}"},
        Spoilt{"SixNeighbours", "depth: 40", "slbl: {neighbours: 6}",
               "c.yaml:12: slide.slbl.neighbours is 6 (a cell has four neighbours, eight with diagonals) write 4 or 8"},
        Spoilt{
            "BodiesWithRasters", "depth: 40", "bodies: [[[391000, 700], [391500, 700], [391500, 800]]]",
            "c.yaml:12: slide.bodies with rasters (bodies are (x, z) outlines of analytic scenes) use a polygon and a "
            "failure surface"},
        Spoilt{"MovingBodiesWithRasters", "", "bodies: [{name: B, outline: [[1, 0], [2, 0], [2, 1]], motion: m.csv}]\n",
               "c.yaml:18: bodies with rasters (bodies are (x, z) outlines of analytic scenes) use a slide with "
               "slide.motion"},
        Spoilt{"WaveWithRasters", "level: 740", "level: 740\n  wave: {kind: standing, amplitude: 1, mode: 2}",
               "c.yaml:9: water.wave with rasters (initial waves are those of laboratory tanks) use terrain.profile"},
        Spoilt{"RastersIn2D", "particle_spacing: 12", "particle_spacing: 12\ndimension: 2",
               "c.yaml:5: rasters in a 2-D scene (a 2-D scene has a profile for its bed) set dimension: 3 or give "
               "terrain.profile"},
        Spoilt{"WidthWithRasters", "  crs: EPSG:32611", "  width: 500",
               "c.yaml:5: terrain.width has no meaning here (the window bounds a scene with rasters) leave it out"},
        Spoilt{"WindowReversed", "[388400, 3793300, 394200, 3798000]", "[394200, 3793300, 388400, 3798000]",
               "c.yaml:6: terrain.window is empty (its ends are not in order) write [x_min, y_min, x_max, y_max]"},
        Spoilt{
            "GeographicCrs", "EPSG:32611", "epsg:4326",
            "c.yaml:5: terrain.crs is geographic (its coordinates are degrees, the case's are metres) name a projected "
            "one, such as the UTM zone: EPSG:32611"},
        Spoilt{"WebMercator", "EPSG:32611", "EPSG:3857",
               "c.yaml:5: terrain.crs is Web Mercator (its metres are too long by 1/cos(latitude)) name the UTM zone, "
               "such "
               "as EPSG:32611"},
        Spoilt{
            "GaugeOutside", "x: 390000", "x: 39000",
            "c.yaml:16: gauge G1 lies outside the domain ((39000, 3795000) is beyond terrain.window) move it or widen "
            "the domain"},
        Spoilt{"GaugeTwice", "name: G2", "name: G1",
               "c.yaml:17: two gauges are named G1 (their results would be mixed up) rename one of them"},
        Spoilt{
            "GaugeEscapes", "name: G2", "name: ../G2",
            "c.yaml:17: the name \"../G2\" cannot be used (it becomes part of file names) use a letter or digit, then "
            "letters, digits and _ . ' -"},
        Spoilt{"CaseNameEscapes", "name: demo", "name: a/b",
               "c.yaml:1: the name \"a/b\" cannot be used (it becomes part of file names) use a letter or digit, then "
               "letters, digits and _ . ' -"},
        Spoilt{"SectionOutside", "", "sections:\n- name: A\n  points: [[390000, 3795000], [390000, 3799000]]\n",
               "c.yaml:20: section A lies outside the domain ((390000, 3799000) is beyond terrain.window) move it or "
               "widen "
               "the domain"},
        Spoilt{"SectionOfOnePoint", "", "sections:\n- {name: A, points: [[390000, 3795000]]}\n",
               "c.yaml:19: section A has one point (a line needs two) add points from the slide to the opposite bank"},
        Spoilt{"NoDuration", "", "output: {end_time: 0}\n",
               "c.yaml:18: output.end_time is 0 (it must be above 0 and at most 1e+06 s) the default is 60"},
        Spoilt{"FrameAfterTheEnd", "", "output: {end_time: 30, frame_interval: 60}\n",
               "c.yaml:18: output.frame_interval is 60 s, longer than the run (output.end_time is 30 s) write 0.5"},
        Spoilt{"TooManyFrames", "", "output: {frame_interval: 1e-5}\n",
               "c.yaml:18: output asks for 6e+06 frames (each holds every particle) lengthen frame_interval"},
        Spoilt{"VerletTooFast", "", "numerics: {integrator: verlet, cfl: 0.4}\n",
               "c.yaml:18: numerics.cfl is 0.4 with the verlet integrator (it diverges at 0.4 and is unsafe above 0.3) "
               "write 0.1"},
        Spoilt{"CoulombWithoutAngle", "friction_angle: 25", "friction_angle: 25\n  bed: coulomb",
               "c.yaml:15: soil.bed is coulomb without soil.bed_friction_angle (the friction has no limit) add "
               "bed_friction_angle, in degrees"},
        Spoilt{"DilatancyAboveFriction", "friction_angle: 25", "friction_angle: 25\n  dilatancy_angle: 30",
               "c.yaml:15: soil.dilatancy_angle exceeds the friction angle (30 is more than 25 degrees; shearing would "
               "create energy) write at most 25; 0 is usual"},
        Spoilt{"NoStrength", "friction_angle: 25", "friction_angle: 0",
               "c.yaml:14: the soil has no strength (friction_angle and cohesion are both 0) give a friction angle, or "
               "the "
               "undrained strength as cohesion"},
        Spoilt{"GravityUpwards", "", "gravity: [0, 0, 9.81]\n",
               "c.yaml:18: gravity does not point down (z points up, so its third component is negative) write [0, 0, "
               "-9.81]"},
        Spoilt{"GravityTilted", "", "gravity: [1, 0, -9.81]\n",
               "c.yaml:18: gravity is tilted (the still water level is horizontal in z) tilt the bed instead"},
        Spoilt{"AbsorbingWidthAlone", "  crs: EPSG:32611", "  absorbing_width: 100",
               "c.yaml:5: no side is absorbing (terrain.absorbing_width has no effect) set one of terrain.sides to "
               "absorbing"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Flume, MalformedFlume,
    testing::Values(
        Spoilt{
            "VelocityThatSettles", "slide:\n", "numerics:\n  settle_time: 1\nslide:\n  velocity: [1, 0]\n",
            "c.yaml:11: slide.velocity with numerics.settle_time (the scene settles to rest before the run) leave one "
            "of the two out"},
        Spoilt{"VelocityOfASettledSlide", "slide:\n", "soil:\n  initial_stress: settled\nslide:\n  velocity: [1, 0]\n",
               "c.yaml:11: slide.velocity with soil.initial_stress: settled (the scene settles to rest before the run) "
               "leave one of the two out"},
        Spoilt{"WaveThatSettles", "\nslide:\n  bodies: [[[-0.1, 0.1], [-0.05, 0.1], [-0.05, 0.05]]]\n",
               "\n  wave: {kind: solitary, height: 0.01, crest: 1, direction: east}\nnumerics:\n  settle_time: 1\n",
               "c.yaml:8: water.wave with numerics.settle_time (the scene settles to rest before the run) leave one of "
               "the two out"},
        Spoilt{"ProfileGoesBack", "[2.2, 0]", "[-1, 0]",
               "c.yaml:5: terrain.profile goes back at x = -1 (the bed has one height at each x) sort by x; move a "
               "vertical step by a little"},
        Spoilt{"ProfileOfOnePoint", "[[-0.15, 0.15], [0, 0], [2.2, 0]]", "[[0, 0]]",
               "c.yaml:5: terrain.profile has one point (a line needs two) add points from west to east"},
        Spoilt{
            "WidthMissing", "dimension: 2\n", "",
            "c.yaml:4: terrain.width is missing (a 3-D scene with a profile reaches from y = 0 to width) add width, in "
            "m, or set dimension: 2"},
        Spoilt{"WidthIn2D", "terrain:", "terrain:\n  width: 1",
               "c.yaml:5: terrain.width has no meaning here (a 2-D scene has no y) leave it out"},
        Spoilt{"WindowIn2D", "terrain:", "terrain:\n  window: [0, 0, 1, 1]",
               "c.yaml:5: terrain.window has no meaning here (the bed is a profile, bounded by its ends and by width) "
               "leave it out"},
        Spoilt{"SidesIn2D", "terrain:", "terrain:\n  sides: {north: open}",
               "c.yaml:5: terrain.sides.north has no meaning here (a 2-D scene has no y) leave it out"},
        Spoilt{"SourcesAndProfile", "terrain:", "terrain:\n  sources: [{file: dem.tif}]",
               "c.yaml:6: terrain has both sources and a profile (there is one bed) leave one of them out"},
        Spoilt{"MovingBodyOutside", "", "bodies: [{name: B, outline: [[-3, 0], [-2, 0], [-2, 1]], motion: m.csv}]\n",
               "c.yaml:10: body B lies outside the domain (x from -3 to -2 is beyond terrain.profile) move it or widen "
               "the domain"},
        Spoilt{"DepthIn2D", "bodies: [[[-0.1, 0.1], [-0.05, 0.1], [-0.05, 0.05]]]", "depth: 0.1",
               "c.yaml:9: slide.depth in a 2-D scene (its soil is given as (x, z) outlines) use bodies"},
        Spoilt{"BodyOutside", "[-0.05, 0.05]]]", "[-0.5, 0.05]]]",
               "c.yaml:9: slide.bodies.0 lies outside the domain ((-0.5, 0.05) is beyond terrain.profile) move it or "
               "widen "
               "the domain"},
        Spoilt{"BodyOfTwoPoints", ", [-0.05, 0.05]]]", "]]",
               "c.yaml:9: slide.bodies.0 has 2 points (an outline needs three) add points around it"},
        Spoilt{"GaugeWithY", "", "gauges: [{name: G, x: 1, y: 2}]\n",
               "c.yaml:10: gauge G has a y (a 2-D scene lies in (x, z)) leave y out"},
        Spoilt{"GaugeWithZ", "", "gauges: [{name: G, x: 1, z: 2}]\n",
               "c.yaml:10: gauge G has a z (it measures the surface, wherever that is) leave z out or add quantity: "
               "pressure"},
        Spoilt{"PressureWithoutZ", "", "gauges: [{name: G, x: 1, quantity: pressure}]\n",
               "c.yaml:10: pressure gauge G has no z (pressure is measured at a point in the water) add z, its "
               "elevation in m"},
        Spoilt{"PressureWithoutWater", "water:\n  level: 0.1\n",
               "gauges: [{name: G, x: 1, z: 0, quantity: pressure}]\n",
               "c.yaml:6: gauge G measures pressure without water (it is that of the water) add water or leave "
               "quantity out"},
        Spoilt{"PressureNamedTime", "", "gauges: [{name: time, x: 1, z: 0, quantity: pressure}]\n",
               "c.yaml:10: a pressure gauge is named time (the times of its series have that name) rename it"},
        Spoilt{
            "QuantityUnknown", "", "gauges: [{name: G, x: 1, z: 0, quantity: speed}]\n",
            "c.yaml:10: gauges.0.quantity is \"speed\" (it is one of surface or pressure) did you mean \"surface\"?"},
        Spoilt{"SectionWithY", "", "sections: [{name: A, points: [[0, 0], [1, 1]]}]\n",
               "c.yaml:10: section A has a y (a 2-D scene lies in (x, z)) write 0 for y"},
        Spoilt{"WaveWithoutKind", "level: 0.1", "level: 0.1\n  wave: {height: 0.01}",
               "c.yaml:8: water.wave.kind is missing (waves differ in form and motion) add kind: solitary or kind: "
               "standing"},
        Spoilt{
            "SolitaryWaveWithoutCrest", "level: 0.1",
            "level: 0.1\n  wave: {kind: solitary, height: 0.01, direction: east}",
            "c.yaml:8: water.wave.crest is missing (a solitary wave has a height, a crest and a direction) add crest"},
        Spoilt{"StandingWaveWithHeight", "level: 0.1",
               "level: 0.1\n  wave: {kind: standing, amplitude: 0.01, mode: 1, height: 0.1}",
               "c.yaml:8: water.wave.height has no meaning here (the wave is standing) leave it out"},
        Spoilt{"WaveOutside", "level: 0.1",
               "level: 0.1\n  wave: {kind: solitary, height: 0.01, crest: 3, direction: east}",
               "c.yaml:8: water.wave.crest lies outside the domain ((3, 0) is beyond terrain.profile) move it or widen "
               "the domain"},
        Spoilt{"WaveWithSlide", "level: 0.1", "level: 0.1\n  wave: {kind: standing, amplitude: 0.01, mode: 1}",
               "c.yaml:8: water.wave with a slide (initial waves are those of undisturbed water) leave one of the two "
               "out"},
        Spoilt{"WaveOnBodies", "level: 0.1",
               "level: 0.1\n  bodies: [[[1, 0], [2, 0], [2, 0.1]]]\n  wave: {kind: standing, amplitude: 0.01, mode: 1}",
               "c.yaml:9: water.wave with water.bodies (a wave runs on still water) leave one of the two out"},
        Spoilt{"VelocityOfThreeIn2D", "slide:", "slide:\n  velocity: [1, 0, -1]",
               "c.yaml:9: slide.velocity has 3 numbers (2 are wanted) write [vx, vz] in 2-D"},
        Spoilt{"MotionWithoutFile", "slide:", "slide:\n  motion: {heading: 90}",
               "c.yaml:9: slide.motion.file is missing (a rigid slide moves as a file says) name a CSV file with the "
               "columns t_s,dx_m,dz_m"},
        Spoilt{"MotionWithSoil", "slide:", "soil: {density: 2700}\nslide:\n  motion: {file: m.csv}",
               "c.yaml:8: soil has no meaning here (the slide is rigid and moves as slide.motion says) leave it out"},
        Spoilt{"MotionWithVelocity", "slide:", "slide:\n  velocity: [1, 0]\n  motion: {file: m.csv}",
               "c.yaml:9: slide.velocity has no meaning here (the slide is rigid and moves as slide.motion says) leave "
               "it out"},
        Spoilt{"HeadingIn2D", "slide:", "slide:\n  motion: {file: m.csv, heading: 180}",
               "c.yaml:9: slide.motion.heading is 180 (a 2-D scene lies in (x, z)) write 90 (+x) or 270 (-x)"},
        Spoilt{"MotionWithoutWater", "water:\n  level: 0.1\nslide:", "slide:\n  motion: {file: m.csv}",
               "c.yaml:7: a rigid slide without water (nothing but the slide itself would move) add a water section"},
        Spoilt{
            "MovingBodyWithoutMotion", "", "bodies: [{name: B, outline: [[1, 0], [2, 0], [2, 1]]}]\n",
            "c.yaml:10: bodies.0.motion is missing (a moving body has a name, an outline and a motion) write {name: B, "
            "outline: [[x, z], [x, z], [x, z]], motion: file.csv}"},
        Spoilt{"MovingBodyCrossesItself", "",
               "bodies: [{name: B, outline: [[1, 0], [2, 1], [2, 0], [1, 1]], motion: m.csv}]\n",
               "c.yaml:10: bodies.0.outline crosses or touches itself (its edge from (1, 0) meets another) list the "
               "points once around, in order"},
        Spoilt{"MovingBodiesOfOneName", "",
               "bodies:\n- {name: B, outline: [[1, 0], [2, 0], [2, 1]], motion: m.csv}\n"
               "- {name: B, outline: [[1, 2], [2, 2], [2, 3]], motion: m.csv}\n",
               "c.yaml:12: two bodies are named B (their results would be mixed up) rename one of them"},
        Spoilt{"MovingBodyNamedSlide", "",
               "bodies: [{name: slide, outline: [[1, 0], [2, 0], [2, 1]], motion: m.csv}]\n",
               "c.yaml:10: a body is named slide (that is the slide's own name) rename it"},
        Spoilt{"GravityAcross", "", "gravity: [0, 1, -9.81]\n",
               "c.yaml:10: gravity has a y component (a 2-D scene lies in (x, z)) write [0, 0, -9.81]"}),
    name_of);

TEST(MalformedCase, NeitherWaterNorSlide) {
  EXPECT_EQ(message_of("name: dry\nparticle_spacing: 1\nterrain:\n  sources: [{file: dem.tif}]\n"),
            "c.yaml:1: neither water nor slide (nothing would move) add a water or a slide section");
}

TEST(MalformedCase, NotYaml) {
  EXPECT_EQ(message_of("name: demo\nterrain: [1, 2\n"),
            "c.yaml:3: not valid YAML (end of sequence flow not found) check indentation, brackets and quotes here");
  EXPECT_EQ(message_of("name: demo\n\tterrain: 3\n"),
            "c.yaml:2: not valid YAML (illegal tab when looking for indentation) check indentation, brackets and "
            "quotes here");
  EXPECT_EQ(message_of("# a comment\n, name: demo\n"),
            "c.yaml:2: not valid YAML (no value begins like this) check commas and brackets here");
  EXPECT_EQ(message_of("]"), "c.yaml:1: not valid YAML (illegal flow end) check indentation, brackets and quotes here");
  EXPECT_EQ(message_of(sound, {"name=,"}),
            "--set name=,:1: not valid YAML (no value begins like this) check commas and brackets here");
  EXPECT_EQ(message_of(""), "c.yaml:1: the case is empty (no key is in it) start from docs/case-reference.yaml");
  EXPECT_EQ(message_of("# only a comment\n"),
            "c.yaml:1: the case is empty (no key is in it) start from docs/case-reference.yaml");
  EXPECT_EQ(message_of("- a\n- b\n"),
            "c.yaml:1: not a case (it is a list where keys are wanted) start from docs/case-reference.yaml");
  EXPECT_EQ(message_of(std::string("\x89HDF\r\n\x1a\n", 8)),
            "c.yaml:2: not a text file (it holds control characters) give a case file in YAML");
  EXPECT_EQ(message_of("---\n" + sound), "accepted");
  EXPECT_EQ(message_of(sound + "---\n" + sound),
            "c.yaml:18: a second YAML document begins (a file holds one case) move it to a file of its own");
}

TEST(MalformedCase, BombsGoOffQuickly) {
  const auto start = std::chrono::steady_clock::now();
  // "Billion laughs": ten levels of ten aliases.
  std::ostringstream laughs;
  laughs << "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 10; ++i) {
    laughs << 'a' << i << ": &a" << i << " [x";
    for (int k = 0; k < 10; ++k) laughs << ", *a" << i - 1;
    laughs << "]\n";
  }
  EXPECT_EQ(message_of(laughs.str()),
            "c.yaml:1: a YAML anchor or alias (a case is read literally) write the value out");
  EXPECT_EQ(message_of(sound, {"slide.polygon=&a [*a]"}),
            "--set slide.polygon=&a [*a]:1: a YAML anchor or alias (a case is read literally) write the value out");
  EXPECT_EQ(message_of(sound + "# " + std::string(1 << 20, 'x')),
            "c.yaml:1: more than 1 MiB of text (a case is a page or two) put outlines into a vector file");
  EXPECT_EQ(message_of("name: " + std::string(500000, '[')),
            "c.yaml:1: not a case (it nests hundreds of levels deep) check brackets and indentation");
  std::string points = "slide:\n  polygon: [";
  for (int i = 0; i < 10001; ++i) points += "[1, 2], ";
  EXPECT_EQ(
      message_of(spoil(sound, {"", "polygon: [[391000, 3796000], [391500, 3796000], [391500, 3796500]]",
                               points.substr(9) + "]", ""})),
      "c.yaml:11: slide.polygon has 10001 points (at most 10000 are read from a case) put the outline into a vector "
      "file");
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 20);
}

TEST(MalformedCase, FilesThatCannotBeRead) {
  const auto message = [](const std::string& path) -> std::string {
    try {
      read_case(path);
    } catch (const InputError& e) {
      return e.what();
    }
    return "accepted";
  };
  EXPECT_EQ(message("/no/such/case.yaml"),
            "/no/such/case.yaml does not exist (a case file is needed) check the name and the folder you are in");
  EXPECT_EQ(message("/"), "/ is a folder (a case file is needed) name the file in it");
}

TEST(MalformedCase, Overrides) {
  EXPECT_EQ(message_of(sound, {"soil.friction_angle"}),
            "--set soil.friction_angle: not an override (key and value are joined by =) write --set key.sub=value");
  EXPECT_EQ(message_of(sound, {"soil..friction_angle=3"}),
            "--set soil..friction_angle=3: not an override (a part of the key is empty) write --set key.sub=value");
  EXPECT_EQ(
      message_of(sound, {"soil.friction_angle=0.5"}),
      "--set soil.friction_angle=0.5: soil.friction_angle is 0.5 (it must be 0 or at least 2 and at most 60 degrees; "
      "0.5 looks like radians) write 28.6479 if it is");
  EXPECT_EQ(message_of(sound, {"soil.fricton_angle=20"}),
            "--set soil.fricton_angle=20: unknown key \"fricton_angle\" (soil has no such key) did you mean "
            "\"friction_angle\"?");
  EXPECT_EQ(message_of(sound, {"sol.friction_angle=20"}),
            "--set sol.friction_angle=20: unknown key \"sol\" (a case has no such key) did you mean \"soil\"?");
  EXPECT_EQ(message_of(sound, {"gauges.2.x=1"}),
            "--set gauges.2.x=1: there is no item 2 in gauges (it is a list of 2) count from 0");
  EXPECT_EQ(message_of(sound, {"name.sub=1"}),
            "--set name.sub=1: name has no keys (it is \"demo\") name a key that exists");
  EXPECT_EQ(message_of(sound, {"soil.bed=[rough"}).substr(0, 39), "--set soil.bed=[rough:1: not valid YAML");
  EXPECT_EQ(message_of(sound, {"water.level=null"}),
            "c.yaml:7: water.level is missing (the still water level has no default) add level, in m of the terrain's "
            "vertical datum");
}

TEST(SelfIntersection, FindsTheEdge) {
  EXPECT_EQ(self_intersection({{0, 0}, {1, 0}, {1, 1}, {0, 1}}), -1);
  EXPECT_EQ(self_intersection({{0, 0}, {2, 0}, {2, 2}, {1, 0.5}, {0, 2}}), -1) << "not convex, but simple";
  EXPECT_EQ(self_intersection({{0, 0}, {1, 1}, {1, 0}, {0, 1}}), 0) << "a bow tie";
  EXPECT_EQ(self_intersection({{0, 0}, {1, 0}, {1, 0}, {0, 1}}), 0) << "a repeated point: edges 0 and 2 meet";
  EXPECT_EQ(self_intersection({{0, 0}, {2, 0}, {1, 0}}), 0) << "doubles back";
  EXPECT_EQ(self_intersection({{0, 0}, {2, 0}, {2, 2}, {1, 0}, {0, 2}}), 0) << "touches its first edge";
}

}  // namespace
}  // namespace lgiw
