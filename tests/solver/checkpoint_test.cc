// Checkpoints: a run that is stopped, killed or damaged ends in the bytes of one that was not, or says why it cannot.
#include "solver/checkpoint.hh"

#include <cmath>
#include <memory>

#include "base/error.hh"
#include "files/h5.hh"
#include "gtest/gtest.h"
#include "run_scenes.hh"

namespace lgiw::test {
namespace {

Checkpoint example() {
  Checkpoint c;
  c.identity = "a run";
  c.outputs = 7, c.frames = 2, c.surfaces = 7, c.diagnostics = 7;
  c.wall_time = 12.5;
  c.extremes = {{"max_water_speed", 0.1}, {"last_below_bed", 3}};
  c.maxima = {{"elevation", {1.f, NAN, 2.5f}}, {"speed", {0.f, 0.25f, 4.f}}};
  c.initial_elevation = {0.5f, NAN, 0.5f};
  c.arrays = {{"state", {1, 2, 3, 4}}, {"water velocity", std::vector<unsigned char>(300, 77)}, {"soil empty", {}}};
  return c;
}

void expect_equal(const Checkpoint& a, const Checkpoint& b) {
  EXPECT_EQ(a.identity, b.identity);
  EXPECT_EQ(a.outputs, b.outputs);
  EXPECT_EQ(a.frames, b.frames);
  EXPECT_EQ(a.surfaces, b.surfaces);
  EXPECT_EQ(a.diagnostics, b.diagnostics);
  EXPECT_EQ(a.wall_time, b.wall_time);
  EXPECT_EQ(a.extremes, b.extremes);
  const auto bits = [](const std::vector<float>& v) {
    return std::string(reinterpret_cast<const char*>(v.data()), v.size() * sizeof(float));
  };
  ASSERT_EQ(a.maxima.size(), b.maxima.size());
  for (const auto& [name, raster] : a.maxima) EXPECT_EQ(bits(raster), bits(b.maxima.at(name))) << name;
  EXPECT_EQ(bits(a.initial_elevation), bits(b.initial_elevation));
  ASSERT_EQ(a.arrays.size(), b.arrays.size());
  for (std::size_t k = 0; k < a.arrays.size(); ++k) {
    EXPECT_EQ(a.arrays[k].name, b.arrays[k].name);
    EXPECT_EQ(a.arrays[k].bytes, b.arrays[k].bytes);
  }
}

TEST(Checkpoint, ReadsWhatWasWrittenAndKeepsOnePredecessor) {
  const Workshop shop;
  const std::string path = (shop / "c").string();
  Checkpoint c = example();
  write_checkpoint(path, c);
  EXPECT_FALSE(fs::exists(previous_checkpoint(path)));
  expect_equal(read_checkpoint(path, "a run"), c);
  c.outputs = 8;
  write_checkpoint(path, c);
  EXPECT_EQ(read_checkpoint(path, "a run").outputs, 8);
  EXPECT_EQ(read_checkpoint(previous_checkpoint(path), "a run").outputs, 7);
  c.outputs = 9;
  write_checkpoint(path, c);
  EXPECT_EQ(read_checkpoint(previous_checkpoint(path), "a run").outputs, 8);
  EXPECT_EQ(shop.contents().size(), 2u);  // no temporary file is left
}

TEST(Checkpoint, NoDamageIsTakenForAState) {
  const Workshop shop;
  const std::string path = (shop / "c").string();
  write_checkpoint(path, example());
  const std::string good = read_bytes(path);
  int refused = 0, tried = 0;
  const auto try_bytes = [&](const std::string& bytes) {
    write_bytes(path, bytes);
    ++tried;
    try {
      expect_equal(read_checkpoint(path, "a run"), example());  // a byte that means nothing
    } catch (const std::exception& e) {
      ++refused;
      EXPECT_NE(std::string(e.what()), "");
    }
  };
  for (std::size_t at = 0; at < good.size(); at += 7) {
    std::string bytes = good;
    bytes[at] = char(bytes[at] ^ (1 << at % 8));
    try_bytes(bytes);
  }
  EXPECT_GT(refused, 100) << "of " << tried;
  const int before = refused;
  for (std::size_t size = 0; size < good.size(); size += good.size() / 50) try_bytes(good.substr(0, size));
  EXPECT_GE(refused - before, 50);  // a file that lacks its end is never read
}

TEST(Checkpoint, TheNewestSoundOneIsTaken) {
  const Workshop shop;
  const std::string path = (shop / "c").string(), previous = previous_checkpoint(path);
  std::string note;
  try {
    read_newest_checkpoint(path, "a run", &note);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_EQ(std::string(e.what()), "there is nothing to resume (" + path + " does not exist) start the run anew");
  }
  Checkpoint c = example();
  write_checkpoint(path, c);
  c.outputs = 8;
  write_checkpoint(path, c);
  EXPECT_EQ(read_newest_checkpoint(path, "a run", &note).outputs, 8);
  EXPECT_EQ(note, "");

  // One bit of an array.
  std::string bytes = read_bytes(path);
  const std::size_t at = bytes.find(std::string(50, 77));
  ASSERT_NE(at, std::string::npos);
  bytes[at + 20] ^= 16;
  write_bytes(path, bytes);
  EXPECT_EQ(read_newest_checkpoint(path, "a run", &note).outputs, 7);
  EXPECT_EQ(note, "resuming from " + previous + ": " + path +
                      " is damaged (its checksum is wrong) it cannot be resumed from");
  write_bytes(previous, read_bytes(previous).substr(0, 900));
  try {
    read_newest_checkpoint(path, "a run", &note);
    FAIL();
  } catch (const InputError& e) {
    const std::string what = e.what();
    EXPECT_NE(what.find(path + " is damaged"), std::string::npos) << what;
    EXPECT_NE(what.find(previous), std::string::npos) << what;
  }

  // Killed between the two renames: only the predecessor is there.
  write_checkpoint(path, c);
  fs::rename(path, previous);
  note.clear();
  EXPECT_EQ(read_newest_checkpoint(path, "a run", &note).outputs, 8);
  EXPECT_EQ(note, "resuming from " + previous + ": " + path + " does not exist");
  EXPECT_THROW(read_newest_checkpoint(path, "another run", nullptr), InputError);
}

/// The tool: what differs between schemes is what a checkpoint must hold.
class Resume : public testing::TestWithParam<std::pair<const char*, const char*>> {
 protected:
  static void SetUpTestSuite() {
    shop = std::make_unique<Workshop>();
    // A plate at the far end moves as well.
    write_bytes(*shop / "slide_plate.csv", "t_s,dx_m,dz_m,pitch_deg\n0,0,0,0\n0.2,-0.1,0.01,8\n0.4,-0.25,0.02,2\n");
    make_particles(*shop, "slide",
                   slide_case +
                       "bodies: [{name: plate, outline: [[2.3, 0.1], [2.35, 0.1], [2.35, 0.6], [2.3, 0.6]], "
                       "motion: slide_plate.csv}]\n");
  }
  static void TearDownTestSuite() { shop.reset(); }
  void SetUp() override {
    for (const auto& [name, bytes] : shop->contents())
      if (name.compare(0, 5, "slide") != 0) fs::remove(*shop / name);
  }
  static std::string call(const std::string& output, const std::string& options) {
    return "lgiw-run slide.h5 -o " + output + " --backend cpu --no-provenance " + options;
  }
  /// The bytes of an uninterrupted run.
  static std::string whole(const std::string& options) {
    expect_quiet_success(shop->run(call("whole.h5", "-q -O " + options)), options);
    return read_bytes(*shop / "whole.h5");
  }
  static void expect_resumed(const std::string& options, const std::string& expected) {
    EXPECT_FALSE(fs::exists(*shop / "r.h5"));
    const Outcome resumed = shop->run(call("r.h5", "--resume " + options));
    EXPECT_EQ(resumed.status, 0) << resumed.err;
    EXPECT_NE(resumed.err.find("lgiw-run: resumed at "), std::string::npos) << resumed.err;
    EXPECT_TRUE(read_bytes(*shop / "r.h5") == expected) << "the resumed run differs";
    for (const char* name : {".r.partial.h5", "r.h5.checkpoint", "r.h5.checkpoint.previous"})
      EXPECT_FALSE(fs::exists(*shop / name)) << name;
  }
  static bool exists(const std::string& name) { return fs::exists(*shop / name); }
  /// Kills a run that has written two checkpoints. Their interval is `often`, a part of the case.
  static void kill_with_two_checkpoints(const std::string& options) {
    Background run(*shop, call("r.h5", "-q " + options));
    ASSERT_TRUE(run.reached([] { return exists("r.h5.checkpoint") && exists("r.h5.checkpoint.previous"); }))
        << run.err();
    run.send(SIGKILL);
    EXPECT_EQ(run.wait(), 128 + SIGKILL);
  }
  static inline const std::string often = "--set output.checkpoint_interval=0.05 ";

  static std::unique_ptr<Workshop> shop;
};
std::unique_ptr<Workshop> Resume::shop;

TEST_P(Resume, AfterTerminationIsTheSameRun) {
  const std::string options = GetParam().second, expected = whole(options);
  Background run(*shop, call("r.h5", "--progress " + options));
  ASSERT_TRUE(run.under_way()) << run.err();
  EXPECT_FALSE(exists("r.h5.checkpoint"));
  run.send(SIGTERM);
  EXPECT_EQ(run.wait(), 143);
  EXPECT_NE(run.err().find("stopped by signal 15; the state is in r.h5.checkpoint: go on with --resume"),
            std::string::npos)
      << run.err();
  EXPECT_TRUE(exists("r.h5.checkpoint"));
  expect_resumed(options, expected);
}

TEST_P(Resume, AfterAKillIsTheSameRun) {
  const std::string options = often + GetParam().second, expected = whole(options);
  kill_with_two_checkpoints(options);
  expect_resumed(options, expected);
}

INSTANTIATE_TEST_SUITE_P(
    Schemes, Resume,
    testing::Values(
        std::pair{"leapfrog_mixed", ""},
        std::pair{"verlet_mixed", "--set numerics.scheme=huang2023 --set output.end_time=0.2"},
        std::pair{"leapfrog_double", "--set numerics.precision=double"},
        std::pair{"verlet_single",
                  "--set numerics.scheme=huang2023 --set output.end_time=0.2 --set numerics.precision=single"},
        std::pair{"shifting", "--set numerics.shifting=2"},
        std::pair{"coulomb_artificial_stress",
                  "--set soil.bed=coulomb --set soil.bed_friction_angle=15 --set soil.artificial_stress=0.3"}),
    [](const auto& parameters) { return parameters.param.first; });

using ResumeOnce = Resume;

TEST_F(ResumeOnce, InterruptAndTwiceInterrupted) {
  const std::string expected = whole("");
  Background run(*shop, call("r.h5", "--progress"));
  ASSERT_TRUE(run.under_way()) << run.err();
  run.send(SIGINT);
  EXPECT_EQ(run.wait(), 130);
  Background again(*shop, call("r.h5", "--progress --resume --threads 1"));
  ASSERT_TRUE(again.under_way("60 %")) << again.err();
  again.send(SIGTERM);
  EXPECT_EQ(again.wait(), 143);
  expect_resumed("", expected);
}

TEST_F(ResumeOnce, WhileSettling) {
  const std::string options = "--set numerics.settle_time=0.1 --set output.end_time=0.1", expected = whole(options);
  Background run(*shop, call("r.h5", "--progress " + options));
  ASSERT_TRUE(run.under_way("settling")) << run.err();
  run.send(SIGTERM);
  EXPECT_EQ(run.wait(), 143);
  ASSERT_TRUE(exists("r.h5.checkpoint"));
  const Outcome dry = shop->run(call("r.h5", "--resume " + options));
  EXPECT_EQ(dry.status, 0);
  EXPECT_NE(dry.err.find("resumed at settling time 0."), std::string::npos) << dry.err;
  EXPECT_TRUE(read_bytes(*shop / "r.h5") == expected) << "the resumed run differs";
}

TEST_F(ResumeOnce, DamageFallsBackAndThenIsRefused) {
  const std::string expected = whole(often);
  kill_with_two_checkpoints(often);
  std::string bytes = read_bytes(*shop / "r.h5.checkpoint");
  bytes[bytes.size() / 2] ^= 1;
  write_bytes(*shop / "r.h5.checkpoint", bytes);
  fs::copy(*shop / "r.h5.checkpoint.previous", *shop / "kept");
  fs::copy(*shop / ".r.partial.h5", *shop / "kept.h5");
  {
    const Outcome resumed = shop->run(call("r.h5", "--resume " + often));
    EXPECT_EQ(resumed.status, 0) << resumed.err;
    EXPECT_NE(resumed.err.find("lgiw-run: resuming from r.h5.checkpoint.previous: "), std::string::npos) << resumed.err;
    EXPECT_TRUE(read_bytes(*shop / "r.h5") == expected) << "the resumed run differs";
  }
  fs::remove(*shop / "r.h5");
  fs::copy(*shop / "kept.h5", *shop / ".r.partial.h5");
  write_bytes(*shop / "r.h5.checkpoint", bytes.substr(0, bytes.size() / 2));
  write_bytes(*shop / "r.h5.checkpoint.previous", read_bytes(*shop / "kept").substr(0, 1000));
  const auto before = shop->contents();
  const Outcome refused = shop->run(call("r.h5", "--resume " + often));
  EXPECT_EQ(refused.status, 2);
  EXPECT_EQ(lines(refused.err), 1) << refused.err;
  EXPECT_NE(refused.err.find("lgiw-run: there is nothing to resume ("), std::string::npos) << refused.err;
  EXPECT_TRUE(shop->contents() == before) << "a refused resumption changed something";
}

TEST_F(ResumeOnce, AnotherCaseOrNoCheckpointIsRefused) {
  const Outcome none = shop->run(call("r.h5", "--resume"));
  EXPECT_EQ(none.status, 2);
  EXPECT_EQ(none.err, "lgiw-run: there is nothing to resume (r.h5.checkpoint does not exist) start the run anew\n");
  kill_with_two_checkpoints(often);
  const auto before = shop->contents();
  for (const std::string other : {"", "--set soil.friction_angle=30", "--set numerics.precision=double"}) {
    const Outcome refused = shop->run(call("r.h5", "--resume " + (other.empty() ? "" : often) + other));
    EXPECT_EQ(refused.status, 2) << other;
    EXPECT_EQ(lines(refused.err), 1) << refused.err;
    EXPECT_NE(
        refused.err.find("r.h5.checkpoint belongs to another run (particles, case, overrides or precision differ)"),
        std::string::npos)
        << refused.err;
  }
  // The unfinished run is not thrown away by a new one, unless that is said.
  const Outcome anew = shop->run(call("r.h5", often));
  EXPECT_EQ(anew.status, 2);
  EXPECT_EQ(anew.err,
            "lgiw-run: r.h5.checkpoint exists (it is the state of an unfinished run, which a new one would discard) go "
            "on with "
            "--resume, or start anew with -O\n");
  EXPECT_TRUE(shop->contents() == before);
  // The partial run is needed too.
  fs::remove(*shop / ".r.partial.h5");
  const Outcome lost = shop->run(call("r.h5", "-q --resume " + often));
  EXPECT_EQ(lost.status, 2);
  EXPECT_EQ(lines(lost.err), 1) << lost.err;
  EXPECT_NE(lost.err.find(".r.partial.h5"), std::string::npos) << lost.err;
}

}  // namespace
}  // namespace lgiw::test
