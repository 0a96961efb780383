// Moving particles side by side is moving them one by one.
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "solver/passes.hh"

namespace lgiw {
namespace {

/// Particles in a box with walls to the west and east up to half of its height, so fast that some leave it.
template <int D, bool is_water>
struct Flight {
  using Tr = Traits<double, float, D, Wendland, Cpu<LGIW_LANES>>;
  static constexpr int n = 1000, still_there = 970;
  std::vector<double> position[D];
  std::vector<float> v[D], a[D], v_previous[D], shift[D];
  std::vector<int> key = std::vector<int>(n, -1), start;
  std::vector<unsigned> id;
  StepState state;
  Motion<Tr, is_water> pass;

  explicit Flight(bool verlet, bool shifted = false) {
    ModelParameters p;
    p.dimension = D, p.dp = 0.1, p.h = 0.15, p.sound_speed = 40, p.soil_density = 2000, p.young_modulus = 1e6;
    p.low = {0, 0, 0}, p.high = {4, 2, 3}, p.side_top = {1.5, 1.5, -1e300, -1e300};
    p.verlet = verlet, p.settle_rate = 3, p.soil_settle_rate = 5, p.shifting = shifted ? 2 : 0;
    pass.parameters = Parameters<Tr>(p, is_water, !is_water);
    const double *low = pass.parameters.low, *high = pass.parameters.high;
    pass.grid = Grid<float, D>(low, high, 0.3);
    std::mt19937 random(3);
    const auto uniform = [&](double from, double to) {
      return std::uniform_real_distribution<double>(from, to)(random);
    };
    auto& view = const_cast<std::remove_const_t<std::remove_reference_t<decltype(pass.own())>>&>(pass.own());
    for (int k = 0; k < D; ++k) {
      for (int i = 0; i < n; ++i) {
        position[k].push_back(uniform(low[k], high[k]));
        for (auto* field : {&v[k], &a[k], &v_previous[k], &shift[k]}) field->push_back(float(uniform(-1, 1)));
      }
      view.position[k] = position[k].data(), view.v[k] = v[k].data(), view.a[k] = a[k].data();
      if (verlet) view.v_previous[k] = v_previous[k].data();
      if constexpr (is_water)
        if (shifted) view.shift[k] = shift[k].data();
    }
    for (int i = 0; i < n; ++i) id.push_back(unsigned(n - i));
    start.assign(std::size_t(pass.grid.cells) + 1, still_there);
    view.n = n, view.id = id.data(), view.key = key.data(), view.start = start.data();
    state.target = 1, state.dt = 0.07, state.dt_previous = 0.05, state.euler_countdown = 5;
    pass.state = &state;
    pass.lost = is_water ? &state.lost_water : &state.lost_soil;
    pass.failed = is_water ? &state.failed_water : &state.failed_soil;
  }
  Flight(const Flight&) = delete;  // the pass refers to what is in it
  void one_by_one() {
    for (int i = 0; i < n; ++i) pass(i);
  }
  void side_by_side() {
    for (int begin = 0; begin < n; begin += pass.block_size) pass.block(begin, std::min(n, begin + pass.block_size));
  }
  int lost() const { return is_water ? state.lost_water : state.lost_soil; }
  unsigned failed() const { return is_water ? state.failed_water : state.failed_soil; }
};

template <int D, bool is_water>
void expect_the_same(Flight<D, is_water> one, Flight<D, is_water> blocks) {
  one.one_by_one(), blocks.side_by_side();
  for (int k = 0; k < D; ++k) {
    EXPECT_EQ(one.position[k], blocks.position[k]);
    EXPECT_EQ(one.v[k], blocks.v[k]);
    EXPECT_EQ(one.v_previous[k], blocks.v_previous[k]);
  }
  EXPECT_EQ(one.key, blocks.key);
  EXPECT_EQ(one.lost(), blocks.lost());
  EXPECT_EQ(one.failed(), blocks.failed());
}

template <int D, bool is_water>
void expect_the_same_in_all_manners() {
  using F = Flight<D, is_water>;
  for (bool verlet : {false, true}) {
    F scene(verlet);
    scene.one_by_one();
    EXPECT_GT(scene.lost(), 10);
    EXPECT_LT(scene.lost(), F::still_there / 4);
    EXPECT_NE(scene.position[0], F(verlet).position[0]);
    expect_the_same(F(verlet), F(verlet));
    if (is_water) expect_the_same(F(verlet, true), F(verlet, true));
  }
}

TEST(Motion, SideBySideIsOneByOne) {
  expect_the_same_in_all_manners<2, true>();
  expect_the_same_in_all_manners<2, false>();
  expect_the_same_in_all_manners<3, true>();
  expect_the_same_in_all_manners<3, false>();
}

/// All that moves otherwise than usual is moved one by one.
TEST(Motion, SideBySideIsOneByOneWhileTheSceneSettles) {
  for (int settling : {int(Settling::water), int(Settling::all)}) {
    Flight<3, false> one(false), blocks(false);
    one.state.settling = blocks.state.settling = settling;
    one.one_by_one(), blocks.side_by_side();
    for (int k = 0; k < 3; ++k) EXPECT_EQ(one.v[k], blocks.v[k]);
    EXPECT_EQ(one.key, blocks.key);
  }
  Flight<2, true> euler(true), blocks(true);
  euler.state.euler_countdown = blocks.state.euler_countdown = 0;
  euler.one_by_one(), blocks.side_by_side();
  for (int k = 0; k < 2; ++k) EXPECT_EQ(euler.v[k], blocks.v[k]);
}

TEST(Motion, WhatStandsInTheWallsOfTheSidesStopsThere) {
  Flight<2, true> scene(false);
  scene.position[0][7] = 0.01, scene.position[1][7] = 1, scene.v[0][7] = -5, scene.a[0][7] = 0;
  scene.position[0][8] = 3.99, scene.position[1][8] = 1, scene.v[0][8] = 5, scene.a[0][8] = 0;
  scene.position[0][9] = 0.01, scene.position[1][9] = 2, scene.v[0][9] = -5, scene.a[0][9] = 0;  // above the wall
  scene.side_by_side();
  EXPECT_EQ(scene.position[0][7], 0);
  EXPECT_EQ(scene.v[0][7], 0);
  EXPECT_EQ(scene.position[0][8], 4);
  EXPECT_EQ(scene.v[0][8], 0);
  EXPECT_LT(scene.key[7], scene.pass.grid.cells);
  EXPECT_EQ(scene.key[9], scene.pass.grid.cells);
}

TEST(Motion, AStateThatIsNotFiniteOrTooFastIsToldWhereverItStands) {
  for (float wrong : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e6f})
    for (int at : {0, 255, 256, 700, 969}) {
      Flight<3, true> scene(false);
      scene.v[1][std::size_t(at)] = wrong;
      scene.side_by_side();
      EXPECT_EQ(scene.failed(), unsigned(scene.n - at)) << wrong << " at " << at;
    }
}

}  // namespace
}  // namespace lgiw
