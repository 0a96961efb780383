// Malformed cases, DEMs and HDF5 files: each is refused with one line that names the fault, exit status 2, and nothing
// is written. A fault is one change to an input that is otherwise sound; that the sound one passes is tested first.
#include <cmath>
#include <limits>
#include <regex>

#include "bowl.hh"
#include "files/h5.hh"
#include "tool_runner.hh"

namespace lgiw::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// The sound inputs: case.yaml and dem.asc, and particles.h5 and run.h5 made from them, once.
void write_inputs(const Workshop& workshop) {
  write_bytes(workshop / "case.yaml", bowl_case);
  write_bytes(workshop / "dem.asc", ascii_grid());
}

void write_results(const Workshop& workshop) {
  static const std::map<std::string, std::string> results = [] {
    const Workshop factory;
    write_inputs(factory);
    for (const std::string command :
         {"dem2particles case.yaml -o particles.h5 -q", "lgiw-run particles.h5 -o run.h5 -q --backend cpu"})
      expect_quiet_success(factory.run(command), command);
    return factory.contents();
  }();
  for (const auto& [name, bytes] : results) write_bytes(workshop / name, bytes);
}

struct Fault {
  std::string name;
  std::function<void(const Workshop&)> make;
  std::string command;
  std::string expected;  // in the message
};

void PrintTo(const Fault& fault, std::ostream* out) { *out << fault.name; }

const std::string seeding = "dem2particles case.yaml -o particles-new.h5";
const std::string running = "lgiw-run particles.h5 -o run-new.h5 --backend cpu";
const std::string gauging = "gauges run.h5 -o new.csv --peaks new-peaks.csv --maps maps --summary new.json";
const std::string measuring = "deposit-volume run.h5 -o new.csv --thickness new.tif --profiles new-profiles.csv";

/// A case with `from` replaced by `to`.
Fault in_case(const std::string& name, const std::string& from, const std::string& to, const std::string& expected) {
  return {name, [=](const Workshop& w) { write_bytes(w / "case.yaml", replaced(bowl_case, from, to)); }, seeding,
          expected};
}

Fault in_file(const std::string& name, const std::string& file, const std::string& bytes, const std::string& command,
              const std::string& expected) {
  return {name, [=](const Workshop& w) { write_bytes(w / file, bytes); }, command, expected};
}

Fault truncated(const std::string& name, const std::string& file, double part, const std::string& command,
                const std::string& expected) {
  return {name,
          [=](const Workshop& w) {
            const std::string bytes = read_bytes(w / file);
            write_bytes(w / file, bytes.substr(0, std::size_t(part * double(bytes.size()))));
          },
          command, expected};
}

Fault in_h5(const std::string& name, const std::string& file, const std::function<void(h5::File&)>& damage,
            const std::string& command, const std::string& expected) {
  return {name,
          [=](const Workshop& w) {
            h5::File h5 = h5::File::open_write((w / file).string());
            damage(h5);
            h5.close();
          },
          command, expected};
}

/// A case whose terrain is one made for the fault.
Fault in_dem(const std::string& name, const std::string& grid, const std::string& expected) {
  return in_file(name, "dem.asc", grid, seeding, expected);
}

std::vector<Fault> case_faults() {
  return {
      {"case_missing", [](const Workshop& w) { fs::remove(w / "case.yaml"); }, seeding, "case.yaml does not exist"},
      {"case_is_a_folder",
       [](const Workshop& w) { fs::remove(w / "case.yaml"), fs::create_directory(w / "case.yaml"); }, seeding,
       "case.yaml is a folder"},
      in_file("case_empty", "case.yaml", "", seeding, "case.yaml"),
      in_file("case_binary", "case.yaml", std::string("\x89HDF\r\n\x1a\n\0\0\1", 11), seeding, "case.yaml"),
      in_case("yaml_syntax", "[500000, 3700000]", "[500000, 3700000", "case.yaml:"),
      in_case("unknown_key", "friction_angle", "friction_angel", "friction_angle"),
      in_case("duplicate_key", "  level: 110", "  level: 110\n  level: 120", "case.yaml:10: water.level"),
      in_case("friction_in_radians", "friction_angle: 20", "friction_angle: 0.5", "case.yaml:15: soil.friction_angle"),
      in_case("density_in_tonnes", "density: 2000", "density: 1.9", "case.yaml:16: soil.density"),
      in_case("no_spacing", "particle_spacing: 20\n", "", "particle_spacing"),
      in_case("negative_spacing", "particle_spacing: 20", "particle_spacing: -20", "case.yaml:2: particle_spacing"),
      in_case("spacing_of_millimetres", "particle_spacing: 20", "particle_spacing: 0.001", "particle_spacing"),
      in_case("nan_level", "level: 110", "level: .nan", "case.yaml:9: water.level"),
      in_case("word_for_a_number", "level: 110", "level: high", "case.yaml:9: water.level"),
      in_case("level_above_the_dem", "level: 110", "level: 500", "case.yaml:9"),
      in_case("level_below_the_dem", "level: 110", "level: 50", "case.yaml"),
      in_case("seed_on_dry_land", "seed: [500000, 3700000]", "seed: [500250, 3700200]", "case.yaml:10"),
      in_case("seed_outside", "seed: [500000, 3700000]", "seed: [600000, 3700000]", "case.yaml:10: water.seed"),
      in_case("slide_outside", "[500180, 3699940]", "[510180, 3699940]", "case.yaml:12: slide.polygon"),
      in_case("slide_crosses_itself", "[500180, 3699940], [500260, 3699940]", "[500260, 3699940], [500180, 3699940]",
              "case.yaml:12: slide.polygon"),
      in_case("two_failure_surfaces", "depth: 30", "depth: 30\n  base_elevation: 100",
              "slide has two failure surfaces"),
      in_case("failure_surface_above_the_ground", "depth: 30", "base_elevation: 400",
              "the failure surface lies above the ground"),
      in_case("window_upside_down", "[499720, 3699720, 500280, 3700280]", "[500280, 3700280, 499720, 3699720]",
              "case.yaml:7: terrain.window"),
      in_case("geographic_crs", "EPSG:32611", "EPSG:4326", "case.yaml:4: terrain.crs"),
      in_case("nonsense_crs", "EPSG:32611", "EPSG:999999", "EPSG:999999"),
      in_case("gauge_outside", "x: 500000, y: 3700000", "x: 0, y: 0", "gauge G1"),
  };
}

std::vector<Fault> dem_faults() {
  const auto bowl_with = [](const std::function<bool(double, double)>& where, double z) {
    return ascii_grid([=](double dx, double dy) { return where(dx, dy) ? z : bowl_height(dx, dy); });
  };
  // Cut GeoTIFFs under the demo's case, whose file this is.
  const fs::path demo = fs::path(LGIW_SOURCE_DIR) / "pipelines/demo";
  const std::string file = "terrain/big_tujunga_srtm30_utm11.tif", bytes = read_bytes(demo / file);
  const auto geotiff_of = [=](const std::string& name, std::size_t size) {
    return Fault{name,
                 [=](const Workshop& w) {
                   fs::create_directory(w / "terrain");
                   write_bytes(w / file, bytes.substr(0, size));
                   write_bytes(w / "case.yaml", read_bytes(demo / "case.yaml"));
                 },
                 seeding, file};
  };
  return {
      {"dem_missing", [](const Workshop& w) { fs::remove(w / "dem.asc"); }, seeding, "dem.asc"},
      in_dem("dem_empty", "", "dem.asc"),
      in_dem("dem_is_prose", "Once upon a time there was a valley.\n", "dem.asc"),
      in_dem("dem_with_a_void",
             bowl_with([](double dx, double dy) { return std::abs(dx) < 15 && std::abs(dy) < 15; }, nan), "void"),
      in_dem("dem_all_void", ascii_grid([](double, double) { return nan; }), "no elevations at all"),
      in_dem("dem_of_absurd_heights", ascii_grid([](double dx, double dy) { return 1e30 * bowl_height(dx, dy); }),
             "dem.asc"),
      in_dem("dem_short_of_rows", ascii_grid().substr(0, 3000), "dem.asc"),
      in_dem("dem_of_huge_dimensions",
             replaced(replaced(ascii_grid(), "ncols 30", "ncols 2000000000"), "nrows 30", "nrows 2000000000"),
             "dem.asc"),
      in_dem("dem_elsewhere", replaced(ascii_grid(), "xllcorner 499700", "xllcorner 699700"), "terrain.window"),
      {"dem_without_crs",
       [](const Workshop& w) { write_bytes(w / "case.yaml", replaced(bowl_case, "  crs: EPSG:32611\n", "")); }, seeding,
       "CRS"},
      {"dem_in_degrees",
       [](const Workshop& w) {
         write_bytes(w / "dem.prj", R"(GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],)"
                                    R"(PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]])");
         write_bytes(w / "case.yaml", replaced(bowl_case, "  crs: EPSG:32611\n", ""));
       },
       seeding, "degrees"},
      geotiff_of("geotiff_truncated", bytes.size() / 2),
      geotiff_of("geotiff_header_only", 16),
      {"geotiff_in_another_place",
       [=](const Workshop& w) {
         write_bytes(w / "dem.tif", bytes);
         write_bytes(w / "case.yaml", replaced(bowl_case, "dem.asc", "dem.tif"));
       },
       seeding, "terrain.window"},
  };
}

std::vector<Fault> particle_faults() {
  const auto particles = [](const std::string& name, const std::function<void(h5::File&)>& damage,
                            const std::string& expected) {
    return in_h5(name, "particles.h5", damage, running, expected);
  };
  const auto point = [](double value) {
    return [value](h5::File& file) { file.write_slab("/VTKHDF/Points", &value, {5, 0}, {1, 1}); };
  };
  return {
      {"particles_missing", [](const Workshop& w) { fs::remove(w / "particles.h5"); }, running, "particles.h5"},
      in_file("particles_empty", "particles.h5", "", running, "particles.h5"),
      in_file("particles_not_hdf5", "particles.h5", bowl_case, running, "particles.h5"),
      truncated("particles_truncated", "particles.h5", 0.6, running, "particles.h5"),
      truncated("particles_cut_in_the_superblock", "particles.h5", 0.0005, running, "particles.h5"),
      particles("particles_nan_position", point(nan), "particles.h5"),
      particles("particles_far_away", point(1e12), "particles.h5"),
      particles(
          "particles_of_a_foreign_format",
          [](h5::File& file) { file.set_attribute("/lgiw", "Format", std::string("lgiw-particles 99")); },
          "lgiw-particles 99"),
      particles(
          "particles_of_huge_count",
          [](h5::File& file) {
            file.set_attribute("/lgiw", "Counts", std::vector<int64_t>{4000000000000000000, 1, 1});
          },
          "particles.h5"),
      particles(
          "particles_negative_spacing", [](h5::File& file) { file.set_attribute("/lgiw", "ParticleSpacing", -20.0); },
          "particles.h5"),
      particles(
          "particles_nan_density",
          [](h5::File& file) {
            const float value = std::numeric_limits<float>::quiet_NaN();
            file.write_slab("/VTKHDF/PointData/Density", &value, {3}, {1});
          },
          "particles.h5"),
      particles(
          "particles_case_damaged",
          [](h5::File& file) { file.set_attribute("/lgiw", "Case", std::string("name: [bowl")); }, "particles.h5"),
      {"run_for_particles",
       [](const Workshop& w) { fs::copy_file(w / "run.h5", w / "particles.h5", fs::copy_options::overwrite_existing); },
       running, "particles.h5"},
      {"output_exists", [](const Workshop&) {}, "lgiw-run particles.h5 -o run.h5", "run.h5 exists"},
      {"output_folder_missing", [](const Workshop&) {}, "lgiw-run particles.h5 -o nowhere/run.h5", "nowhere"},
      {"override_of_an_unknown_key", [](const Workshop&) {}, running + " --set soil.frction=20", "soil.frction"},
      {"override_of_the_geometry", [](const Workshop&) {}, running + " --set slide.depth=3",
       "slide is not what the particles were made with"},
  };
}

std::vector<Fault> run_faults() {
  return {
      truncated("gauges_run_truncated", "run.h5", 0.6, gauging, "run.h5"),
      truncated("deposit_run_truncated", "run.h5", 0.6, measuring, "run.h5"),
      in_file("gauges_run_not_hdf5", "run.h5", bowl_case, gauging, "run.h5"),
      in_file("deposit_run_empty", "run.h5", "", measuring, "run.h5"),
      {"particles_for_gauges", [](const Workshop&) {}, "gauges particles.h5 -o new.csv", "particles.h5"},
      {"particles_for_deposit", [](const Workshop&) {}, "deposit-volume particles.h5 -o new.csv", "particles.h5"},
      {"gauge_off_the_map", [](const Workshop&) {}, "gauges run.h5 --gauge P,0,0 -o new.csv", "gauge P"},
      {"gauge_without_a_place", [](const Workshop&) {}, "gauges run.h5 --gauge P -o new.csv", "--gauge P"},
      {"profile_after_the_end", [](const Workshop&) {}, measuring + " --at first,1000", "1000 s"},
      {"case_for_gauges_is_another",
       [](const Workshop& w) {
         write_bytes(w / "case.yaml", replaced(bowl_case, "x: 500000, y: 3700000", "x: 500275, y: 3799999"));
       },
       "gauges run.h5 --case case.yaml -o new.csv", "gauge G1"},
      in_h5(
          "gauges_run_of_a_foreign_format", "run.h5",
          [](h5::File& file) { file.set_attribute("/lgiw", "Format", std::string("lgiw-run 99")); }, gauging,
          "lgiw-run 99"),
  };
}

class MalformedInput : public testing::TestWithParam<Fault> {};

TEST_P(MalformedInput, IsRefusedInOneLineAndNothingIsWritten) {
  const Fault& fault = GetParam();
  const Workshop workshop;
  write_inputs(workshop);
  if (fault.command.rfind("dem2particles", 0) != 0) write_results(workshop);
  fault.make(workshop);
  const auto before = workshop.contents();

  const Outcome outcome = workshop.run(fault.command);

  EXPECT_EQ(outcome.status, 2) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  // tool: PROBLEM (WHY IT IS ONE) SUGGESTION
  const std::string tool = fault.command.substr(0, fault.command.find(' '));
  EXPECT_TRUE(std::regex_match(outcome.err, std::regex(tool + ": [^\n]+ \\([^\n]+\\) [^\n]+\n"))) << outcome.err;
  EXPECT_NE(outcome.err.find(fault.expected), std::string::npos) << outcome.err;
  const auto after = workshop.contents();
  for (const auto& [name, bytes] : after) {
    EXPECT_TRUE(before.count(name)) << name << " was written";
    if (before.count(name)) {
      EXPECT_TRUE(before.at(name) == bytes) << name << " was changed";
    }
  }
  EXPECT_EQ(before.size(), after.size());
}

std::string name_of(const testing::TestParamInfo<Fault>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(Case, MalformedInput, testing::ValuesIn(case_faults()), name_of);
INSTANTIATE_TEST_SUITE_P(Dem, MalformedInput, testing::ValuesIn(dem_faults()), name_of);
INSTANTIATE_TEST_SUITE_P(Particles, MalformedInput, testing::ValuesIn(particle_faults()), name_of);
INSTANTIATE_TEST_SUITE_P(Run, MalformedInput, testing::ValuesIn(run_faults()), name_of);

}  // namespace
}  // namespace lgiw::test
