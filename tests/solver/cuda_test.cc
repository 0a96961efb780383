// The CUDA backend against the CPU, where a device is at hand; and its absence, where none is.
#include <gtest/gtest.h>

#include <cstdio>

#include "base/error.hh"
#include "cloud.hh"

namespace lgiw::test {
namespace {

TEST(Cuda, AbsenceIsReportedNotFatal) {
  std::string why;
  if (cuda_available(&why)) GTEST_SKIP() << "a CUDA device is at hand";
  EXPECT_FALSE(why.empty());
  const Cloud c = cloud({});
  try {
    make_cuda_simulation(c.p, c.in, NumberType::mixed);
    FAIL() << "made a simulation without a device";
  } catch (const BackendError& e) {
    const std::string message = e.what();
    EXPECT_NE(message.find("--backend cuda is not possible ("), std::string::npos) << message;
    EXPECT_NE(message.find("--backend cpu"), std::string::npos) << message;
  }
}

/// The two add the same terms in another order: after 50 steps of a violently moving cloud positions differ by rounding
/// that has grown, 1e-9 dp in double and 1e-3 dp in single precision at most.
void compare(const CloudOptions& o, NumberType type, double tolerance) {
  std::string why;
  if (!cuda_available(&why)) {
    std::printf("NOT TESTED: CUDA backend (%s)\n", why.c_str());
    GTEST_SKIP() << "no CUDA device: " << why;
  }
  const Cloud c = cloud(o);
  const auto cpu = make_cpu_simulation(c.p, c.in, type), cuda = make_cuda_simulation(c.p, c.in, type);
  ParticleState a, b;
  const StepState sa = cpu->advance(1e9, 50), sb = cuda->advance(1e9, 50);
  EXPECT_EQ(sa.step, sb.step);
  EXPECT_NEAR(sa.time, sb.time, 1e-6 * sa.time);
  cpu->download(a), cuda->download(b);
  for (std::size_t i = 0; i < a.water_x.size(); ++i)
    ASSERT_NEAR(a.water_x[i], b.water_x[i], tolerance * c.p.dp) << "water " << i / 3;
  for (std::size_t i = 0; i < a.soil_x.size(); ++i)
    ASSERT_NEAR(a.soil_x[i], b.soil_x[i], tolerance * c.p.dp) << "soil " << i / 3;
  for (std::size_t i = 0; i < a.soil_stress.size(); ++i)
    ASSERT_NEAR(a.soil_stress[i], b.soil_stress[i], 20 + 1e5 * tolerance);
}
TEST(Cuda, EqualsCpuInDouble2D) { compare({2}, NumberType::double_, 1e-9); }
TEST(Cuda, EqualsCpuInDouble3D) { compare({3}, NumberType::double_, 1e-9); }
TEST(Cuda, EqualsCpuInMixed2D) { compare({2}, NumberType::mixed, 1e-3); }
TEST(Cuda, EqualsCpuInMixed3D) { compare({3}, NumberType::mixed, 1e-3); }
TEST(Cuda, EqualsCpuInSingle3D) { compare({3}, NumberType::single_, 1e-3); }
TEST(Cuda, EqualsCpuWithThePapersChoices) {
  CloudOptions paper{2, true, true, true};
  compare(paper, NumberType::double_, 1e-9);
}

}  // namespace
}  // namespace lgiw::test
