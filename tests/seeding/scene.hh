// Small scenes from YAML text, and what the tests ask of their particles.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "case/case.hh"
#include "seeding/seeding.hh"

namespace lgiw::test {

struct Scene {
  Case c;
  TerrainModel model;
  ParticleData data;
};

inline Scene seeded(const std::string& yaml) {
  Scene scene;
  scene.c = parse_case(yaml, "scene");
  Provenance provenance;
  scene.model = build_terrain(scene.c, provenance);
  scene.data = seed_particles(scene.c, scene.model);
  return scene;
}

using Point = std::array<double, 3>;

inline Point point(const ParticleBlock& block, std::size_t n) {
  return {block.points[3 * n], block.points[3 * n + 1], block.points[3 * n + 2]};
}

inline double distance(const Point& a, const Point& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

inline double sum(const std::vector<float>& values) {
  double total = 0;
  for (float v : values) total += v;
  return total;
}

/// Points in cubes of edge `reach`, for visiting those within `reach` of a place.
class Neighbours {
 public:
  explicit Neighbours(double reach) : reach_(reach) {}

  void add(const ParticleBlock& block) {
    for (std::size_t n = 0; n < block.size(); ++n) {
      const Point p = point(block, n);
      cells_[key(cell(p[0]), cell(p[1]), cell(p[2]))].push_back({p, block.volume[n]});
    }
  }
  /// visit(place, volume, distance) for all points within reach of p, p itself included.
  template <class Visit>
  void visit(const Point& p, const Visit& visit) const {
    for (int64_t i = cell(p[0]) - 1; i <= cell(p[0]) + 1; ++i)
      for (int64_t j = cell(p[1]) - 1; j <= cell(p[1]) + 1; ++j)
        for (int64_t k = cell(p[2]) - 1; k <= cell(p[2]) + 1; ++k) {
          const auto found = cells_.find(key(i, j, k));
          if (found == cells_.end()) continue;
          for (const Entry& e : found->second)
            if (const double r = distance(p, e.place); r < reach_) visit(e.place, e.volume, r);
        }
  }
  /// Distance from p to the nearest other point; `reach` where there is none within.
  double nearest(const Point& p) const {
    double least = reach_;
    visit(p, [&](const Point&, double, double r) { least = r > 0 ? std::min(least, r) : least; });
    return least;
  }

 private:
  struct Entry {
    Point place;
    double volume;
  };
  int64_t cell(double x) const { return int64_t(std::floor(x / reach_)); }
  static int64_t key(int64_t i, int64_t j, int64_t k) {
    return ((i + (1 << 20)) << 42) + ((j + (1 << 20)) << 21) + k + (1 << 20);
  }
  double reach_;
  std::unordered_map<int64_t, std::vector<Entry>> cells_;
};

/// Least distance between any two of the particles of the blocks.
inline double nearest_pair(const ParticleBlock& from, const Neighbours& to, double reach) {
  double least = reach;
  for (std::size_t n = 0; n < from.size(); ++n) least = std::min(least, to.nearest(point(from, n)));
  return least;
}

/// Wendland C2 in plane strain, physics.md section 1.
inline double wendland_2d(double r, double h) {
  const double q = r / h, b = 1 - 0.5 * q;
  return q >= 2 ? 0 : 7 / (4 * M_PI * h * h) * b * b * b * b * (2 * q + 1);
}

}  // namespace lgiw::test
