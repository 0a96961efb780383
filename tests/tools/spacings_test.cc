// make with several spacings: one table of all runs, beside what was measured.
#include <regex>

#include "tool_runner.hh"

namespace lgiw::test {
namespace {

// A wedge of soil that slides into half a metre of water.
const std::string flume = R"(name: flume
dimension: 2
particle_spacing: 0.02
terrain: {profile: [[-0.3, 0.3], [0, 0], [0.5, 0]]}
water: {level: 0.15}
slide: {bodies: [[[-0.15, 0.15], [-0.15, 0.25], [-0.25, 0.25]]]}
soil: {young_modulus: 1e6}
output: {end_time: 0.2, frame_interval: 0.05}
gauges: [{name: near, x: 0.2}, {name: far, x: 0.4}]
)";

TEST(Spacings, SetBesideWhatWasMeasuredBetweenTwoBoundsOrBeyondOne) {
  const Workshop shop;
  fs::create_directory(shop / "flume");
  write_bytes(shop / "flume/case.yaml", flume);
  write_bytes(shop / "flume/reference.csv",
              "# A comment\nname,quantity,published,low,high\nnear,max_height_m,0.0214,0.0158,\n"
              "far,max_height_m,,,0.00125\nslide,slide_volume_m3,41.6e6,38.14e6,63.6e6\n"
              "slide,immersed_volume_m3,0.001,0.002,0.002\n");
  const Outcome outcome = shop.run(
      "env -u MAKEFLAGS -u MAKELEVEL make -C '" LGIW_SOURCE_DIR "/pipelines' BIN='" LGIW_BIN_DIR "' CASE_DIR='" +
      (shop / "flume").string() + "' OUT='" + (shop / "out").string() + "' DP='0.02 0.03' RUN_FLAGS='--threads 1'");
  ASSERT_EQ(outcome.status, 0) << outcome.err << outcome.out;
  const std::string table = read_bytes(shop / "out/spacings.txt");
  const auto line = [&](const std::string& pattern) { return std::regex_search(table, std::regex(pattern)); };
  EXPECT_TRUE(line("dp 0.03 m +dp 0.02 m +error +by +published +measured\n")) << table;
  EXPECT_TRUE(line("near +max height .* 0.0214 +> 0.0158\n")) << table;
  EXPECT_TRUE(line("far +max height .* - +< 0.00125\n")) << table;
  EXPECT_TRUE(line("slide +slide volume .* 41.6e6 +38.1e6 to 63.6e6\n")) << table;
  EXPECT_TRUE(line("slide +immersed volume .* 0.001 +0.002\n")) << table;
  EXPECT_TRUE(line("near +time of max .* - +-\n")) << table;
  for (const char* figure : {"by-spacing-gauges.png", "by-spacing-heights.png", "by-spacing-slide.png"})
    EXPECT_EQ(read_bytes(shop / (std::string("out/") + figure)).compare(1, 3, "PNG"), 0) << figure;
}

}  // namespace
}  // namespace lgiw::test
