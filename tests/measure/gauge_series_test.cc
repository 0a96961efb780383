// Gauges and run-up of the basin's wave, which is known at every place and time.
#include "measure/gauge_series.hh"

#include <gtest/gtest.h>

#include "basin.hh"
#include "measure/arrival_map.hh"
#include "measure/section_runup.hh"
#include "measure/surface_sampling.hh"

namespace lgiw {
namespace {

using namespace test;

std::vector<GaugeSeries> recorded(const RunHeader& header, const std::vector<Gauge>& gauges) {
  GaugeRecorder recorder(header, gauges);
  for (int k = 0; k <= 60; ++k)
    recorder.add(0.5 * k, basin_water(header.map, 0.5 * k), basin_soil(header.map, 0.5 * k));
  return recorder.series();
}

TEST(SurfaceSampling, IsBilinearBetweenWetNodes) {
  SurfaceMap map;
  map.nx = 3, map.ny = 2, map.x0 = 10, map.y0 = 20, map.dx = 4;
  std::vector<float> z{0, 4, 8, 8, 12, 16};
  EXPECT_DOUBLE_EQ(sample_surface(map, z, 10, 20), 0);
  EXPECT_DOUBLE_EQ(sample_surface(map, z, 13, 21), 3 + 2);  // 4 m in x: 4, 4 m in y: 8
  EXPECT_DOUBLE_EQ(sample_surface(map, z, 18, 24), 16);
  EXPECT_DOUBLE_EQ(sample_surface(map, z, 9, 19), 0);  // half a cell outside: the edge's value
  EXPECT_TRUE(std::isnan(sample_surface(map, z, 5, 20)));
  z[1] = NAN;
  EXPECT_DOUBLE_EQ(sample_surface(map, z, 11, 20), 0);      // three quarters of the weight are wet
  EXPECT_TRUE(std::isnan(sample_surface(map, z, 13, 20)));  // one quarter is
  EXPECT_DOUBLE_EQ(sample_surface(map, z, 14, 22), 12);     // half is
}

TEST(SurfaceSampling, StationsRunRoundTheCornersOfASection) {
  const Section section{"A", {{100, 0}, {103, 0}, {103, 4.5}}};
  const auto stations = section_stations(section, {100, 0, 0}, 2);
  ASSERT_EQ(stations.size(), 5u);
  const double expected[][3] = {{0, 0, 0}, {2, 2, 0}, {4, 3, 1}, {6, 3, 3}, {7.5, 3, 4.5}};
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_DOUBLE_EQ(stations[k].distance, expected[k][0]);
    EXPECT_DOUBLE_EQ(stations[k].x, expected[k][1]);
    EXPECT_DOUBLE_EQ(stations[k].y, expected[k][2]);
  }
}

TEST(Gauges, CrestTroughAndArrivalOfAPassingWave) {
  const RunHeader header = basin_header();
  const auto series = recorded(header, {{"G1", 1040, 20}, {"between", 1041, 19.3}});
  EXPECT_EQ(series[0].surface, GaugeSurface::water);
  EXPECT_FALSE(series[0].initially_dry);
  EXPECT_DOUBLE_EQ(series[0].reference, 510);
  EXPECT_DOUBLE_EQ(series[0].bed, 500);
  ASSERT_EQ(series[0].time.size(), 61u);
  EXPECT_DOUBLE_EQ(series[0].elevation[0], 510);

  const GaugePeaks peaks = gauge_peaks(series[0], {0.5, 1, 1.75, 3});
  EXPECT_NEAR(peaks.max_elevation, 512, 1e-5);
  EXPECT_NEAR(peaks.max_height, 2, 1e-5);
  EXPECT_DOUBLE_EQ(peaks.time_of_max, 5);  // 20 m at 4 m/s
  EXPECT_NEAR(peaks.first_trough, -1, 1e-5);
  EXPECT_DOUBLE_EQ(peaks.time_of_trough, 9);  // 16 m later
  ASSERT_EQ(peaks.arrival.size(), 4u);
  EXPECT_NEAR(peaks.arrival[0], 3.5, 1e-5);  // the crest is 6 m away: 8 (1 - 0.5 / 2)
  EXPECT_NEAR(peaks.arrival[1], 4, 1e-5);
  EXPECT_NEAR(peaks.arrival[2], 4.75, 1e-5);  // between two samples
  EXPECT_TRUE(std::isnan(peaks.arrival[3]));

  EXPECT_NEAR(gauge_peaks(series[1], {0.5}).arrival[0], 3.75, 1e-5);
}

TEST(Gauges, OnTheBankHaveNoValueWhileDryAndArriveByDepth) {
  const RunHeader header = basin_header();
  const auto series = recorded(header, {{"B1", 1084, 20}, {"high", 1095, 20}});
  EXPECT_EQ(series[0].surface, GaugeSurface::water);
  EXPECT_TRUE(series[0].initially_dry);
  EXPECT_TRUE(std::isnan(series[0].elevation[0]));
  EXPECT_DOUBLE_EQ(series[0].bed, 512);
  const GaugePeaks peaks = gauge_peaks(series[0], {0.5, 1.75});
  EXPECT_NEAR(peaks.max_elevation, 514, 1e-5);
  EXPECT_NEAR(peaks.max_height, 4, 1e-5);
  EXPECT_DOUBLE_EQ(peaks.time_of_max, 12);
  EXPECT_NEAR(peaks.arrival[0], 10.5, 1e-5);  // the level is 12 at 10 s and rises by 1 m/s; wet from 10.5 s on
  EXPECT_NEAR(peaks.arrival[1], 11.75, 1e-5);
  EXPECT_TRUE(std::isnan(peaks.first_trough));

  const GaugePeaks dry = gauge_peaks(series[1], {0.5});
  EXPECT_TRUE(std::isnan(dry.max_elevation));
  EXPECT_TRUE(std::isnan(dry.max_height));
  EXPECT_TRUE(std::isnan(dry.arrival[0]));
}

TEST(Gauges, OnTheSlideFollowTheSoil) {
  const RunHeader header = basin_header();
  const auto series = recorded(header, {{"S1", 1008, 20}});
  EXPECT_EQ(series[0].surface, GaugeSurface::soil);
  EXPECT_DOUBLE_EQ(series[0].reference, 545);
  EXPECT_DOUBLE_EQ(series[0].elevation[20], 540);  // 10 s
  EXPECT_TRUE(std::isnan(series[0].elevation[50]));
  const GaugePeaks peaks = gauge_peaks(series[0], {2});
  EXPECT_DOUBLE_EQ(peaks.max_height, 0);
  EXPECT_DOUBLE_EQ(peaks.first_trough, -9.75);
  EXPECT_DOUBLE_EQ(peaks.time_of_trough, 19.5);
  EXPECT_DOUBLE_EQ(peaks.arrival[0], 4);
}

TEST(Gauges, RippleBeforeTheTroughIsNotTheTrough) {
  GaugeSeries series;
  series.reference = 10;
  series.time = {0, 1, 2, 3, 4, 5, 6};
  series.elevation = {10, 9.9, 10.1, 12, 9.2, 8.5, 10};
  const GaugePeaks peaks = gauge_peaks(series, {0.25});
  EXPECT_DOUBLE_EQ(peaks.first_trough, -1.5);
  EXPECT_DOUBLE_EQ(peaks.time_of_trough, 5);
  EXPECT_TRUE(std::isnan(gauge_peaks(series, {2}).first_trough));  // none goes so deep
}

TEST(ArrivalMap, TimesOfTheFirstSampleBeyondEachThreshold) {
  const RunHeader header = basin_header();
  ArrivalMap map(header, {0.5, 1.9}, std::vector<double>(header.map.size(), 0));
  for (int k = 0; k <= 60; ++k) map.add(0.5 * k, basin_water(header.map, 0.5 * k));
  const std::size_t row = 10 * header.map.nx;
  EXPECT_EQ(map.arrival(0)[row + 20], 4);  // x = 40: at 3.5 s exactly half a metre, not more
  EXPECT_EQ(map.arrival(1)[row + 20], 5);
  EXPECT_EQ(map.arrival(0)[row + 42], 11);            // x = 84, bed 12: 12.5 at 10.5 s, not more
  EXPECT_TRUE(std::isnan(map.arrival(1)[row + 43]));  // x = 86, bed 13, highest level 14
  EXPECT_TRUE(std::isnan(map.arrival(0)[row + 3]));
}

TEST(ArrivalMap, BeforeTheFastestWaveIsNoneOfTheWave) {
  const RunHeader header = basin_header();
  std::vector<double> earliest(header.map.size(), 0);
  ArrivalMap any(header, {0.5}, earliest);
  for (double& t : earliest) t = 2;
  earliest[12 * header.map.nx + 30] = 9.6;
  ArrivalMap map(header, {0.5}, earliest);
  for (int k = 0; k <= 60; ++k)
    for (ArrivalMap* m : {&any, &map}) m->add(0.5 * k, basin_water(header.map, 0.5 * k));
  const std::size_t settling = 2 * header.map.nx + 30;
  EXPECT_EQ(any.arrival(0)[settling], 0);
  EXPECT_EQ(map.arrival(0)[settling], 9)
      << "the wave's own: its crest is 4 m away, at 8.5 s it was 6 m and half a metre";
  EXPECT_EQ(map.arrival(0)[3 * header.map.nx + 30], 9);
  EXPECT_EQ(map.arrival(0)[12 * header.map.nx + 30], 10) << "what is there when the wave can be counts";
}

TEST(ArrivalMap, WaterThatIsMeasuredOnlyLaterIsStillTheLake) {
  const RunHeader header = basin_header();
  const std::size_t shallow = 10 * header.map.nx + 20;
  ArrivalMap map(header, {0.5}, std::vector<double>(header.map.size(), 0));
  GaugeRecorder gauge(header, {{"G1", 1040, 20}});
  for (int k = 0; k <= 60; ++k) {
    std::vector<float> water = basin_water(header.map, 0.5 * k);
    if (k < 2) water[shallow] = NAN;
    map.add(0.5 * k, water), gauge.add(0.5 * k, water, {});
  }
  EXPECT_EQ(map.arrival(0)[shallow], 4);
  EXPECT_TRUE(gauge.series()[0].initially_dry);
  EXPECT_NEAR(gauge_arrival(gauge.series()[0], 0.5, 0), 3.5, 1e-5);
}

TEST(Gauges, WhatASurfaceDoesBeforeTheFastestWaveIsNoCrestAndNoTrough) {
  GaugeSeries series;
  series.reference = 10;
  series.time = {0, 1, 2, 3, 4, 5, 6, 7};
  series.elevation = {15, 7, 10, 10, 12, 10, 9, 10};
  EXPECT_EQ(gauge_peaks(series, {0.5}).max_height, 5);
  EXPECT_EQ(gauge_peaks(series, {0.5}).first_trough, -3);
  const GaugePeaks peaks = gauge_peaks(series, {0.5}, 1.5);
  EXPECT_EQ(peaks.max_elevation, 12);
  EXPECT_EQ(peaks.max_height, 2);
  EXPECT_EQ(peaks.time_of_max, 4);
  EXPECT_EQ(peaks.first_trough, -1);
  EXPECT_EQ(peaks.time_of_trough, 6);
  for (const double never : {8.0, infinite}) {
    EXPECT_EQ(gauge_peaks(series, {0.5}, never).max_height, 0) << "at rest until then";
    EXPECT_TRUE(std::isnan(gauge_peaks(series, {0.5}, never).time_of_max));
    EXPECT_TRUE(std::isnan(gauge_peaks(series, {0.5}, never).first_trough));
  }
}

TEST(Gauges, AheadOfADrySlideMeasureItFromTheBed) {
  RunHeader header = basin_header();
  header.particles.counts.water = 0;
  GaugeRecorder recorder(header, {{"ahead", 1020, 20}});
  std::vector<float> soil(header.map.size(), NAN);
  recorder.add(0, {}, soil);
  for (float& z : soil) z = 3;  // over ground at 0
  recorder.add(1, {}, soil);
  const GaugeSeries& series = recorder.series()[0];
  EXPECT_EQ(series.surface, GaugeSurface::soil);
  EXPECT_DOUBLE_EQ(series.reference, 500);
  const GaugePeaks peaks = gauge_peaks(series, {0.5});
  EXPECT_DOUBLE_EQ(peaks.max_height, 3);
  EXPECT_DOUBLE_EQ(peaks.arrival[0], 1);
}

TEST(Gauges, ArriveNotBeforeTheFastestWave) {
  const auto series = recorded(basin_header(), {{"settling", 1060, 4}, {"G1", 1040, 20}});
  EXPECT_EQ(gauge_arrival(series[0], 0.5, 0), 0);
  EXPECT_NEAR(gauge_arrival(series[0], 0.5, 2), 8.5, 1e-5);
  EXPECT_NEAR(gauge_peaks(series[0], {0.5, 1}, 2).arrival[1], 9, 1e-5);
  EXPECT_NEAR(gauge_arrival(series[1], 0.5, 4.2), 4.2, 1e-5) << "it is there already";
  EXPECT_TRUE(std::isnan(gauge_arrival(series[1], 0.5, 31)));
  EXPECT_TRUE(std::isnan(gauge_arrival(series[1], 0.5, infinite)));
}

TEST(Runup, OnAPlaneBankIsTheLevelThatTheWaterReached) {
  const RunHeader header = basin_header();
  RunupRecorder recorder(header, {{"A", {{1010, 20}, {1096, 20}}}, {"skew", {{1010, 10}, {1040, 20}, {1096, 37}}}});
  for (int k = 0; k <= 60; ++k) recorder.add(0.5 * k, basin_water(header.map, 0.5 * k));
  for (const SectionRunup& s : recorder.sections()) {
    EXPECT_TRUE(s.has_bank);
    EXPECT_NEAR(s.elevation[0], 510, 1e-5) << "a lake at rest has run-up 0";
    EXPECT_NEAR(s.max_elevation, 514, 1e-5);
    EXPECT_NEAR(s.max_height, 4, 1e-5);
    EXPECT_DOUBLE_EQ(s.time_of_max, 12);
    EXPECT_NEAR(s.elevation[20], 512, 1e-5);  // 10 s
    EXPECT_NEAR(s.elevation.back(), 510, 1e-5);
  }
}

TEST(Runup, BeforeASteepFrontIsTheBed) {
  const RunHeader header = basin_header();
  RunupRecorder recorder(header, {{"A", {{1010, 20}, {1096, 20}}}});
  recorder.add(0, basin_water(header.map, 0));
  std::vector<float> bore = basin_water(header.map, 0);
  for (std::size_t n = 0; n < bore.size(); ++n)
    if (n % 51 >= 40 && n % 51 <= 43) bore[n] = 18;  // x from 80 to 86, 5 m deep at its front
  recorder.add(1, bore);
  // The front lies half-way between the nodes at 86 and 88: bed 13.5.
  EXPECT_NEAR(recorder.sections()[0].max_elevation, 513.5, 1e-5);
}

TEST(Runup, OverTheEndOfItsLineIsALowerBound) {
  // The line ends at x = 82, where the bed is at 11: the water, which stands at 14 m, passes it.
  const RunHeader header = basin_header();
  RunupRecorder recorder(header, {{"short", {{1010, 20}, {1082, 20}}}, {"A", {{1010, 20}, {1096, 20}}}});
  for (int k = 0; k <= 60; ++k) recorder.add(0.5 * k, basin_water(header.map, 0.5 * k));
  const SectionRunup &cut = recorder.sections()[0], &whole = recorder.sections()[1];
  EXPECT_NEAR(cut.max_height, 4, 1e-5);
  EXPECT_GT(cut.overtopped, 8.9);  // the level passes 11 m at 9 s
  EXPECT_LT(cut.overtopped, 10.1);
  EXPECT_NEAR(whole.max_height, 4, 1e-5);
  EXPECT_TRUE(std::isnan(whole.overtopped));
}

TEST(Runup, BeforeTheFastestWaveIsNone) {
  const RunHeader header = basin_header();
  for (const double earliest : {0.0, 13.0, infinite}) {
    RunupRecorder recorder(header, {{"A", {{1010, 20}, {1096, 20}}}}, std::vector<double>(header.map.size(), earliest));
    for (int k = 0; k <= 60; ++k) recorder.add(0.5 * k, basin_water(header.map, 0.5 * k));
    const SectionRunup& s = recorder.sections()[0];
    EXPECT_NEAR(s.elevation[24], 514, 1e-5);
    const double highest = earliest == 0 ? 4 : 3;
    if (earliest > 30) {
      EXPECT_EQ(s.max_height, 0) << "at rest until then";
      EXPECT_TRUE(std::isnan(s.time_of_max));
    } else {
      EXPECT_NEAR(s.max_height, highest, 1e-5);
    }
  }
}

TEST(Runup, WithoutAnOppositeBankIsNone) {
  const RunHeader header = basin_header();
  RunupRecorder recorder(header, {{"into the lake", {{1010, 20}, {1050, 20}}}, {"on land", {{1001, 20}, {1010, 20}}}});
  for (int k = 0; k <= 60; ++k) recorder.add(0.5 * k, basin_water(header.map, 0.5 * k));
  for (const SectionRunup& s : recorder.sections()) {
    EXPECT_FALSE(s.has_bank);
    EXPECT_TRUE(std::isnan(s.max_height));
    EXPECT_TRUE(std::isnan(s.elevation[24]));
  }
}

}  // namespace
}  // namespace lgiw
