// When outputs are due and how much they take.
#include "solver/output_plan.hh"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <random>

#include "../files/small_run.hh"
#include "../files/support.hh"

namespace lgiw {
namespace {

TEST(OutputPlan, FramesFallOnEveryFewSurfacesAndOnTheEnd) {
  Case c;
  c.output.frame_interval = 0.5, c.output.end_time = 2.1, c.output.surface_interval = 0.12;
  const OutputSchedule s = output_schedule(c, 0.1);
  EXPECT_EQ(s.per_frame, 4);  // the nearest number of surfaces a frame
  EXPECT_EQ(s.interval, 0.125);
  EXPECT_EQ(s.last, 17);  // 16 are at 2.0 s
  int64_t frames = 0;
  for (int64_t k = 0; k <= s.last; ++k) frames += s.with_frame(k);
  EXPECT_EQ(frames, 6);  // 0, 0.5, 1, 1.5, 2 and 2.1 s
  EXPECT_EQ(s.frames(), frames);

  c.output.end_time = 2;
  EXPECT_EQ(output_schedule(c, 0.1).frames(), 5);
  c.output.surface_interval = 0;  // 0.3 sqrt(dp / g): 0.0303 s, 17 a frame
  EXPECT_EQ(output_schedule(c, 0.1).per_frame, 17);
  c.output.frame_interval = 0.01;  // shorter than that
  EXPECT_EQ(output_schedule(c, 0.1).interval, 0.01);
}

/// Numbers that cannot be deflated.
std::vector<float> noise(std::size_t n) {
  static std::mt19937 random(7);
  std::vector<float> values(n);
  for (float& v : values) v = std::ldexp(float(random()), -int(random() % 60));
  return values;
}

TEST(OutputPlan, AFileTakesNearlyWhatIsToldWhenItsSurfacesCannotBeDeflated) {
  const Scratch scratch;
  const std::string path = scratch / "r.h5";
  RunHeader header = small_run();
  header.particles.counts = {40000, 9000, 5, 0};
  header.initial_soil = noise(3 * 9000);
  header.map = {200, 300, 1, 0, 0};
  header.pressure_gauges.clear();
  RunWriter writer(path, header);
  for (int k = 0; k < 9; ++k) {
    if (k % 2 == 0)
      writer.add_frame(
          {double(k), noise(3 * 49000), noise(3 * 49000), noise(49000), noise(49000), std::vector<uint8_t>(49000)});
    writer.add_surface(k, noise(60000), noise(60000), {});
    writer.add_diagnostics(k, {{"mass", 5.0}});
  }
  writer.close();
  const double told = run_file_bytes(header.particles.counts, header.map, 5, 9);
  EXPECT_LT(std::filesystem::file_size(path), told);
  EXPECT_GT(std::filesystem::file_size(path), 0.8 * told);
}

TEST(OutputPlan, WarnsWhereTheDiskIsTooSmall) {
  const OutputSize size{2.5e9, 3e8};
  EXPECT_EQ(space_warning(size, 2.8e9, "/data"), "");
  EXPECT_EQ(space_warning(size, 2.7e9, "/data"),
            "the run file takes up to 2.5 GB, its checkpoints 300 MB while it runs, and /data has 2.7 GB for it: make "
            "room, or raise output.frame_interval");
}

}  // namespace
}  // namespace lgiw
