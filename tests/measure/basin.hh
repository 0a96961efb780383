// A run made by hand: a basin with a wave, a run-up and a slide that are known at every place and time.
//
// Local coordinates, m; the case's are these + (1000, 0, 500). The ground falls from 40 at x = 0 to 0 at x = 20, is
// flat to x = 60 and rises to 20 at x = 100, for y from 0 to 40. Still water stands at 10: from x = 15 to x = 80.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "files/run_file.hh"

namespace lgiw::test {

inline const std::string basin_case = R"(name: basin
particle_spacing: 2
terrain: {profile: [[1000, 540], [1020, 500], [1060, 500], [1100, 520]], width: 40}
water: {level: 510}
slide: {bodies: [[[1002, 545], [1012, 545], [1012, 520], [1002, 537]]]}
soil: {friction_angle: 20}
gauges:
  - {name: G1, x: 1040, y: 20}
  - {name: B1, x: 1084, y: 20}
  - {name: S1, x: 1008, y: 20}
sections:
  - {name: A, points: [[1010, 20], [1096, 20]]}
)";

inline double basin_ground(double x) { return x < 20 ? 40 - 2 * x : x < 60 ? 0 : (x - 60) / 2; }
constexpr double basin_level = 10;

/// A crest of 2 m that passes x at t = (x - 20) / 4, half as wide as 8 m to either side, and 16 m behind it a trough of
/// 1 m.
inline double basin_wave(double x, double t) {
  const double u = x - 20 - 4 * t;
  return 2 * std::max(0.0, 1 - std::abs(u) / 8) - std::max(0.0, 1 - std::abs(u + 16) / 8);
}

/// The level at the east bank: 4 m above still water at t = 12 s.
inline double basin_bank_level(double t) { return basin_level + 4 * std::max(0.0, 1 - std::abs(t - 12) / 4); }

/// Water surface by node; NaN where dry. The wave is in the basin to x = 70, the level of the bank beyond. At (60, 4) the
/// water finds its place first: until t = 1.5 s it stands a metre too high.
inline std::vector<float> basin_water(const SurfaceMap& map, double t) {
  std::vector<float> z(map.size(), NAN);
  for (std::size_t n = 0; n < z.size(); ++n) {
    const double x = map.x0 + double(n % map.nx) * map.dx;
    const double surface = x > 70 ? basin_bank_level(t) : basin_level + basin_wave(x, t);
    if (x > 15 && basin_ground(x) < surface) z[n] = float(surface);
    if (t < 1.5 && x == 60 && map.y(n) == 4) z[n] += 1;
  }
  return z;
}

/// The slide's surface on the west bank (x from 2 to 12): sinks by half a metre a second, and is gone after 20 s.
inline std::vector<float> basin_soil(const SurfaceMap& map, double t) {
  std::vector<float> z(map.size(), NAN);
  for (std::size_t n = 0; n < z.size(); ++n) {
    const double x = map.x0 + double(n % map.nx) * map.dx;
    if (x >= 2 && x <= 12 && t < 20) z[n] = float(45 - 0.5 * t);
  }
  return z;
}

/// 10 x 6 x 5 particles, dp apart: 20 m along x, 12 m along y, 10 m high, its lowest corner at (x, y, z).
inline std::vector<float> soil_block(double dp, double x, double y, double z) {
  std::vector<float> points;
  for (int k = 0; k < 5; ++k)
    for (int j = 0; j < 6; ++j)
      for (int i = 0; i < 10; ++i)
        points.insert(points.end(), {float(x + (i + 0.5) * dp), float(y + (j + 0.5) * dp), float(z + (k + 0.5) * dp)});
  return points;
}

inline RunHeader basin_header(bool with_soil = true) {
  RunHeader header;
  ParticleHeader& p = header.particles;
  p.dp = 2;
  p.origin = {1000, 0, 500};
  p.vertical_datum = "EGM96";
  p.still_water_level = basin_level;
  p.low = {0, 0, -10};
  p.high = {100, 40, 80};
  p.bed.nx = 101, p.bed.ny = 41, p.bed.dx = 1;
  for (std::size_t n = 0; n < 101 * 41; ++n) p.bed.z.push_back(basin_ground(double(n % 101)));
  p.ground = p.bed;
  p.case_text = basin_case;
  p.provenance = "{}";
  p.counts.water = 2;
  header.particle_volume = 8;
  header.left_out = "[]";
  header.map.nx = 51, header.map.ny = 21, header.map.dx = 2;
  if (with_soil) {
    p.counts.soil = 300;
    header.initial_soil = soil_block(2, 0, 14, 30);
  }
  return header;
}

/// A frame of basin_header(): the block moved by (dx, 0, dz), at `speed` along x, with one strain for all of it; two
/// drops.
inline Frame basin_frame(const RunHeader& header, double time, double dx, double dz, double speed, double strain) {
  Frame frame;
  frame.time = time;
  frame.points = {40, 20, 5, 42, 20, 5};
  for (std::size_t k = 0; k < header.initial_soil.size(); k += 3) {
    frame.points.push_back(float(header.initial_soil[k] + dx));
    frame.points.push_back(header.initial_soil[k + 1]);
    frame.points.push_back(float(header.initial_soil[k + 2] + dz));
  }
  const std::size_t n = frame.points.size() / 3;
  frame.velocity.assign(3 * n, 0);
  for (std::size_t k = 2; k < n; ++k) frame.velocity[3 * k] = float(speed);
  frame.pressure.assign(n, 0);
  if (!header.initial_soil.empty()) {
    frame.adps.assign(n, float(strain));
    frame.adps[0] = frame.adps[1] = 0;
  }
  frame.lost.assign(n, 0);
  return frame;
}

/// Writes the run: surfaces every half second to 30 s, their maxima, and three frames of the slide. At the end the
/// block has moved by (20, 0, -28): it stands 8 m deep in the water, 2 m high above it.
inline void write_basin_run(const std::string& path, bool with_soil = true, const std::string& crs_wkt = "") {
  RunHeader header = basin_header(with_soil);
  header.particles.crs_wkt = crs_wkt;
  RunWriter writer(path, header);
  writer.add_frame(basin_frame(header, 0, 0, 0, 0, 0));
  writer.add_frame(basin_frame(header, 10, 10, -14, 7, 0.5));
  writer.add_frame(basin_frame(header, 30, 20, -28, 0, 0.5));
  std::map<std::string, std::vector<float>> maxima;
  std::vector<float> elevation(header.map.size(), NAN), arrival(header.map.size(), NAN);
  for (int k = 0; k <= 60; ++k) {
    const double t = 0.5 * k;
    const std::vector<float> water = basin_water(header.map, t);
    writer.add_surface(t, water, with_soil ? basin_soil(header.map, t) : std::vector<float>{});
    for (std::size_t n = 0; n < water.size(); ++n) {
      if (!std::isnan(water[n]) && !(water[n] <= elevation[n])) elevation[n] = water[n];
      if (std::isnan(arrival[n]) && std::abs(water[n] - basin_level) > 0.5) arrival[n] = float(t);
    }
  }
  maxima["elevation"] = elevation;
  maxima["arrival"] = arrival;
  maxima["depth"] = elevation;
  for (std::size_t n = 0; n < elevation.size(); ++n)
    maxima["depth"][n] -= float(basin_ground(header.map.x0 + double(n % header.map.nx) * header.map.dx));
  maxima["speed"].assign(header.map.size(), 3);
  if (with_soil) maxima["soil_speed"].assign(header.map.size(), 7);
  writer.write_maxima(maxima);
  writer.close();
}

}  // namespace lgiw::test
