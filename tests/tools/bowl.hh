// A small lake in a bowl with a slide on its east bank, as a user would hand it in: a case and an ASCII grid.
#pragma once

#include <cstdio>
#include <functional>
#include <stdexcept>
#include <string>

namespace lgiw::test {

/// `text` with the first `from` replaced; the test is wrong where there is none.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("no '" + from + "' in the text");
  return text.replace(at, from.size(), to);
}

/// 30 x 30 cells of 20 m around (500000, 3700000), EPSG:32611: z = 80 + r^2/900, from 80 m in the middle to some 280 m.
inline double bowl_height(double dx, double dy) { return 80 + (dx * dx + dy * dy) / 900; }

/// `height(dx, dy)` may return NaN for a void.
inline std::string ascii_grid(const std::function<double(double, double)>& height = bowl_height) {
  std::string text = "ncols 30\nnrows 30\nxllcorner 499700\nyllcorner 3699700\ncellsize 20\nNODATA_value -9999\n";
  for (int row = 0; row < 30; ++row) {
    for (int column = 0; column < 30; ++column) {
      const double z = height(-290 + 20 * column, 290 - 20 * row);
      char number[32];
      std::snprintf(number, sizeof number, "%.3f ", z == z ? z : -9999.0);
      text += number;
    }
    text += "\n";
  }
  return text;
}

// The lake has a radius of 164 m; the slide lies between 115 and 155 m.
const std::string bowl_case = R"(name: bowl
particle_spacing: 20
terrain:
  crs: EPSG:32611
  sources:
    - file: dem.asc
  window: [499720, 3699720, 500280, 3700280]
water:
  level: 110
  seed: [500000, 3700000]
slide:
  polygon: [[500180, 3699940], [500260, 3699940], [500260, 3700060], [500180, 3700060]]
  depth: 30
soil:
  friction_angle: 20
  density: 2000
output:
  end_time: 1
  frame_interval: 0.5
gauges:
  - {name: G1, x: 500000, y: 3700000}
sections:
  - {name: A, points: [[500270, 3700000], [499730, 3700000]]}
)";

}  // namespace lgiw::test
