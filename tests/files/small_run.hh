// A run file of the small scene.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "files/run_file.hh"
#include "small_scene.hh"

namespace lgiw {

/// The run of the small scene: 2 particles of water, 1 of soil, a map of 3 by 2 nodes, two pressure gauges.
inline RunHeader small_run() {
  RunHeader header;
  header.particles = small_header();
  header.particle_volume = 0.125;
  header.left_out = "[\"artificial stress\"]";
  header.map = {3, 2, 1, 0.5, 2};
  header.initial_soil = {1, 2, 3};
  header.pressure_gauges = {"wall", "bed"};
  return header;
}

inline Frame small_frame(int k) {
  const float t = float(k);
  return {0.5 * k,
          {t, 0, 0, 1, t, 0, 2, 0, t},
          {1, 2, 3, 4, 5, 6, 7, 8, t},
          {100 + t, 200, 300},
          {0, 0, 0.125f * t},
          {0, 0, uint8_t(k % 2)}};
}

inline std::vector<float> small_map(int k) { return {float(k), 1, NAN, 3, 4, 0.5f * float(k)}; }

/// One step of a solver: frames every 3rd, surfaces and three rows of diagnostics in each.
inline void add_step(RunWriter& writer, int step) {
  if (step % 3 == 0) writer.add_frame(small_frame(step / 3));
  for (int row = 0; row < 3; ++row)
    writer.add_diagnostics(step + row / 3.0, {{"mass", 5.0}, {"energy", -1.0 * step}, {"a density", 1000.0 + row}});
  writer.add_surface(0.25 * step, small_map(step), small_map(-step), {100 + float(step), 200 - float(step)});
}

inline void finish(RunWriter& writer) {
  writer.write_maxima({{"elevation", small_map(9)}, {"arrival", small_map(1)}, {"soil_speed", small_map(2)}});
  writer.write_summary("{\"steps\": 3}");
  writer.close();
}

inline void write_small_run(const std::string& path, int n_steps) {
  RunWriter writer(path, small_run());
  for (int step = 0; step < n_steps; ++step) add_step(writer, step);
  finish(writer);
}

}  // namespace lgiw
