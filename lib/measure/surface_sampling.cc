#include "measure/surface_sampling.hh"

#include <algorithm>
#include <cmath>

#include "base/error.hh"
#include "files/domain.hh"

namespace lgiw {
double sample_surface(const SurfaceMap& map, const std::vector<float>& values, double x, double y) {
  const double u = (x - map.x0) / map.dx, v = map.ny > 1 ? (y - map.y0) / map.dx : 0;
  if (!(u >= -1 && v >= -1 && u <= double(map.nx) && v <= double(map.ny))) return no_value;
  const double uc = std::clamp(u, 0.0, double(map.nx - 1)), vc = std::clamp(v, 0.0, double(map.ny - 1));
  const std::size_t i = std::min(std::size_t(uc), map.nx >= 2 ? map.nx - 2 : 0);
  const std::size_t j = std::min(std::size_t(vc), map.ny >= 2 ? map.ny - 2 : 0);
  const double a = uc - double(i), b = vc - double(j);
  double sum = 0, weight = 0;
  const auto add = [&](std::size_t di, std::size_t dj, double w) {
    if (w <= 0) return;
    const float z = values[(j + dj) * map.nx + i + di];
    if (std::isnan(z)) return;
    sum += w * z, weight += w;
  };
  add(0, 0, (1 - a) * (1 - b));
  add(1, 0, a * (1 - b));
  add(0, 1, (1 - a) * b);
  add(1, 1, a * b);
  return weight >= 0.5 - 1e-9 ? sum / weight : no_value;
}

std::vector<double> at_nodes(const SurfaceMap& map, const HeightField& field) {
  std::vector<double> z(map.size());
  for (std::size_t n = 0; n < z.size(); ++n)
    z[n] = field.height(map.x0 + double(n % map.nx) * map.dx, map.y0 + double(n / map.nx) * map.dx);
  return z;
}

const HeightField& ground_of(const ParticleHeader& header) {
  return header.ground.empty() ? header.bed : header.ground;
}

Case case_of_run(const RunHeader& header, const std::string& run_path, const std::string& case_file) {
  Case c;
  const bool described = !header.particles.case_text.empty();
  if (described) c = parse_case(header.particles.case_text, run_path + ":case");
  if (!case_file.empty()) {
    const Case other = read_case(case_file);
    LGIW_VALIDATE(other.dimension == header.particles.dimension,
                  case_file + " is a case of " + std::to_string(other.dimension) + " dimensions",
                  "the run has " + std::to_string(header.particles.dimension),
                  "name the case that the run was made from");
    if (!described) {
      c = other;
    } else {
      c.gauges = other.gauges, c.sections = other.sections, c.deposit = other.deposit;
      c.output.arrival_threshold = other.output.arrival_threshold;
    }
  }
  check_inside(header.particles, c.gauges, c.sections);
  return c;
}

std::vector<Station> section_stations(const Section& section, const std::array<double, 3>& origin, double spacing) {
  LGIW_EXPECT(spacing > 0 && section.points.size() >= 2);
  std::vector<Station> stations;
  double start = 0;  // of the present leg, from the first point
  for (std::size_t leg = 0; leg + 1 < section.points.size(); ++leg) {
    const Point2 p = section.points[leg], q = section.points[leg + 1];
    const double length = std::hypot(q[0] - p[0], q[1] - p[1]);
    // Stations lie at whole multiples of the spacing along the whole line.
    for (double k = std::max(0.0, std::ceil(start / spacing - 1e-9));; ++k) {
      const double s = k * spacing - start;
      if (s > length - 1e-9 * spacing) break;
      const double a = std::max(0.0, s) / length;
      stations.push_back({k * spacing, p[0] + a * (q[0] - p[0]) - origin[0], p[1] + a * (q[1] - p[1]) - origin[1]});
    }
    start += length;
  }
  const Point2 last = section.points.back();
  stations.push_back({start, last[0] - origin[0], last[1] - origin[1]});
  return stations;
}

}  // namespace lgiw
