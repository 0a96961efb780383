// Formulas of impulse waves against a worked example, their limits, and by hand.
#include "measure/empirical_wave.hh"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace lgiw {
namespace {

std::vector<std::string> names_of(const BrokenLimits& broken) {
  std::vector<std::string> names;
  for (const BrokenLimit& l : broken) names.push_back(l.quantity);
  return names;
}
using Names = std::vector<std::string>;

/// The worked example of the manual VAW 254 (Evers et al. 2019).
const SlideImpact example{58, 12, 100, 220000, 1700, 40, 80};

TEST(EmpiricalWave, WorkedExampleOfTheManual) {
  const ImpulseNumbers n = impulse_numbers(example);
  EXPECT_NEAR(n.impulse_product, 0.64, 0.005);
  const BasinWave wave = vaw254_impact(example);
  EXPECT_NEAR(wave.crest, 14.4, 0.05);
  EXPECT_NEAR(wave.trough, 22.7, 0.05);
  EXPECT_NEAR(wave.second_crest, 10.1, 0.05);
  EXPECT_TRUE(wave.broken.empty());  // S lies on its limit, 0.15
}

TEST(EmpiricalWave, NumbersByHand) {
  // h 10 m, g 10 m/s2: F = 20 / 10; S = 0.4; V/(b h2) = 4000 / (10 x 100) = 4; M = 2 x 4.
  const SlideImpact impact{20, 4, 10, 4000, 2000, 70, 10, 1000, 10};
  const ImpulseNumbers n = impulse_numbers(impact);
  EXPECT_DOUBLE_EQ(n.froude, 2);
  EXPECT_DOUBLE_EQ(n.thickness, 0.4);
  EXPECT_DOUBLE_EQ(n.volume, 4);
  EXPECT_DOUBLE_EQ(n.mass, 8);
  EXPECT_DOUBLE_EQ(n.width, 1);
  EXPECT_DOUBLE_EQ(n.density, 2);
  EXPECT_NEAR(n.effective_cosine, 0.5, 1e-12);  // 6/7 of 70 degrees is 60
  EXPECT_NEAR(n.impulse_product, 2 * std::sqrt(0.4) * std::pow(8, 0.25) * std::sqrt(0.5), 1e-12);
}

TEST(EmpiricalWave, BasinWaveLeavesTheImpactZoneWithoutAStep) {
  for (const double angle : {0.0, 30.0, 90.0}) {
    const double r0 = vaw254_impact_radius(example, angle);
    const BasinWave inside = vaw254_basin(example, 0.5 * r0, angle), edge = vaw254_basin(example, r0, angle),
                    outside = vaw254_basin(example, r0 * (1 + 1e-12), angle);
    EXPECT_TRUE(inside.near);
    EXPECT_FALSE(outside.near);
    EXPECT_DOUBLE_EQ(inside.crest, edge.crest);
    EXPECT_NEAR(outside.crest, edge.crest, 1e-4 * edge.crest);
    EXPECT_NEAR(outside.trough, edge.trough, 1e-4 * edge.trough);
    EXPECT_NEAR(outside.second_crest, edge.second_crest, 1e-4 * edge.second_crest);
  }
  EXPECT_DOUBLE_EQ(vaw254_basin(example, vaw254_impact_radius(example, 0), 0).crest, vaw254_impact(example).crest);
}

TEST(EmpiricalWave, ImpactZoneIsAnEllipse) {
  const ImpulseNumbers n = impulse_numbers(example);
  const double Pc = n.impulse_product * n.effective_cosine;
  const double along = 2.5 * std::pow(Pc * 1.25, 0.25) * 80, across = 50 + 1.5 * std::pow(Pc, 0.25) * 80;
  EXPECT_NEAR(vaw254_impact_radius(example, 0), along, 1e-9);
  EXPECT_NEAR(vaw254_impact_radius(example, 90), across, 1e-9);
  EXPECT_NEAR(vaw254_impact_radius(example, -90), across, 1e-9);
  const double r = vaw254_impact_radius(example, 40), angle = 40 * std::numbers::pi / 180;
  EXPECT_NEAR(std::pow(r * std::cos(angle) / along, 2) + std::pow(r * std::sin(angle) / across, 2), 1, 1e-12);
}

TEST(EmpiricalWave, BasinWaveDecaysOutwardsAndSidewaysAndEndsBehind) {
  const BasinWave near = vaw254_basin(example, 300, 0), far = vaw254_basin(example, 900, 0),
                  aside = vaw254_basin(example, 300, 60);
  EXPECT_GT(near.crest, far.crest);
  EXPECT_GT(near.crest, aside.crest);
  EXPECT_DOUBLE_EQ(aside.crest, vaw254_basin(example, 300, -60).crest);
  // By hand, on the axis: r* = 300 - r0, a0 = 14.39 m.
  const double a0 = vaw254_impact(example).crest, beyond = 300 - vaw254_impact_radius(example, 0);
  EXPECT_NEAR(near.crest, a0 * std::exp(-0.4 * std::pow(a0 / 80, -0.3) * std::sqrt(beyond / 80)), 1e-12);
  EXPECT_NEAR(near.celerity, 0.95 * std::sqrt(9.81 * (80 + near.crest)), 1e-12);
  const BasinWave behind = vaw254_basin(example, 300, 120);
  EXPECT_TRUE(std::isnan(behind.crest));
  EXPECT_EQ(names_of(behind.broken), Names{"angle"});
  EXPECT_EQ(names_of(vaw254_basin(example, 40, 0).broken), Names{"r/h"});
  EXPECT_EQ(names_of(vaw254_basin(example, 1700, 0).broken), Names{"r/h"});
}

TEST(EmpiricalWave, ChannelWaveByHandAndItsStep) {
  // P = 1 exactly: cos(6/7 alpha) = 1/4, F = 2, S = M = 1.
  const double slope = std::acos(0.25) * 180 / std::numbers::pi * 7 / 6;
  const SlideImpact impact{20, 10, 10, 500, 2000, slope, 10, 1000, 10};
  ASSERT_NEAR(impulse_numbers(impact).impulse_product, 1, 1e-12);
  const double x_M = vaw254_peak_distance(impact);
  EXPECT_NEAR(x_M, 55, 1e-9);
  const ChannelWave largest = vaw254_channel(impact, 0.999 * x_M);
  EXPECT_TRUE(largest.near);
  EXPECT_NEAR(largest.height, 50.0 / 9, 1e-9);
  EXPECT_NEAR(largest.crest, 40.0 / 9, 1e-9);
  EXPECT_NEAR(largest.period, 9, 1e-9);                   // (h/g)^1/2 is 1 s
  const ChannelWave beyond = vaw254_channel(impact, 80);  // X = 8: X^-1/3 = 1/2, X^5/16 = 2^(15/16)
  EXPECT_FALSE(beyond.near);
  EXPECT_NEAR(beyond.height, 7.5 * std::pow(0.5, 0.8), 1e-9);
  EXPECT_NEAR(beyond.period, 9 * std::pow(2, 15.0 / 16), 1e-9);
  EXPECT_NEAR(beyond.celerity, std::sqrt(10 * (10 + beyond.crest)), 1e-9);
  // The source's two fits do not meet; the step is what they say.
  EXPECT_NEAR(vaw254_channel(impact, x_M).height / largest.height, 1.35 * std::pow(5.5, -4.0 / 15), 1e-9);
}

TEST(EmpiricalWave, LimitsThatAreBrokenAreNamedWithValueAndRange) {
  EXPECT_EQ(names_of(vaw254_channel(example, 1000).broken), Names{});
  SlideImpact slow = example;
  slow.speed = 8, slow.slope = 20;  // F 0.286
  const BrokenLimits broken = vaw254_basin(slow, 500, 0).broken;
  EXPECT_EQ(names_of(broken), (Names{"F", "P", "slope"}));
  EXPECT_NEAR(broken[0].value, 0.2856, 1e-4);
  EXPECT_EQ(broken[0].low, 0.4);
  EXPECT_EQ(broken[0].high, 3.4);
  EXPECT_EQ(broken[2].value, 20);
  EXPECT_EQ(names_of(vaw254_channel(slow, 6000, true).broken), (Names{"F", "P", "slope", "x/h"}));
  SlideImpact narrow = example;
  narrow.width = 10, narrow.volume = 22000;
  EXPECT_EQ(names_of(vaw254_channel(narrow, 1000).broken), Names{"B"});
  EXPECT_EQ(names_of(vaw254_channel(narrow, 1000, true).broken), Names{});
}

// The slide of Huangtian with assumed depth 165 m, thickness 60 m, slope 33 degrees and density 2000 kg/m3 over the
// width of the field, 600 m: the crest of the reference simulation is 34.3 m.
TEST(EmpiricalWave, HuangtianIsInTheRangeOfTheSimulationAndOutsideTheLimits) {
  SlideImpact impact{15, 60, 600, 11.3e6, 2000, 33, 165};
  EXPECT_NEAR(impulse_numbers(impact).impulse_product, 0.23, 0.005);
  EXPECT_NEAR(vaw254_channel(impact, 0).height, 28, 0.5);
  EXPECT_EQ(names_of(vaw254_channel(impact, 0, true).broken), (Names{"F", "D"}));
  EXPECT_EQ(names_of(vaw254_impact(impact).broken), (Names{"F", "M"}));
  impact.speed = 20;
  EXPECT_NEAR(impulse_numbers(impact).impulse_product, 0.31, 0.005);
  EXPECT_NEAR(vaw254_channel(impact, 0).height, 35, 0.5);
  EXPECT_EQ(names_of(vaw254_impact(impact).broken), Names{"M"});
}

TEST(EmpiricalWave, OlderFormulasByHand) {
  // F = 1, S = 1, V/(b h2) = 1, D = 16, B = 1.
  const SlideImpact impact{10, 10, 10, 1000, 16000, 45, 10, 1000, 10};
  EXPECT_NEAR(fritz_crest(impact).value, 2.5, 1e-12);
  EXPECT_TRUE(fritz_crest(impact).broken.empty());
  const double sine = std::sqrt(0.5);
  EXPECT_NEAR(huber_hager_channel_height(impact, 160).value, 0.88 * sine * 2 * 0.5 * 10, 1e-12);
  EXPECT_NEAR(huber_hager_basin_height(impact, 80, 0).value, 1.76 * sine * 2 / 4 * 10, 1e-12);
  EXPECT_NEAR(huber_hager_basin_height(impact, 80, 90).value, 1.76 * sine * 2 / 4 / 4 * 10, 1e-12);
  EXPECT_NEAR(mohammed_fritz_crest(impact, 10, 60).value, 3.1 / 2, 1e-12);
  EXPECT_NEAR(mohammed_fritz_crest(impact, 100, 0).value, 3.1 * std::pow(10, -1.2), 1e-12);
  SlideImpact flatter = impact;
  flatter.slope = 25;
  EXPECT_EQ(names_of(fritz_crest(flatter).broken), Names{"slope"});
  EXPECT_EQ(names_of(huber_hager_channel_height(flatter, 160).broken), Names{"slope"});
  EXPECT_TRUE(std::isnan(mohammed_fritz_crest(impact, 10, 100).value));
}

TEST(EmpiricalWave, RunupByHand) {
  const BankWave wave{1, 1, 10, 10, 45};  // a = H = 1 m, L = 10 m, h = 10 m
  const double steepness = std::pow(2, 0.2);
  EXPECT_NEAR(mueller_runup(wave).value, 12.5 * std::pow(0.1, 1.25) * std::pow(0.1, -0.15) * steepness, 1e-12);
  EXPECT_NEAR(evers_boes_runup(wave).value, 2 * std::exp(0.04) * steepness, 1e-12);
  EXPECT_NEAR(synolakis_runup(wave).value, 28.31 * std::pow(0.1, 1.25), 1e-12);
  EXPECT_NEAR(hall_watts_runup(wave).value, 30.5 * std::pow(0.1, 1.15), 1e-12);
  EXPECT_TRUE(synolakis_runup(wave).broken.empty());
  // 1:19.85, the beach of the laboratory: waves above 0.0295 depths break.
  const double beach = std::atan(1 / 19.85) * 180 / std::numbers::pi;
  EXPECT_TRUE(synolakis_runup({0.029, 0, 0, 1, beach}).broken.empty());
  EXPECT_EQ(names_of(synolakis_runup({0.03, 0, 0, 1, beach}).broken), Names{"a/h"});
  EXPECT_EQ(names_of(evers_boes_runup({0.7, 0, 0, 1, 5}).broken), (Names{"a/h", "bank"}));
  EXPECT_EQ(names_of(hall_watts_runup({0.1, 0, 0, 1, 60}).broken), Names{"bank"});
}

TEST(EmpiricalWave, KoernersSlideFallsFreelyDownACliffAndStaysOnAGentleSlope) {
  EXPECT_NEAR(koerner_speed(20, 90, 20, 10).value, 20, 1e-9);
  EXPECT_NEAR(koerner_speed(20, 45, 20, 10).value, 20 * std::sqrt(1 - std::tan(20 * std::numbers::pi / 180)), 1e-9);
  EXPECT_EQ(koerner_speed(20, 30, 31, 10).value, 0);
  EXPECT_EQ(names_of(koerner_speed(20, 45, 10, 10).broken), Names{"friction angle"});
}

TEST(EmpiricalWave, WhatIsOnlyRecalledSaysSo) {
  namespace f = formulas;
  for (const Formula* formula : {&f::vaw254_channel, &f::vaw254_basin, &f::mueller, &f::synolakis})
    EXPECT_TRUE(formula->verified) << formula->source;
  for (const Formula* formula :
       {&f::fritz, &f::huber_hager_channel, &f::huber_hager_basin, &f::mohammed_fritz, &f::evers_boes, &f::hall_watts})
    EXPECT_FALSE(formula->verified) << formula->source;
}

}  // namespace
}  // namespace lgiw
