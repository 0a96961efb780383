// The keys of a case file: names, units, admitted values. Combinations of keys are validate_case.cc's.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

#include "base/error.hh"
#include "case/case.hh"
#include "case/overridden_case.hh"
#include "case/validate_case.hh"
#include "case/yaml_document.hh"

namespace lgiw {
namespace {

Quantity above(double low, const std::string& unit) { return {.unit = unit, .low = low, .above_low = true}; }
Quantity automatic(const std::string& unit) { return {.unit = unit, .low = 0, .above_low = true, .automatic = true}; }
Quantity between(double low, double high, const std::string& unit = "") {
  return {.unit = unit, .low = low, .high = high};
}
/// Elevations: the deepest trench to the highest summit.
const Quantity elevation{
    .unit = "m", .low = -12000, .high = 9000, .mistakes = {{9000, 1e7, "mm", 1e-3}, {-1e7, -12000, "mm", 1e-3}}};
const Quantity coordinate{.unit = "m", .low = -1e8, .high = 1e8};

const std::vector<std::pair<std::string, Side>> side_words{
    {"wall", Side::wall}, {"absorbing", Side::absorbing}, {"open", Side::open}};
const std::vector<std::pair<std::string, WallFriction>> friction_words{
    {"rough", WallFriction::rough}, {"free_slip", WallFriction::free_slip}, {"coulomb", WallFriction::coulomb}};

const Quantity velocity{.unit = "m/s", .low = -1000, .high = 1000};

/// A vector [x, y, z], in 2-D given as [x, z].
void read_vector(const YamlSection& s, const std::string& key, int dimension, std::array<double, 3>& target,
                 const Quantity& horizontal, const Quantity& vertical, const std::string& form_3d,
                 const std::string& form_2d) {
  if (dimension == 3) return s.numbers(key, target.data(), {horizontal, horizontal, vertical}, form_3d);
  std::array<double, 2> flat{0, 0};
  s.numbers(key, flat.data(), {horizontal, vertical}, form_2d);
  target = {flat[0], 0, flat[1]};
}

/// Outlines are open: a last point that repeats the first, as vector files have it, goes.
void open_outline(std::vector<Point2>& outline) {
  if (outline.size() > 1 && outline.front() == outline.back()) outline.pop_back();
}

void read_terrain(const YamlSection& s, Terrain& t) {
  s.text("crs", t.crs);
  s.text("vertical_datum", t.vertical_datum);
  s.list("sources", t.sources, [](const YamlSection& item, TerrainSource& source) {
    item.require("file", "a source is a raster", "name one that GDAL opens");
    item.text("file", source.file);
    item.number("blend", source.blend, automatic("m"));
    item.number("vertical_shift", source.vertical_shift, between(-1000, 1000, "m"));
    item.text("attribution", source.attribution);
  });
  s.choice<bool>("voids", t.fill_voids, {{"refuse", false}, {"fill", true}});
  s.choice<bool>("spikes", t.remove_spikes, {{"keep", false}, {"remove", true}});
  s.number("spike_threshold", t.spike_threshold, automatic("m"));
  if (s.has("window")) {
    t.window.emplace();
    s.numbers("window", t.window->data(), std::vector<Quantity>(4, coordinate), "[x_min, y_min, x_max, y_max]");
  }
  s.points("profile", t.profile, "[x, z]");
  s.number("width", t.width, above(0, "m"));
  const YamlSection sides = s.section("sides");
  sides.choice("west", t.west, side_words);
  sides.choice("east", t.east, side_words);
  sides.choice("south", t.south, side_words);
  sides.choice("north", t.north, side_words);
  s.number("absorbing_width", t.absorbing_width, automatic("m"));
  Quantity top = elevation;
  top.automatic = true;
  s.number("wall_top", t.wall_top, top);
  s.number("reach_angle", t.reach_angle,
           {.unit = "degrees", .low = 2, .high = 60, .mistakes = {{1e-3, 1.1, "the tangent", 57.2958}}});
  s.number("runup_allowance", t.runup_allowance, automatic("m"));
}

void read_wave(const YamlSection& s, std::optional<Wave>& target) {
  Wave wave;
  s.require("kind", "waves differ in form and motion", "add kind: solitary or kind: standing");
  s.choice<WaveKind>("kind", wave.kind, {{"solitary", WaveKind::solitary}, {"standing", WaveKind::standing}});
  s.number("height", wave.height, above(0, "m"));
  s.number("crest", wave.crest, coordinate);
  s.choice<bool>("direction", wave.eastwards, {{"west", false}, {"east", true}});
  s.number("amplitude", wave.amplitude, above(0, "m"));
  s.integer("mode", wave.mode, between(1, 1000));
  if (s.present()) target = wave;
}

void read_water(const YamlSection& s, Water& w) {
  w.present = s.present();
  s.require("level", "the still water level has no default", "add level, in m of the terrain's vertical datum");
  s.number("level", w.level, elevation);
  if (s.has("seed")) {
    w.seed.emplace();
    s.numbers("seed", w.seed->data(), {coordinate, coordinate}, "[x, y]");
  }
  s.number("density", w.density,
           {.unit = "kg/m3",
            .low = 900,
            .high = 1300,
            .mistakes = {{0.9, 1.3, "t/m3", 1000}, {9, 13, "kN/m3", 1000 / 9.81}}});
  s.number("sound_speed", w.sound_speed, {.unit = "m/s", .low = 0, .high = 2000, .above_low = true, .automatic = true});
  s.number("viscosity_alpha", w.viscosity_alpha, between(0, 1));
  s.choice<bool>("walls", w.no_slip, {{"free_slip", false}, {"no_slip", true}});
  s.number("density_diffusion", w.density_diffusion, between(0, 1));
  s.point_lists("bodies", w.bodies, "[x, z]");
  std::for_each(w.bodies.begin(), w.bodies.end(), open_outline);
  read_wave(s.section("wave"), w.wave);
}

void read_plane(const YamlSection& s, std::optional<SlideSurface::Plane>& target) {
  for (const char* key : {"point", "dip", "dip_direction"})
    s.require(key, "a plane is a point, a dip and a dip direction",
              "write plane: {point: [x, y, z], dip: 30, dip_direction: 90}");
  double point[3] = {0, 0, 0};
  SlideSurface::Plane plane{0, 0, 0, 0, 0};
  s.numbers("point", point, {coordinate, coordinate, elevation}, "[x, y, z]");
  s.number("dip", plane.dip, {.unit = "degrees", .low = 0, .high = 85, .mistakes = {{85, 400, "gradians", 0.9}}});
  s.number("dip_direction", plane.dip_direction, between(0, 360, "degrees"));
  plane.x = point[0], plane.y = point[1], plane.z = point[2];
  if (s.present()) target = plane;
}

void read_slbl(const YamlSection& s, std::optional<SlideSurface::Slbl>& target) {
  SlideSurface::Slbl slbl;
  s.number("tolerance", slbl.tolerance, automatic("m"));
  s.number("max_depth", slbl.max_depth, automatic("m"));
  s.number("max_slope", slbl.max_slope, {.unit = "degrees", .low = 2, .high = 90, .automatic = true});
  s.integer("neighbours", slbl.neighbours, between(4, 8));
  if (s.present()) target = slbl;
}

void read_motion(const YamlSection& s, int dimension, std::optional<SlideMotion>& target) {
  SlideMotion motion;
  s.require("file", "a rigid slide moves as a file says", "name a CSV file with the columns t_s,dx_m,dz_m");
  s.text("file", motion.file);
  std::array<double, 3> pivot{0, 0, 0};
  read_vector(s, "pivot", dimension, pivot, coordinate, elevation, "[x, y, z]", "[x, z] in 2-D");
  if (s.has("pivot")) motion.pivot = pivot;
  s.number("heading", motion.heading, between(0, 360, "degrees"));
  if (s.present()) target = motion;
}

void read_body(const YamlSection& s, MovingBody& body) {
  for (const char* key : {"name", "outline", "motion"})
    s.require(key, "a moving body has a name, an outline and a motion",
              "write {name: B, outline: [[x, z], [x, z], [x, z]], motion: file.csv}");
  s.text("name", body.name);
  s.points("outline", body.outline, "[x, z]");
  open_outline(body.outline);
  s.text("motion", body.motion);
  if (s.has("pivot")) body.pivot.emplace();
  Point2 pivot{0, 0};
  s.numbers("pivot", body.pivot ? body.pivot->data() : pivot.data(), {coordinate, elevation}, "[x, z]");
}

void read_slide(const YamlSection& s, int dimension, Slide& slide) {
  slide.present = s.present();
  s.points("polygon", slide.polygon, "[x, y]");
  open_outline(slide.polygon);
  s.text("polygon_file", slide.polygon_file);
  s.text("before", slide.surface.before);
  s.text("after", slide.surface.after);
  s.text("thickness", slide.surface.thickness);
  s.text("failure_surface", slide.surface.failure_surface);
  s.number("depth", slide.surface.depth,
           {.unit = "m", .low = 0, .high = 2000, .above_low = true, .mistakes = {{2000, 1e6, "mm", 1e-3}}});
  read_plane(s.section("plane"), slide.surface.plane);
  s.number("base_elevation", slide.surface.base_elevation, elevation);
  read_slbl(s.section("slbl"), slide.surface.slbl);
  s.point_lists("bodies", slide.bodies, "[x, z]");
  std::for_each(slide.bodies.begin(), slide.bodies.end(), open_outline);
  s.number("min_thickness", slide.min_thickness, automatic("m"));
  read_vector(s, "velocity", dimension, slide.velocity, velocity, velocity, "[vx, vy, vz]", "[vx, vz] in 2-D");
  read_motion(s.section("motion"), dimension, slide.motion);
}

// 1.58 is just above pi / 2: everything below looks like radians or a fraction.
const std::vector<UnitMistake> radians{{1e-9, 1.58, "radians", 57.2958}};

void read_soil_rate(const YamlSection& s, SoilRate& rate) {
  rate.present = s.present();
  for (const char* key : {"friction_angle_fast", "grain_diameter"})
    s.require(key, "the strength at high rates has no default",
              "write rate: {friction_angle_fast: 41, grain_diameter: 0.001}");
  s.number("friction_angle_fast", rate.friction_angle_fast,
           {.unit = "degrees", .low = 2, .high = 70, .mistakes = radians});
  s.number("inertial_number", rate.inertial_number, {.low = 0, .high = 10, .above_low = true});
  s.number("grain_diameter", rate.grain_diameter,
           {.unit = "m", .low = 1e-6, .high = 10, .mistakes = {{10, 1e4, "mm", 1e-3}}});
  s.number("grain_density", rate.grain_density,
           {.unit = "kg/m3", .low = 500, .high = 9000, .mistakes = {{0.5, 9, "t/m3", 1000}}});
}

void read_soil(const YamlSection& s, Soil& soil) {
  s.number("density", soil.density,
           {.unit = "kg/m3",
            .low = 300,
            .high = 5000,
            .mistakes = {{0.3, 5, "t/m3 (or g/cm3)", 1000}, {5, 40, "kN/m3", 1000 / 9.81}}});
  s.number("friction_angle", soil.friction_angle,
           {.unit = "degrees", .low = 2, .high = 60, .or_zero = true, .mistakes = radians});
  s.number("cohesion", soil.cohesion, between(0, 1e8, "Pa"));
  s.number("dilatancy_angle", soil.dilatancy_angle, {.unit = "degrees", .low = 0.1, .high = 45, .or_zero = true});
  s.number("young_modulus", soil.young_modulus,
           {.unit = "Pa", .low = 1e4, .high = 1e12, .mistakes = {{0.1, 1000, "MPa", 1e6}, {1000, 1e4, "kPa", 1000}}});
  s.number("poisson_ratio", soil.poisson_ratio, {.low = 0, .high = 0.5, .above_low = true, .below_high = true});
  s.number("viscosity_alpha", soil.viscosity_alpha, {.low = 0, .high = 10, .above_low = true, .automatic = true});
  s.number("stress_diffusion", soil.stress_diffusion, between(0, 1));
  s.number("artificial_stress", soil.artificial_stress, between(0, 1));
  s.choice<ConeMatching>("cone", soil.cone,
                         {{"plane_strain", ConeMatching::plane_strain},
                          {"plane_strain_associated", ConeMatching::plane_strain_associated},
                          {"compression_cone", ConeMatching::compression_cone}});
  s.choice<PorePressure>("pore_pressure", soil.pore_pressure,
                         {{"none", PorePressure::none}, {"hydrostatic", PorePressure::hydrostatic}});
  s.choice("bed", soil.bed, friction_words);
  s.choice("sides", soil.sides, friction_words);
  s.number("bed_friction_angle", soil.bed_friction_angle,
           {.unit = "degrees", .low = 2, .high = 60, .or_zero = true, .mistakes = radians});
  s.choice<InitialStress>("initial_stress", soil.initial_stress,
                          {{"k0", InitialStress::k0}, {"settled", InitialStress::settled}});
  read_soil_rate(s.section("rate"), soil.rate);
}

void read_interface(const YamlSection& s, Interface& interface) {
  s.flag("repulsion", interface.repulsion);
  s.number("velocity_factor", interface.velocity_factor, between(1, 2));
}

/// The numerics of Huang et al. 2023 as far as they run: with the corrections of the coupling, which as printed
/// diverges.
void apply_scheme_defaults(Case& c) {
  if (c.numerics.scheme != "huang2023") return;
  c.numerics.kernel = KernelName::cubic;
  c.numerics.h_over_dp = 1.5;
  c.numerics.integrator = Integrator::verlet;
  c.numerics.return_mapping = false;
  c.numerics.wall_viscosity = false;
  c.water.viscosity_alpha = 0.05;
  c.water.no_slip = true;
  c.water.density_diffusion = 0;
  c.soil.viscosity_alpha = 0.1;
  c.soil.stress_diffusion = 0;
  c.soil.artificial_stress = 0.5;
  c.soil.pore_pressure = PorePressure::none;
  c.interface.repulsion = true;
  c.interface.velocity_factor = 2;
}

void read_numerics(const YamlSection& s, Numerics& n) {
  s.choice<KernelName>("kernel", n.kernel, {{"wendland", KernelName::wendland}, {"cubic", KernelName::cubic}});
  s.number("h_over_dp", n.h_over_dp, between(1, 3));
  s.choice<Integrator>("integrator", n.integrator,
                       {{"leapfrog", Integrator::leapfrog}, {"verlet", Integrator::verlet}});
  // At 0.4 it diverges; without density diffusion a dam break in 3-D gains 11 % of its energy at 0.2 and 0.2 % at 0.1.
  if (n.integrator == Integrator::verlet) n.cfl = n.scheme == "huang2023" ? 0.2 : 0.1;
  s.number("cfl", n.cfl, {.low = 0, .high = 1, .above_low = true});
  s.integer("retakes", n.retakes, {.low = 0, .high = 6});
  s.choice<bool>("constitutive", n.return_mapping, {{"return_mapping", true}, {"rate_form", false}});
  s.flag("wall_viscosity", n.wall_viscosity);
  s.choice<bool>("strain_rate", n.corrected_strain_rate, {{"plain", false}, {"corrected", true}});
  s.number("shifting", n.shifting, between(0, 10));
  s.choice<Precision>("precision", n.precision,
                      {{"single", Precision::single_}, {"mixed", Precision::mixed}, {"double", Precision::double_}});
  s.number("settle_time", n.settle_time, between(0, 1e5, "s"));
  s.choice<Backend>("backend", n.backend, {{"auto", Backend::auto_}, {"cpu", Backend::cpu}, {"cuda", Backend::cuda}});
  s.integer("threads", n.threads, {.low = 1, .high = 4096, .automatic = true});
}

void read_output(const YamlSection& s, Output& o) {
  s.number("end_time", o.end_time, {.unit = "s", .low = 0, .high = 1e6, .above_low = true});
  o.frame_interval = o.end_time / 60;
  s.number("frame_interval", o.frame_interval, above(0, "s"));
  s.number("surface_interval", o.surface_interval, automatic("s"));
  s.number("map_spacing", o.map_spacing, automatic("m"));
  s.number("arrival_threshold", o.arrival_threshold, automatic("m"));
  s.number("checkpoint_interval", o.checkpoint_interval, above(0, "s"));
}

void read_gauge(const YamlSection& s, Gauge& gauge) {
  s.require("name", "the results of a gauge carry its name", "write {name: G1, x: ..., y: ...}");
  s.require("x", "a gauge is a place", "write {name: G1, x: ..., y: ...}");
  s.text("name", gauge.name);
  s.number("x", gauge.x, coordinate);
  s.number("y", gauge.y, coordinate);
  s.choice("quantity", gauge.quantity, {{"surface", GaugeQuantity::surface}, {"pressure", GaugeQuantity::pressure}});
  s.number("z", gauge.z, elevation);
}

void read_section_line(const YamlSection& s, Section& section) {
  for (const char* key : {"name", "points"})
    s.require(key, "a section is a named line", "write {name: A, points: [[x, y], [x, y]]}");
  s.text("name", section.name);
  s.points("points", section.points, "[x, y]");
}

void read_fields(const YamlSection& root, Case& c) {
  root.require("name", "outputs carry the name of the case", "add name: my_case");
  root.require("particle_spacing", "the resolution has no default", "add particle_spacing, in m");
  root.require("terrain", "a case needs a bed", "add terrain with sources (rasters) or a profile");
  root.text("name", c.name);
  root.choice<int>("dimension", c.dimension, {{"2", 2}, {"3", 3}});
  root.number("particle_spacing", c.dp, {.unit = "m", .low = 1e-5, .high = 1000});
  const Quantity acceleration{.unit = "m/s2", .low = -100, .high = 100};
  root.numbers("gravity", c.gravity.data(), {acceleration, acceleration, acceleration}, "[0, 0, -9.81]");
  const YamlSection numerics = root.section("numerics");
  numerics.choice<std::string>("scheme", c.numerics.scheme, {{"lgiw", "lgiw"}, {"huang2023", "huang2023"}});
  apply_scheme_defaults(c);
  read_numerics(numerics, c.numerics);
  read_terrain(root.section("terrain"), c.terrain);
  read_water(root.section("water"), c.water);
  read_slide(root.section("slide"), c.dimension, c.slide);
  root.list("bodies", c.bodies, read_body);
  read_soil(root.section("soil"), c.soil);
  read_interface(root.section("interface"), c.interface);
  read_output(root.section("output"), c.output);
  root.list("gauges", c.gauges, read_gauge);
  root.list("sections", c.sections, read_section_line);
  root.section("deposit").number("adps_threshold", c.deposit.adps_threshold,
                                 {.low = 0, .high = 100, .above_low = true});
}

/// Reading an empty document asks for every key there is.
const std::set<std::string>& known_keys() {
  static const std::set<std::string> keys = [] {
    YamlDocument empty;
    Case unused;
    read_fields(YamlSection(empty), unused);
    return empty.asked;
  }();
  return keys;
}

}  // namespace

std::vector<std::string> known_case_keys() { return {known_keys().begin(), known_keys().end()}; }

Case parse_overridden_case(const std::string& text, const std::string& name_for_messages,
                           const std::vector<Override>& overrides) {
  YamlDocument document(text, name_for_messages, overrides);
  document.check_keys(known_keys());
  Case c;
  read_fields(YamlSection(document), c);
  c.places = document.places();
  validate_case(c);
  // What is stored beside the results must say what was run.
  c.text = overrides.empty() ? text : YAML::Dump(document.root()) + "\n";
  return c;
}

Case parse_case(const std::string& text, const std::string& name_for_messages,
                const std::vector<std::string>& overrides) {
  std::vector<Override> given;
  for (const std::string& option : overrides) given.push_back(override_of_option(option));
  return parse_overridden_case(text, name_for_messages, given);
}

std::string read_case_text(const std::string& path, const std::string& what) {
  std::string text;
  const auto read = [&text](std::istream& stream) {
    // One byte more than a case may have: enough to be refused, whatever comes through the pipe.
    text.resize((1 << 20) + 1);
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(stream.gcount()));
    return !stream.bad();
  };
  if (path == "-") {
    LGIW_VALIDATE(read(std::cin), "stdin cannot be read", "the pipe failed", "name the file instead");
  } else {
    LGIW_VALIDATE(std::filesystem::exists(path), path + " does not exist", what + " is needed",
                  "check the name and the folder you are in");
    LGIW_VALIDATE(!std::filesystem::is_directory(path), path + " is a folder", what + " is needed",
                  "name the file in it");
    std::ifstream file(path, std::ios::binary);
    LGIW_VALIDATE(file && read(file), path + " cannot be read", "the file could not be opened",
                  "check its permissions");
  }
  return text;
}

Case read_case(const std::string& path, const std::vector<std::string>& overrides) {
  Case c = parse_case(read_case_text(path, "a case file"), path == "-" ? "stdin" : path, overrides);
  c.path = path;
  return c;
}

}  // namespace lgiw
