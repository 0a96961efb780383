#include "measure/section_slice.hh"

#include <cmath>
#include <limits>

namespace lgiw {

std::vector<SliceParticle> section_slice(const RunHeader& header, const Frame& frame, const Section& section) {
  const ParticleHeader& p = header.particles;
  const std::size_t n_water = std::size_t(p.counts.water), n = n_water + std::size_t(p.counts.soil);
  const bool flat = p.dimension == 2;
  std::vector<SliceParticle> slice;
  for (std::size_t k = 0; k < n; ++k) {
    if (frame.lost[k]) continue;
    const float *r = frame.points.data() + 3 * k, *v = frame.velocity.data() + 3 * k;
    double before = 0;
    for (std::size_t s = 1; s < section.points.size(); ++s) {
      const double x0 = section.points[s - 1][0] - p.origin[0], y0 = flat ? 0 : section.points[s - 1][1] - p.origin[1];
      const double dx = section.points[s][0] - p.origin[0] - x0;
      const double dy = flat ? 0 : section.points[s][1] - p.origin[1] - y0, length = std::hypot(dx, dy);
      const double along = ((r[0] - x0) * dx + (r[1] - y0) * dy) / length;
      const double beside = ((r[1] - y0) * dx - (r[0] - x0) * dy) / length;
      if (along >= 0 && along < length && (flat || std::abs(beside) <= p.dp)) {
        const bool soil = k >= n_water;
        slice.push_back({before + along, r[2] + p.origin[2], soil, std::hypot(v[0], v[1], v[2]),
                         soil ? double(frame.adps[k]) : std::numeric_limits<double>::quiet_NaN()});
      }
      before += length;
    }
  }
  return slice;
}

}  // namespace lgiw
