#include "case/case.hh"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

#include "base/error.hh"
#include "case/attribution.hh"
#include "case/dotted_key.hh"
#include "case_summary.hh"

namespace lgiw {
namespace {

const std::string minimal = R"(name: canyon
particle_spacing: 12
terrain:
  sources: [{file: dem.tif}]
water:
  level: 740
  seed: [390700, 3795400]
)";

const std::string slide = R"(slide:
  polygon: [[391000, 3796000], [391500, 3796000], [391500, 3796500]]
  depth: 40
)";

TEST(Case, MinimalCaseHasTheDefaultsOfTheHeader) {
  const Case c = parse_case(minimal, "c.yaml");
  Case expected;
  expected.name = "canyon";
  expected.dp = 12;
  expected.terrain.sources = {TerrainSource{"dem.tif", 0, 0, ""}};
  expected.water.present = true;
  expected.water.level = 740;
  expected.water.seed = Point2{390700, 3795400};
  EXPECT_EQ(case_summary(c), case_summary(expected));
  EXPECT_EQ(c.text, minimal);
  EXPECT_EQ(c.path, "");
  EXPECT_FALSE(c.slide.present);
  EXPECT_TRUE(case_warnings(c).empty());
}

TEST(Case, ReadsWavesMotionsAndMovingBodies) {
  const std::string flume = "name: f\ndimension: 2\nparticle_spacing: 0.01\nterrain: {profile: [[0, 0], [10, 0]]}\n";
  const Case moving = parse_case(flume + R"(
water: {level: 0.5}
slide: {bodies: [[[1, 0], [2, 0], [2, 1]]], velocity: [1.5, -2]}
bodies:
- {name: plate, outline: [[3, 0], [3.1, 0], [3.1, 1], [3, 1], [3, 0]], motion: m/plate.csv}
- {name: gate, outline: [[5, 0], [6, 0], [6, 1]], motion: gate.csv, pivot: [5.5, 2]}
)",
                                 "c.yaml");
  const Case wavy = parse_case(
      flume + "water: {level: 0.5, wave: {kind: solitary, height: 0.1, crest: 4, direction: east}}\n", "c.yaml");
  ASSERT_TRUE(wavy.water.wave);
  EXPECT_EQ(wavy.water.wave->kind, WaveKind::solitary);
  EXPECT_EQ(wavy.water.wave->height, 0.1);
  EXPECT_EQ(wavy.water.wave->crest, 4);
  EXPECT_TRUE(wavy.water.wave->eastwards);
  EXPECT_EQ(moving.slide.velocity, (std::array<double, 3>{1.5, 0, -2}));
  EXPECT_TRUE(moving.has_soil());
  ASSERT_EQ(moving.bodies.size(), 2u);
  EXPECT_EQ(moving.bodies[0].name, "plate");
  EXPECT_EQ(moving.bodies[0].outline.size(), 4u) << "the repeated first point goes";
  EXPECT_EQ(moving.bodies[0].motion, "m/plate.csv");
  EXPECT_FALSE(moving.bodies[0].pivot);
  EXPECT_EQ(*moving.bodies[1].pivot, (Point2{5.5, 2}));

  const Case rigid = parse_case(flume + R"(
water: {level: 0.5}
slide: {bodies: [[[1, 0], [2, 0], [2, 1]]], motion: {file: m.csv, pivot: [1.5, 0.5], heading: 270}}
)",
                                "c.yaml");
  const Case still =
      parse_case(flume + "water: {level: 0.5, wave: {kind: standing, amplitude: 0.02, mode: 3}}\n", "c.yaml");
  EXPECT_EQ(still.water.wave->kind, WaveKind::standing);
  EXPECT_EQ(still.water.wave->amplitude, 0.02);
  EXPECT_EQ(still.water.wave->mode, 3);
  ASSERT_TRUE(rigid.slide.motion);
  EXPECT_FALSE(rigid.has_soil());
  EXPECT_EQ(rigid.slide.motion->file, "m.csv");
  EXPECT_EQ(*rigid.slide.motion->pivot, (std::array<double, 3>{1.5, 0, 0.5}));
  EXPECT_EQ(rigid.slide.motion->heading, 270);
}

TEST(Case, ReadsEveryKindOfValue) {
  const Case c = parse_case(R"(
name: "Canyon-2.b_o'clock"
particle_spacing: 1.25e+1
gravity: [0, 0, -9.8]
terrain:
  crs: EPSG:32611
  vertical_datum: EGM96
  sources:
  - file: coarse.tif
  - {file: sub/fine.tif, blend: 90, vertical_shift: -0.4, attribution: "Office: <A> & B, CC BY 4.0"}
  - {file: finest.tif, attribution: SRTM}
  - {file: site.tif, attribution: "Office: <A> & B, CC BY 4.0"}
  voids: fill
  spikes: remove
  spike_threshold: 80
  window: [388400, 3793300, 394200, 3798000]
  sides: {west: open, south: absorbing}
  absorbing_width: auto
  wall_top: -12
  reach_angle: 9
  runup_allowance: 30
water: {level: 740, seed: [390700, 3795400], sound_speed: auto}
slide:
  polygon: [[391000, 3796000], [391500, 3796000], [391500, 3796500], [391000, 3796000]]
  plane: {point: [391200, 3796100, 800], dip: 30, dip_direction: 225}
  min_thickness: 2
soil: {cone: compression_cone, bed: coulomb, bed_friction_angle: 20, pore_pressure: none, initial_stress: settled}
interface: {repulsion: no, velocity_factor: 1.5}
numerics: {constitutive: rate_form, precision: double, backend: cpu, threads: 4, settle_time: 5}
output: {end_time: 120, arrival_threshold: 0.5}
gauges:
- {name: G1, x: 390000, y: 3795000}
- {name: 2, x: 391000, y: 3795000}
sections:
- name: A
  points: [[391200, 3796100], [391000, 3795000], [390500, 3794000]]
deposit: {adps_threshold: 0.1}
)",
                            "c.yaml");
  EXPECT_EQ(c.name, "Canyon-2.b_o'clock");
  EXPECT_EQ(c.dp, 12.5);
  EXPECT_EQ(c.gravity[2], -9.8);
  ASSERT_EQ(c.terrain.sources.size(), 4u);
  EXPECT_EQ(terrain_attribution(c.terrain), "Office: <A> & B, CC BY 4.0; SRTM");
  EXPECT_EQ(c.terrain.sources[0].blend, 0);
  EXPECT_EQ(c.terrain.sources[1].file, "sub/fine.tif");
  EXPECT_EQ(c.terrain.sources[1].blend, 90);
  EXPECT_EQ(c.terrain.sources[1].vertical_shift, -0.4);
  EXPECT_TRUE(c.terrain.fill_voids);
  EXPECT_TRUE(c.terrain.remove_spikes);
  EXPECT_EQ(c.terrain.spike_threshold, 80);
  EXPECT_EQ((*c.terrain.window)[3], 3798000);
  EXPECT_EQ(c.terrain.west, Side::open);
  EXPECT_EQ(c.terrain.east, Side::wall);
  EXPECT_EQ(c.terrain.south, Side::absorbing);
  EXPECT_EQ(c.terrain.wall_top, -12);
  EXPECT_EQ(c.terrain.reach_angle, 9);
  EXPECT_EQ(c.terrain.runup_allowance, 30);
  EXPECT_EQ(c.water.sound_speed, 0);
  EXPECT_EQ(c.slide.polygon.size(), 3u) << "the closing point goes";
  ASSERT_TRUE(c.slide.surface.plane);
  EXPECT_EQ(c.slide.surface.plane->z, 800);
  EXPECT_EQ(c.slide.surface.plane->dip, 30);
  EXPECT_EQ(c.slide.surface.plane->dip_direction, 225);
  EXPECT_FALSE(c.slide.surface.depth || c.slide.surface.slbl || c.slide.surface.base_elevation);
  EXPECT_EQ(c.slide.min_thickness, 2);
  EXPECT_EQ(c.soil.cone, ConeMatching::compression_cone);
  EXPECT_EQ(c.soil.bed, WallFriction::coulomb);
  EXPECT_EQ(c.soil.bed_friction_angle, 20);
  EXPECT_EQ(c.soil.pore_pressure, PorePressure::none);
  EXPECT_EQ(c.soil.initial_stress, InitialStress::settled);
  EXPECT_FALSE(c.interface.repulsion);
  EXPECT_EQ(c.interface.velocity_factor, 1.5);
  EXPECT_FALSE(c.numerics.return_mapping);
  EXPECT_EQ(c.numerics.precision, Precision::double_);
  EXPECT_EQ(c.numerics.backend, Backend::cpu);
  EXPECT_EQ(c.numerics.threads, 4);
  EXPECT_EQ(c.numerics.settle_time, 5);
  EXPECT_EQ(c.output.frame_interval, 2) << "a sixtieth of end_time";
  EXPECT_EQ(c.output.arrival_threshold, 0.5);
  ASSERT_EQ(c.gauges.size(), 2u);
  EXPECT_EQ(c.gauges[1].name, "2");
  EXPECT_EQ(c.gauges[1].x, 391000);
  ASSERT_EQ(c.sections.size(), 1u);
  EXPECT_EQ(c.sections[0].points[2], (Point2{390500, 3794000}));
  EXPECT_EQ(c.deposit.adps_threshold, 0.1);
}

TEST(Case, EveryFailureSurfaceStandsAlone) {
  const auto surface = [](const std::string& keys) {
    return parse_case(minimal + "slide: {polygon_file: slide.gpkg, " + keys + "}\n", "c.yaml").slide.surface;
  };
  EXPECT_EQ(*surface("depth: 40").depth, 40);
  EXPECT_EQ(*surface("base_elevation: -3").base_elevation, -3);
  EXPECT_EQ(surface("failure_surface: f.tif").failure_surface, "f.tif");
  EXPECT_EQ(surface("thickness: t.tif").thickness, "t.tif");
  EXPECT_EQ(surface("before: a.tif, after: b.tif").after, "b.tif");
  const auto slbl = surface("slbl: {tolerance: 0.5, max_depth: 60, max_slope: 40, neighbours: 8}").slbl;
  EXPECT_EQ(slbl->tolerance, 0.5);
  EXPECT_EQ(slbl->max_depth, 60);
  EXPECT_EQ(slbl->max_slope, 40);
  EXPECT_EQ(slbl->neighbours, 8);
  EXPECT_EQ(surface("slbl: {}").slbl->neighbours, 4);
  // Rasters of the thickness need no outline.
  EXPECT_TRUE(parse_case(minimal + "slide: {thickness: t.tif}\n", "c.yaml").slide.present);
}

TEST(Case, AnalyticScenes) {
  const Case flume = parse_case(R"(name: flume
dimension: 2
particle_spacing: 0.005
terrain: {profile: [[-0.15, 0.15], [0, 0], [2.2, 0]]}
water: {level: 0.1, bodies: [[[0, 0], [1, 0], [1, 0.1], [0, 0.1]]]}
slide: {bodies: [[[-0.1, 0.1], [-0.05, 0.1], [-0.05, 0.05]]]}
gauges: [{name: G1, x: 0.45}, {name: P1, x: 0.45, z: 0.02, quantity: pressure}]
sections: [{name: A, points: [[0, 0], [2, 0]]}]
)",
                                "c.yaml");
  EXPECT_EQ(flume.dimension, 2);
  EXPECT_EQ(flume.terrain.profile.size(), 3u);
  EXPECT_EQ(flume.water.bodies[0][2], (Point2{1, 0.1}));
  EXPECT_EQ(flume.slide.bodies[0][2], (Point2{-0.05, 0.05}));
  EXPECT_EQ(flume.gauges[0].y, 0);
  EXPECT_EQ(flume.gauges[0].quantity, GaugeQuantity::surface);
  EXPECT_EQ(flume.gauges[1].quantity, GaugeQuantity::pressure);
  EXPECT_EQ(flume.gauges[1].z, 0.02);
  EXPECT_TRUE(case_warnings(flume).empty()) << "a gauge of another kind may stand in the same column";
  const Case basin = parse_case(R"(name: basin
particle_spacing: 0.02
terrain: {profile: [[0, 1], [1, 0], [3, 0]], width: 0.5}
slide: {bodies: [[[0.2, 0.8], [0.6, 0.4], [0.6, 0.8]]]}
)",
                                "c.yaml");
  EXPECT_EQ(basin.terrain.width, 0.5);
  EXPECT_FALSE(basin.water.present);
}

TEST(Case, SchemeOfHuang2023SetsDefaultsAndExplicitKeysWin) {
  const Case scheme = parse_case(minimal + slide + "numerics: {scheme: huang2023}\n", "c.yaml");
  EXPECT_EQ(scheme.numerics.scheme, "huang2023");
  EXPECT_EQ(scheme.numerics.kernel, KernelName::cubic);
  EXPECT_EQ(scheme.numerics.h_over_dp, 1.5);
  EXPECT_EQ(scheme.numerics.integrator, Integrator::verlet);
  EXPECT_EQ(scheme.numerics.cfl, 0.2);
  EXPECT_FALSE(scheme.numerics.return_mapping);
  EXPECT_FALSE(scheme.numerics.wall_viscosity);
  EXPECT_EQ(scheme.water.viscosity_alpha, 0.05);
  EXPECT_EQ(scheme.water.density_diffusion, 0);
  EXPECT_EQ(scheme.soil.viscosity_alpha, 0.1);
  EXPECT_EQ(scheme.soil.stress_diffusion, 0);
  EXPECT_EQ(scheme.soil.artificial_stress, 0.5);
  EXPECT_EQ(scheme.soil.pore_pressure, PorePressure::none);
  EXPECT_TRUE(scheme.interface.repulsion);
  EXPECT_EQ(scheme.interface.velocity_factor, 2);

  const Case mixed = parse_case(minimal + slide + R"(soil: {viscosity_alpha: auto, pore_pressure: hydrostatic}
numerics: {cfl: 0.1, kernel: wendland, scheme: huang2023}
interface: {velocity_factor: 1}
)",
                                "c.yaml");
  EXPECT_EQ(mixed.soil.viscosity_alpha, 0);
  EXPECT_EQ(mixed.soil.pore_pressure, PorePressure::hydrostatic);
  EXPECT_EQ(mixed.numerics.cfl, 0.1);
  EXPECT_EQ(mixed.numerics.kernel, KernelName::wendland);
  EXPECT_EQ(mixed.interface.velocity_factor, 1);
  EXPECT_EQ(mixed.soil.artificial_stress, 0.5);

  EXPECT_EQ(parse_case(minimal + "numerics: {integrator: verlet}\n", "c.yaml").numerics.cfl, 0.1);
}

TEST(Case, OverridesReplaceAddAndRemove) {
  const Case c = parse_case(
      minimal + slide + "gauges: [{name: G1, x: 390000, y: 3795000}]\n", "c.yaml",
      {"water.level=720", "gauges.0.x=390010", "soil={friction_angle: 28, cohesion: 2.0e+4}", "soil.cohesion=1e4",
       "numerics.scheme=huang2023", "slide.depth=null", "slide.slbl.max_depth=50", "terrain.crs=EPSG:32611"});
  EXPECT_EQ(c.water.level, 720);
  EXPECT_EQ(c.gauges[0].x, 390010);
  EXPECT_EQ(c.gauges[0].y, 3795000);
  EXPECT_EQ(c.soil.friction_angle, 28);
  EXPECT_EQ(c.soil.cohesion, 1e4) << "later ones win";
  EXPECT_EQ(c.numerics.kernel, KernelName::cubic);
  EXPECT_FALSE(c.slide.surface.depth);
  EXPECT_EQ(c.slide.surface.slbl->max_depth, 50);
  EXPECT_EQ(c.terrain.crs, "EPSG:32611");
  EXPECT_EQ(c.where("soil.cohesion"), "--set soil.cohesion=1e4");
  EXPECT_EQ(c.where("soil.friction_angle"), "--set soil={friction_angle: 28, cohesion: 2.0e+4}");
  EXPECT_EQ(c.where("slide.slbl"), "--set slide.slbl.max_depth=50");
  EXPECT_EQ(c.where("water.seed"), "c.yaml:7");

  EXPECT_FALSE(parse_case(minimal + slide, "c.yaml", {"water="}).water.present);
  EXPECT_TRUE(parse_case(minimal + "gauges: [{name: G1, x: 1, y: 2}]\n", "c.yaml", {"gauges.0=null"}).gauges.empty());
}

TEST(Case, AnOverrideAddsToAList) {
  const Case c = parse_case(minimal + slide, "c.yaml",
                            {"terrain.sources+={file: site.tif}", "gauges+={name: G1, x: 390000, y: 3795000}",
                             "gauges+={name: G2, x: 390100, y: 3795000}", "gauges.1.x=390200"});
  ASSERT_EQ(c.terrain.sources.size(), 2u);
  EXPECT_EQ(c.terrain.sources[1].file, "site.tif");
  EXPECT_EQ(c.where("terrain.sources.1"), "--set terrain.sources+={file: site.tif}");
  EXPECT_EQ(c.where("terrain.sources.0").rfind("c.yaml:", 0), 0u) << c.where("terrain.sources.0");
  ASSERT_EQ(c.gauges.size(), 2u);
  EXPECT_EQ(c.gauges[1].x, 390200);
  try {
    parse_case(minimal + slide, "c.yaml", {"water.level+=3"});
    ADD_FAILURE() << "no error";
  } catch (const InputError& e) {
    EXPECT_EQ(std::string(e.what()).rfind("--set water.level+=3: water.level is \"", 0), 0u) << e.what();
  }
}

TEST(Case, StoredTextHoldsTheOverrides) {
  // The text goes with the results; whoever reads it there must see the case that was run.
  const std::string text = minimal + slide + "gauges: [{name: \"007\", x: 390000, y: 3795000.123456789}]\n";
  const Case c =
      parse_case(text, "c.yaml", {"water.level=720.1", "name=lower", "terrain.vertical_datum='EGM96: \xC3\xA9'"});
  EXPECT_NE(c.text, text);
  EXPECT_EQ(case_summary(parse_case(c.text, "run.h5")), case_summary(c));
  EXPECT_EQ(c.gauges[0].name, "007");
  EXPECT_EQ(c.gauges[0].y, 3795000.123456789);
}

TEST(Case, KnowsWhereItsKeysStand) {
  const Case c = parse_case(minimal + slide, "canyon.yaml");
  EXPECT_EQ(c.where("water.seed"), "canyon.yaml:7");
  EXPECT_EQ(c.where("water.density"), "canyon.yaml:5") << "not given: its section";
  EXPECT_EQ(c.where("slide.polygon.2"), "canyon.yaml:9");
  EXPECT_EQ(c.where("numerics.cfl"), "canyon.yaml:1") << "no section either: the document";
}

TEST(Case, ReadsFilesAndResolvesNamesAgainstTheirFolder) {
  std::string folder = (std::filesystem::temp_directory_path() / "lgiw-case-XXXXXX").string();
  ASSERT_NE(mkdtemp(folder.data()), nullptr);
  std::ofstream(folder + "/case.yaml") << minimal;
  const Case c = read_case(folder + "/case.yaml", {"water.level=700"});
  EXPECT_EQ(c.path, folder + "/case.yaml");
  EXPECT_EQ(c.folder(), folder);
  EXPECT_EQ(c.resolve("dem.tif"), folder + "/dem.tif");
  EXPECT_EQ(c.resolve("/vsizip//data/dem.zip"), "/vsizip//data/dem.zip");
  EXPECT_EQ(c.water.level, 700);
  EXPECT_EQ(c.where("water.seed"), folder + "/case.yaml:7");
  std::filesystem::remove_all(folder);

  const Case text = parse_case(minimal, "c.yaml");
  EXPECT_EQ(text.folder(), ".");
  EXPECT_EQ(text.resolve("dem.tif"), "dem.tif");
}

TEST(Case, IsReadFromStdin) {
  std::istringstream text(minimal);
  std::streambuf* const before = std::cin.rdbuf(text.rdbuf());
  const Case c = read_case("-", {"water.level=700"});
  std::cin.rdbuf(before);
  EXPECT_EQ(c.name, "canyon");
  EXPECT_EQ(c.path, "-");
  EXPECT_EQ(c.folder(), ".");
  EXPECT_EQ(c.where("water.seed"), "stdin:7");

  std::istringstream endless(std::string(3 << 20, 'x'));
  std::cin.rdbuf(endless.rdbuf());
  try {
    read_case("-");
    ADD_FAILURE() << "no error";
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(),
                 "stdin:1: more than 1 MiB of text (a case is a page or two) put outlines into a vector file");
  }
  std::cin.rdbuf(before);
  std::cin.clear();
}

TEST(CaseWarnings, NameWhatIsRarelyMeant) {
  const auto warnings = [](const std::string& more) { return case_warnings(parse_case(minimal + more, "c.yaml")); };
  using Lines = std::vector<std::string>;
  EXPECT_EQ(warnings("soil: {friction_angle: 25}\n"),
            (Lines{"c.yaml:8: soil has no effect (there is no slide) add slide or leave soil out"}));
  EXPECT_EQ(
      warnings(slide + "soil: {cohesion: 20}\n"),
      (Lines{"c.yaml:11: soil.cohesion is 20 Pa (little for particles of 12 m; it looks like kPa) write 20000 if it "
             "is"}));
  EXPECT_EQ(warnings("interface: {repulsion: false}\n"),
            (Lines{"c.yaml:8: interface has no effect (it needs both water and slide) leave interface out"}));
  EXPECT_EQ(warnings("numerics: {kernel: cubic}\n"),
            (Lines{"c.yaml:8: the cubic kernel pairs particles at h/dp 1.5 (the pressure becomes noisy) set "
                   "numerics.h_over_dp: 1.2"}));
  EXPECT_EQ(
      warnings("gauges: [{name: G1, x: 0, y: 0}, {name: G2, x: 6, y: 8}, {name: G3, x: 6, y: 30}]\n"),
      (Lines{"c.yaml:8: gauge G2 is less than a particle from G1 (they measure the same column) move one of them"}));
  EXPECT_EQ(warnings("output: {map_spacing: 3, arrival_threshold: 0.1}\n").size(), 2u);
  EXPECT_TRUE(warnings(slide + "soil: {cohesion: 20000}\ninterface: {repulsion: false}\n").empty());
}

TEST(DottedKey, NearestWord) {
  EXPECT_EQ(nearest_word("fricton", {"density", "friction", "cohesion"}), "friction");
  EXPECT_EQ(nearest_word("kitten", {"mitte", "sitting"}), "mitte") << "distances 2 and 3";
  EXPECT_EQ(nearest_word("", {"abc", "ab"}), "ab");
  EXPECT_EQ(nearest_word("x", {}), "");
}

}  // namespace
}  // namespace lgiw
