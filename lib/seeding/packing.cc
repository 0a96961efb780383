#include "seeding/packing.hh"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "physics/kernel.hh"

namespace lgiw {

namespace {

constexpr int sweeps = 50;
constexpr double relaxation = 0.25, largest_shift = 0.1;  // times h2 grad; of dp
constexpr double reach_margin = 1.5;                      // of dp: how far a particle may get between two searches

/// Indices of the particles in the order of x (then y, z, index).
std::vector<std::size_t> sorted_by_x(const std::vector<PackedParticle>& particles) {
  std::vector<std::size_t> order(particles.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return particles[a].place != particles[b].place ? particles[a].place < particles[b].place : a < b;
  });
  return order;
}

}  // namespace

void pack(std::vector<PackedParticle>& particles, double dp, bool two_d,
          const std::function<void(std::array<double, 3>&)>& keep_out) {
  const double h = 1.5 * dp, reach = 2 * h + reach_margin * dp;
  const std::size_t n = particles.size();
  std::vector<std::size_t> moving;
  for (std::size_t k = 0; k < n; ++k)
    if (particles[k].moves) moving.push_back(k);
  if (moving.empty()) return;

  // Neighbours from one search: shifts are a fraction of dp. In the order of x those within reach are a run.
  const std::vector<std::size_t> order = sorted_by_x(particles);
  std::vector<std::vector<uint32_t>> neighbours(moving.size());
#pragma omp parallel for schedule(dynamic, 64)
  for (std::size_t m = 0; m < moving.size(); ++m) {
    const auto& p = particles[moving[m]].place;
    auto candidate = std::lower_bound(order.begin(), order.end(), p[0] - reach,
                                      [&](std::size_t k, double x) { return particles[k].place[0] < x; });
    for (; candidate != order.end() && particles[*candidate].place[0] <= p[0] + reach; ++candidate) {
      const auto& q = particles[*candidate].place;
      const double dx = p[0] - q[0], dy = p[1] - q[1], dz = p[2] - q[2];
      if (*candidate != moving[m] && dx * dx + dy * dy + dz * dz < reach * reach)
        neighbours[m].push_back(uint32_t(*candidate));
    }
  }

  const auto gradient = [two_d, plane = Wendland<double, 2>(h), space = Wendland<double, 3>(h)](double r) {
    return two_d ? plane.gradient(r) : space.gradient(r);  // W'/r
  };
  std::vector<std::array<double, 3>> next(moving.size());
  for (int sweep = 0; sweep < sweeps; ++sweep) {
#pragma omp parallel for schedule(static)
    for (std::size_t m = 0; m < moving.size(); ++m) {
      const PackedParticle& me = particles[moving[m]];
      std::array<double, 3> shift{0, 0, 0};
      for (const uint32_t k : neighbours[m]) {
        const PackedParticle& other = particles[k];
        const std::array<double, 3> r{me.place[0] - other.place[0], me.place[1] - other.place[1],
                                      me.place[2] - other.place[2]};
        const double distance = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
        const double weight = -relaxation * h * h * gradient(distance) * other.volume;
        for (std::size_t axis = 0; axis < 3; ++axis) shift[axis] += weight * r[axis];
      }
      if (two_d) shift[1] = 0;
      if (me.level) shift[2] = 0;
      const double length = std::sqrt(shift[0] * shift[0] + shift[1] * shift[1] + shift[2] * shift[2]);
      const double scale = std::min(1.0, largest_shift * dp / std::max(length, 1e-300));
      next[m] = me.place;
      for (std::size_t axis = 0; axis < 3; ++axis) next[m][axis] += scale * shift[axis];
      keep_out(next[m]);
    }
    for (std::size_t m = 0; m < moving.size(); ++m) particles[moving[m]].place = next[m];
  }
}

std::vector<uint8_t> nearer_than(const std::vector<PackedParticle>& particles, double distance) {
  const std::vector<std::size_t> order = sorted_by_x(particles);
  std::vector<uint8_t> marked(particles.size(), 0);
  for (std::size_t a = 0; a < order.size(); ++a)
    for (std::size_t b = a + 1; b < order.size(); ++b) {
      const PackedParticle &p = particles[order[a]], &q = particles[order[b]];
      if (q.place[0] - p.place[0] >= distance) break;
      if ((!p.moves && !q.moves) || marked[order[a]] || marked[order[b]]) continue;
      if (std::hypot(p.place[0] - q.place[0], p.place[1] - q.place[1], p.place[2] - q.place[2]) >= distance) continue;
      marked[q.moves ? order[b] : order[a]] = 1;
    }
  return marked;
}

}  // namespace lgiw
