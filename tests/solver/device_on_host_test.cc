// The passes as a CUDA device runs them (rows of cells, memory of its own, steps queued beyond the target, threads in
// no order), against the CPU backend, on any machine.
#include "device_on_host.hh"

#include <gtest/gtest.h>

#include <tuple>

#include "backend_comparison.hh"
#include "solver/particle_simulation.hh"

namespace lgiw::test {
namespace {

template <class P, class T, int D, template <class, int> class Kernel = Wendland>
std::unique_ptr<Simulation> make_of(const Cloud& c, NumberType type, unsigned seed) {
  return std::make_unique<ParticleSimulation<DeviceOnHost, Traits<P, T, D, Kernel, CudaDevice>>>(c.p, c.in, type,
                                                                                                 DeviceOnHost(seed));
}
/// What the scenes need of a backend, which has more.
std::unique_ptr<Simulation> on_device(const Cloud& c, NumberType type = NumberType::double_, unsigned seed = 1) {
  const bool plane = c.p.dimension == 2, cubic = c.p.cubic_kernel;
  if (plane && type == NumberType::double_)
    return cubic ? make_of<double, double, 2, CubicSpline>(c, type, seed) : make_of<double, double, 2>(c, type, seed);
  if (plane || cubic) throw std::runtime_error("not compiled for this test");
  if (type == NumberType::mixed) return make_of<double, float, 3>(c, type, seed);
  if (type == NumberType::single_) return make_of<float, float, 3>(c, type, seed);
  return make_of<double, double, 3>(c, type, seed);
}

/// Everything that a later step depends on.
bool same(const Simulation& a, const Simulation& b) {
  const auto all = a.save(), others = b.save();
  if (all.size() != others.size()) return false;
  for (std::size_t k = 1; k < all.size(); ++k)  // the state, which has gaps between its members, by what it says
    if (all[k].name != others[k].name || all[k].bytes != others[k].bytes) {
      ADD_FAILURE() << all[k].name;
      return false;
    }
  const StepState s = a.state(), t = b.state();
  return s.time == t.time && s.dt == t.dt && s.dt_previous == t.dt_previous && s.step == t.step &&
         s.failed_water == t.failed_water && s.failed_soil == t.failed_soil && s.lost_water == t.lost_water &&
         s.lost_soil == t.lost_soil && s.euler_countdown == t.euler_countdown;
}

TEST(DeviceOnHost, HidesItsMemoryFromTheHost) {
  DeviceOnHost device;
  const DeviceOnHost::Array<double> array(3);
  double values[3] = {1, 2, 3};
  device.upload(array, values);
  EXPECT_DEATH(std::fprintf(stderr, "%g", array.data()[0]), "");
}
void compare(int dimension, NumberType type, double tolerance) {
  for (const Scene& scene : scenes(dimension))
    expect_the_same_as_the_cpu(scene, type, on_device(scene.cloud, type), tolerance);
}
TEST(DeviceOnHost, EqualsCpuInDouble2D) { compare(2, NumberType::double_, 1e-9); }
TEST(DeviceOnHost, EqualsCpuInDouble3D) { compare(3, NumberType::double_, 1e-9); }
TEST(DeviceOnHost, EqualsCpuInMixed3D) { compare(3, NumberType::mixed, 1e-4); }
TEST(DeviceOnHost, EqualsCpuInSingle3D) { compare(3, NumberType::single_, 1e-4); }

TEST(DeviceOnHost, EqualsCpuInOtherCells) {
  const double low[3] = {0, 0, 0}, high[3] = {40, 40, 40};
  const auto cells = [&](double particles) {
    const auto grid = Grid<double, 3>::of_device(low, high, 0.5, particles);
    return std::pair(grid.edge, grid.split);
  };
  EXPECT_EQ(cells(1e3), std::pair(1, 1)) << "500 cells a particle";
  EXPECT_EQ(cells(4e4), std::pair(2, 1));
  EXPECT_EQ(cells(1e5), std::pair(2, 2));
  for (auto which : {DeviceOnHost::Cells::even, DeviceOnHost::Cells::wide}) {
    DeviceOnHost::cells() = which;
    compare(2, NumberType::double_, 1e-9), compare(3, NumberType::double_, 1e-9);
  }
  DeviceOnHost::cells() = DeviceOnHost::Cells::usual;
}

/// What a scene of twice the particles in the same cells holds more: what 200 M particles need of 80 GB.
TEST(DeviceOnHost, APlaceInMemoryIsSmall) {
  const Cloud once = cloud({3});
  Cloud twice = once;
  InitialParticles& p = twice.in;
  const auto repeat = [](auto& values) {
    const auto copy = values;
    values.insert(values.end(), copy.begin(), copy.end());
  };
  repeat(p.water_x), repeat(p.water_v), repeat(p.water_excess);
  repeat(p.soil_x), repeat(p.soil_v), repeat(p.soil_stress);
  const PhaseBytes a = on_device(once, NumberType::mixed)->bytes(), b = on_device(twice, NumberType::mixed)->bytes();
  const double water = double(b.water - a.water) / double(once.in.n_water()),
               soil = double(b.soil - a.soil) / double(once.in.n_soil());
  std::printf("measured: on a device, mixed precision, %g bytes a particle of water, %g of soil\n", water, soil);
  EXPECT_LE(water, 100);
  EXPECT_LE(soil, 200);
}

/// Reads of what another thread of the same pass writes would show.
TEST(DeviceOnHost, ThreadsInAnyOrderDoTheSame) {
  for (int dimension : {2, 3})
    for (const Scene& scene : scenes(dimension)) {
      SCOPED_TRACE(scene.name);
      const auto a = on_device(scene.cloud, NumberType::double_, 1), b = on_device(scene.cloud, NumberType::double_, 2);
      a->advance(1e9, 20), b->advance(1e9, 20);
      EXPECT_TRUE(same(*a, *b)) << dimension;
    }
}

/// Threads that run side by side as those of a warp do, which compute what they have listed whenever another one is
/// full; and short lists.
struct Moody : CudaDevice {
  static constexpr int list = 5;
  static bool any_beside(bool mine) {
    static std::mt19937 others(7);
    return mine || others() % 3 == 0;
  }
};
/// A thread's sums do not depend on when the threads beside it make it compute.
TEST(DeviceOnHost, WhatOthersListChangesNothing) {
  for (int dimension : {2, 3})
    for (const Scene& scene : scenes(dimension)) {
      if (scene.cloud.p.cubic_kernel) continue;
      SCOPED_TRACE(scene.name);
      const Cloud& c = scene.cloud;
      const auto alone = on_device(c);
      std::unique_ptr<Simulation> beside;
      if (dimension == 2)
        beside = std::make_unique<ParticleSimulation<DeviceOnHost, Traits<double, double, 2, Wendland, Moody>>>(
            c.p, c.in, NumberType::double_);
      else
        beside = std::make_unique<ParticleSimulation<DeviceOnHost, Traits<double, double, 3, Wendland, Moody>>>(
            c.p, c.in, NumberType::double_);
      alone->advance(1e9, 10), beside->advance(1e9, 10);
      EXPECT_TRUE(same(*alone, *beside)) << dimension;
    }
}

/// The coming step, alone, becomes so short that far too many seem to be needed.
void shorten_step(Simulation& s) {
  std::vector<RawArray> arrays = s.save();
  StepState state = s.state();
  ASSERT_EQ(arrays[0].bytes.size(), sizeof state);
  state.dt *= 0.01;
  std::memcpy(arrays[0].bytes.data(), &state, sizeof state);
  s.restore(arrays);
}
/// Steps that were queued when the target was reached change nothing; single steps queue none.
TEST(DeviceOnHost, StepsBeyondTheTargetDoNothing) {
  for (int dimension : {2, 3})
    for (const Scene& scene : scenes(dimension)) {
      SCOPED_TRACE(scene.name);
      const auto queued = on_device(scene.cloud), single = on_device(scene.cloud);
      const double dt = queued->state().dt;
      int left_over = 0;
      for (double target : {3.5, 12.2, 30.2}) {
        shorten_step(*queued), shorten_step(*single);
        const int before = DeviceOnHost::sorts();
        queued->advance(target * dt, 1000);
        const int between = DeviceOnHost::sorts();
        while (single->state().time < target * dt) single->advance(target * dt, 1);
        left_over += (between - before) - (DeviceOnHost::sorts() - between);
        EXPECT_TRUE(same(*queued, *single)) << dimension << ", " << target;
      }
      EXPECT_GT(left_over, 3);
    }
}

/// The length of the coming steps is known well enough.
TEST(DeviceOnHost, NoMoreStepsAreQueuedThanAreNeeded) {
  const auto device = on_device(without_soil(cloud({})));
  const int before = DeviceOnHost::sorts();
  const double dt = device->state().dt;
  for (double target : {3.5, 23.5}) device->advance(target * dt, 1000);
  const int64_t steps = device->state().step;
  EXPECT_GE(steps, 24);
  EXPECT_LE(DeviceOnHost::sorts() - before, steps + 1);
}

TEST(DeviceOnHost, ARestoredStateGoesOnTheSame) {
  for (const Scene& scene : scenes(2)) {
    SCOPED_TRACE(scene.name);
    const auto whole = on_device(scene.cloud), other = on_device(scene.cloud);
    whole->advance(1e9, 7);
    const auto kept = whole->save();
    whole->advance(1e9, 13);
    other->advance(1e9, 3), other->restore(kept), other->advance(1e9, 13);
    EXPECT_TRUE(same(*whole, *other));
  }
}

/// An output is made while the solver steps on.
TEST(DeviceOnHost, ADownloadHoldsWhatWasThere) {
  for (int dimension : {2, 3})
    for (const Scene& scene : scenes(dimension)) {
      SCOPED_TRACE(scene.name);
      const Cloud& c = scene.cloud;
      for (bool device : {true, false}) {
        const auto simulation = device ? on_device(c) : make_cpu_simulation(c.p, c.in, NumberType::double_);
        simulation->advance(1e9, 3);
        ParticleState before, held, after;
        simulation->download(before);
        const auto bring = simulation->begin_download(held);
        simulation->advance(1e9, 3);
        bring();
        simulation->download(after);
        const auto fields = [](const ParticleState& s) {
          return std::tie(s.water_x, s.soil_x, s.water_v, s.soil_v, s.water_pressure, s.water_excess, s.soil_stress,
                          s.soil_adps, s.water_lost, s.soil_lost);
        };
        EXPECT_TRUE(fields(held) == fields(before)) << dimension;
        EXPECT_FALSE(fields(held) == fields(after)) << dimension;
      }
    }
}

/// A particle that fails stops what is queued, and is told by the smallest id of those that fail with it.
TEST(DeviceOnHost, AFailedParticleStopsTheQueue) {
  Cloud c = cloud({});
  for (std::size_t i : {40u, 9u}) c.in.water_v[3 * i] = 1e6f;
  const auto device = on_device(c), cpu = make_cpu_simulation(c.p, c.in, NumberType::double_);
  const StepState s = device->advance(1e9, 100), t = cpu->advance(1e9, 100);
  EXPECT_EQ(s.failed_water, 9u);
  EXPECT_EQ(s.failed_soil, UINT32_MAX);
  EXPECT_EQ(s.failed_water, t.failed_water);
  EXPECT_EQ(s.step, t.step);
}

}  // namespace
}  // namespace lgiw::test
