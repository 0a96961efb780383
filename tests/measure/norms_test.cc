// Norms against numbers worked out on paper.
#include "measure/norms.hh"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace lgiw {
namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

TEST(Series, IsLinearBetweenSamplesAndNothingOutsideOrBesideAGap) {
  const Series s{{0, 2, 3, 4}, {1, 5, nan_value, 7}};
  EXPECT_DOUBLE_EQ(value_at(s, 0), 1);
  EXPECT_DOUBLE_EQ(value_at(s, 0.5), 2);
  EXPECT_DOUBLE_EQ(value_at(s, 4), 7);
  EXPECT_TRUE(std::isnan(value_at(s, 2.5)));
  EXPECT_TRUE(std::isnan(value_at(s, -0.1)));
  EXPECT_TRUE(std::isnan(value_at(s, 4.1)));
  const Series part = part_of(s, 1, 2);
  EXPECT_EQ(part.time, (std::vector<double>{1, 2}));
  EXPECT_EQ(part.value, (std::vector<double>{3, 5}));
}

TEST(Series, FirstCrestAndTroughPassOverRipples) {
  const Series s{{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}, {0, -0.1, 0.1, -2, -3, 1, 0.5, -9, 8, 0}};
  const Extreme trough = first_trough(s, 0.5), crest = first_crest(s, 0.5);
  EXPECT_DOUBLE_EQ(trough.value, -3);
  EXPECT_DOUBLE_EQ(trough.time, 4);
  EXPECT_DOUBLE_EQ(crest.value, 1);
  EXPECT_DOUBLE_EQ(crest.time, 5);
  EXPECT_DOUBLE_EQ(first_crest(s, 2).value, 8);
  EXPECT_TRUE(std::isnan(first_crest(s, 10).value));
  EXPECT_DOUBLE_EQ(arrival_time(s, 0.5), 2 + 0.4 / 1.9);  // |value| rises from 0.1 to 2
  EXPECT_TRUE(std::isnan(arrival_time(s, 10)));
}

TEST(Norms, OfFourSamples) {
  // O = 0 2 -2 4, P = 1 2 -3 6 at its times: errors 1 0 -1 2. Mean O = 1.
  const Series reference{{0, 1, 2, 3}, {0, 2, -2, 4}}, run{{0, 1, 2, 3}, {1, 2, -3, 6}};
  const SeriesNorms n = compare_series(run, reference, 0.5);
  EXPECT_EQ(n.samples, 4u);
  EXPECT_DOUBLE_EQ(n.rmse, std::sqrt(6.0 / 4));
  EXPECT_DOUBLE_EQ(n.nrmse, std::sqrt(6.0 / 4) / 6);
  EXPECT_DOUBLE_EQ(n.mae, 1);
  // |P - 1| + |O - 1| = 0+1, 1+1, 4+3, 5+3: squares 1 + 4 + 49 + 64 = 118.
  EXPECT_DOUBLE_EQ(n.willmott_d, 1 - 6.0 / 118);
  EXPECT_DOUBLE_EQ(n.run.highest.value, 6);
  EXPECT_DOUBLE_EQ(n.reference.highest.value, 4);
  EXPECT_DOUBLE_EQ(n.run.trough.value, -3);
  EXPECT_DOUBLE_EQ(n.reference.trough.time, 2);
  EXPECT_DOUBLE_EQ(n.reference.arrival, 0.25);
  EXPECT_DOUBLE_EQ(n.run.arrival, 0);
  EXPECT_DOUBLE_EQ(percent_error(6, 4), 50);
  EXPECT_DOUBLE_EQ(percent_error(-3, -2), -50);
  EXPECT_TRUE(std::isnan(percent_error(1, 0)));
}

TEST(Norms, OnlyTheOverlapCountsAndGapsAreLeftOut) {
  // The run rises by 1 a second from t = 1 on; the reference the same, but for its first and its last sample.
  const Series run{{1, 3, 5}, {1, 3, 5}}, reference{{0, 2, 3, 4, 6}, {77, 2, nan_value, 4.5, 99}};
  const SeriesNorms n = compare_series(run, reference, 0.5);
  EXPECT_DOUBLE_EQ(n.from, 1);
  EXPECT_DOUBLE_EQ(n.to, 5);
  EXPECT_EQ(n.samples, 2u);
  EXPECT_DOUBLE_EQ(n.rmse, std::sqrt(0.25 / 2));
  EXPECT_DOUBLE_EQ(n.mae, 0.25);
  EXPECT_DOUBLE_EQ(n.run.highest.value, 5);
  EXPECT_DOUBLE_EQ(n.reference.highest.value, (4.5 + 99) / 2);  // at the overlap's end, half-way from 4 s to 6 s

  const SeriesNorms none = compare_series({{0, 1}, {0, 1}}, {{2, 3}, {0, 1}}, 0.5);
  EXPECT_EQ(none.samples, 0u);
  EXPECT_TRUE(std::isnan(none.rmse));
}

TEST(Norms, PerfectAgreement) {
  const Series s{{0, 1, 2, 4}, {0, 3, -1, 2}};
  const SeriesNorms n = compare_series(s, s, 0.5);
  EXPECT_EQ(n.rmse, 0);
  EXPECT_EQ(n.willmott_d, 1);
}

/// A hump of 2 m, 6 s wide, whose crest comes at `crest`.
double hump(double t, double crest) {
  return std::abs(t - crest) < 3 ? 1 + std::cos(std::numbers::pi * (t - crest) / 3) : 0;
}

TEST(Norms, LagIsTheShiftOfAShiftedWave) {
  Series reference, late, fine;
  for (int k = 0; k <= 200; ++k) reference.time.push_back(0.1 * k), reference.value.push_back(hump(0.1 * k, 8));
  late = reference, fine = reference;
  for (int k = 0; k <= 200; ++k) late.value[k] = hump(0.1 * k, 8.7), fine.value[k] = 0.5 * hump(0.1 * k, 7.66) + 3;
  const SeriesNorms n = compare_series(late, reference, 0.1);
  EXPECT_NEAR(n.phase_lag, 0.7, 1e-3);
  EXPECT_NEAR(n.correlation, 1, 1e-6);
  EXPECT_NEAR(n.run.arrival - n.reference.arrival, 0.7, 0.02);
  EXPECT_NEAR(n.run.crest.time - n.reference.crest.time, 0.7, 1e-9);
  EXPECT_NEAR(compare_series(reference, late, 0.1).phase_lag, -0.7, 1e-3);
  EXPECT_NEAR(compare_series(fine, reference, 0.1).phase_lag, -0.34, 0.01);  // neither height nor level matters
  for (double& v : late.value) v = 0;
  EXPECT_TRUE(std::isnan(compare_series(late, reference, 0.1).phase_lag));  // a flat series has none
}

TEST(Norms, LagOfAPeriodicWaveIsTheNearestOne) {
  Series reference, run;
  for (int k = 0; k <= 400; ++k) {
    const double t = 0.05 * k;
    reference.time.push_back(t), run.time.push_back(t);
    reference.value.push_back(std::sin(2 * std::numbers::pi * t / 2));
    run.value.push_back(std::sin(2 * std::numbers::pi * (t - 0.3) / 2));
  }
  EXPECT_NEAR(compare_series(run, reference, 0.1).phase_lag, 0.3, 1e-3);
}

TEST(Aida, OfTwoRunups) {
  // Ratios 2 and 1/2: their geometric mean is 1, ln kappa = ln 2.
  const AidaNumbers even = aida_numbers({1, 2}, {2, 1});
  EXPECT_DOUBLE_EQ(even.K, 1);
  EXPECT_DOUBLE_EQ(even.kappa, 2);
  const AidaNumbers low = aida_numbers({1, 10}, {1.1, 11});
  EXPECT_NEAR(low.K, 1.1, 1e-12);
  EXPECT_NEAR(low.kappa, 1, 1e-6);
  EXPECT_TRUE(std::isnan(aida_numbers({1, 0}, {1, 1}).K));
  EXPECT_TRUE(std::isnan(aida_numbers({}, {}).kappa));
}

TEST(Profiles, DistancesFrontAndHeight) {
  // A wedge on a flat bed at 1 m: 2 m thick at 0, thin at 4, none from 5 on.
  const SurfaceProfile run{{0, 1, 2, 3, 4, 5, 6}, {1, 1, 1, 1, 1, 1, 1}, {3, 2.5, 2, 1.5, 1, nan_value, nan_value}};
  // One point on the surface, one 1 m above it, one above the bed beyond the front, one outside.
  const ProfileNorms n = compare_profiles(run, {0, 2, 5.5, 9}, {3, 3, 1.5, 1}, 0.25, 1);
  EXPECT_EQ(n.samples, 3u);
  EXPECT_DOUBLE_EQ(n.rms_height, std::sqrt((0 + 1 + 0.25) / 3));
  // 1 m above a slope of 1 : 2 is 2 / sqrt 5 off it.
  EXPECT_NEAR(n.rms_distance, std::sqrt((0 + 0.8 + 0.25) / 3), 1e-12);
  EXPECT_DOUBLE_EQ(n.front_run, 3.5);        // half-way from 0.5 m at 3 to 0 at 4
  EXPECT_DOUBLE_EQ(n.front_reference, 5.5);  // its outermost point over the bed that is thicker than 0.25 m
  EXPECT_DOUBLE_EQ(n.height_run, 3);
  EXPECT_DOUBLE_EQ(n.height_reference, 3);

  const SurfaceProfile mirrored{{-6, -5, -4, -3, -2, -1, 0}, run.bed, {nan_value, nan_value, 1, 1.5, 2, 2.5, 3}};
  const ProfileNorms m = compare_profiles(mirrored, {-5, -3, -1}, {1, 2, 3}, 0.25, -1);
  EXPECT_DOUBLE_EQ(m.front_run, -3.5);
  EXPECT_DOUBLE_EQ(m.front_reference, -4.5);  // 0 at -5, 1 m at -3
}

TEST(Profiles, ThatShareNoPlaceHaveNoNorms) {
  const ProfileNorms n = compare_profiles({{0, 1}, {0, 0}, {1, 1}}, {5, 6}, {1, 1}, 0.1, 1);
  EXPECT_EQ(n.samples, 0u);
  EXPECT_TRUE(std::isnan(n.rms_distance));
}

}  // namespace
}  // namespace lgiw
