// The CUDA backend against the CPU, where a device is at hand; and its absence, where none is.
#include <gtest/gtest.h>

#include <cstdio>

#include "backend_comparison.hh"
#include "base/error.hh"

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

void compare(int dimension, NumberType type, double tolerance) {
  std::string why;
  if (!cuda_available(&why)) {
    std::printf("NOT TESTED: CUDA backend (%s)\n", why.c_str());
    GTEST_SKIP() << "no CUDA device: " << why;
  }
  for (const Scene& scene : scenes(dimension))
    expect_the_same_as_the_cpu(scene, type, make_cuda_simulation(scene.cloud.p, scene.cloud.in, type), tolerance);
}
TEST(Cuda, EqualsCpuInDouble2D) { compare(2, NumberType::double_, 1e-9); }
TEST(Cuda, EqualsCpuInDouble3D) { compare(3, NumberType::double_, 1e-9); }
TEST(Cuda, EqualsCpuInMixed2D) { compare(2, NumberType::mixed, 1e-3); }
TEST(Cuda, EqualsCpuInMixed3D) { compare(3, NumberType::mixed, 1e-3); }
TEST(Cuda, EqualsCpuInSingle2D) { compare(2, NumberType::single_, 1e-3); }
TEST(Cuda, EqualsCpuInSingle3D) { compare(3, NumberType::single_, 1e-3); }

}  // namespace
}  // namespace lgiw::test
