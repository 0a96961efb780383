#include "measure/section_profiles.hh"

#include <algorithm>
#include <cmath>

#include "measure/column_surface.hh"

namespace lgiw {
namespace {

/// A soil particle as seen from a station: its squared distance in plan, its height and strain.
struct Neighbour {
  double rho2, z, adps;
};

/// Shepard mean of the strain at height z of the station's vertical; NaN where no particle is in reach. Wendland C2 but
/// for its factor, which cancels.
double strain_at(const std::vector<Neighbour>& neighbours, double z, double reach) {
  double sum = 0, weight = 0;
  for (const Neighbour& n : neighbours) {
    const double u = std::sqrt(n.rho2 + (z - n.z) * (z - n.z)) / reach;
    if (u >= 1) continue;
    const double t = (1 - u) * (1 - u), w = t * t * (4 * u + 1);
    sum += w * n.adps, weight += w;
  }
  return weight > 0 ? sum / weight : no_value;
}

/// The slip line at one station, local z; searched upwards from the bed (or the lowest soil) to the soil surface.
double slip_elevation(const std::vector<Neighbour>& neighbours, double bed, double surface, double threshold,
                      double dp) {
  if (std::isnan(surface) || neighbours.empty()) return no_value;
  const double reach = 3 * dp, step = dp / 4;
  double bottom = bed;
  if (std::isnan(bottom)) {
    bottom = infinite;
    for (const Neighbour& n : neighbours) bottom = std::min(bottom, n.z);
  }
  double below = strain_at(neighbours, bottom, reach);
  if (below >= threshold) return bottom;
  for (double z = bottom + step; z <= surface; z += step) {
    const double here = strain_at(neighbours, z, reach);
    if (here >= threshold) return below < threshold ? z - step + step * (threshold - below) / (here - below) : z;
    below = here;
  }
  return no_value;
}

}  // namespace

std::vector<SectionProfile> section_profiles(const RunHeader& header, const Frame& frame,
                                             const std::vector<Section>& sections, double adps_threshold) {
  const ParticleHeader& p = header.particles;
  ColumnParticles particles = column_particles(p, frame);
  particles.velocity = nullptr;  // of no use here
  const ColumnSurfaces surfaces = column_surfaces(particles, header.map, p.bed);
  const bool flat = p.dimension == 2;
  const double reach = 3 * p.dp;

  std::vector<SectionProfile> profiles;
  for (const Section& section : sections) {
    SectionProfile profile;
    profile.stations = section_stations(section, p.origin, header.map.dx);
    const std::size_t n = profile.stations.size();
    for (auto* line : {&profile.ground, &profile.bed, &profile.soil, &profile.water, &profile.slip})
      line->assign(n, no_value);

    double x0 = infinite, x1 = -infinite, y0 = infinite, y1 = -infinite;
    for (const Station& s : profile.stations) {
      x0 = std::min(x0, s.x), x1 = std::max(x1, s.x);
      y0 = std::min(y0, s.y), y1 = std::max(y1, s.y);
    }
    std::vector<std::size_t> near_line;  // soil particles in the box around the line
    for (std::size_t k = particles.n_water; k < particles.n_water + particles.n_soil; ++k) {
      const float* r = frame.points.data() + 3 * k;
      if (frame.lost[k] || r[0] < x0 - reach || r[0] > x1 + reach) continue;
      if (!flat && (r[1] < y0 - reach || r[1] > y1 + reach)) continue;
      near_line.push_back(k);
    }
#pragma omp parallel for schedule(dynamic)
    for (std::size_t i = 0; i < n; ++i) {
      const Station& s = profile.stations[i];
      std::vector<Neighbour> neighbours;
      for (std::size_t k : near_line) {
        const float* r = frame.points.data() + 3 * k;
        const double dx = r[0] - s.x, dy = flat ? 0 : r[1] - s.y, rho2 = dx * dx + dy * dy;
        if (rho2 < reach * reach) neighbours.push_back({rho2, r[2], frame.adps[k]});
      }
      const double bed = p.bed.empty() ? no_value : p.bed.height(s.x, s.y);
      const double soil = surfaces.soil.empty() ? no_value : sample_surface(header.map, surfaces.soil, s.x, s.y);
      profile.bed[i] = bed + p.origin[2];
      profile.soil[i] = soil + p.origin[2];
      profile.water[i] = sample_surface(header.map, surfaces.water, s.x, s.y) + p.origin[2];
      profile.slip[i] = slip_elevation(neighbours, bed, soil, adps_threshold, p.dp) + p.origin[2];
      if (!ground_of(p).empty()) profile.ground[i] = ground_of(p).height(s.x, s.y) + p.origin[2];
    }
    profiles.push_back(std::move(profile));
  }
  return profiles;
}

}  // namespace lgiw
