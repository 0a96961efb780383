#include "solver/output_plan.hh"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace lgiw {
namespace {

/// s between surface rasters, from which maxima are taken: what is thrown up falls g t^2 / 2, 0.011 dp, in half of
/// it, and the crest of a deep-water wave 6 dp long, the shortest that particles carry, by 1.2 %. Anything shorter
/// only costs time.
double sampling_interval(const Case& c, double dp) {
  return 0.3 * std::sqrt(dp / std::hypot(c.gravity[0], c.gravity[1], c.gravity[2]));
}

std::string amount(double bytes) {
  std::ostringstream s;
  s.precision(3);
  s << bytes / (bytes < 1e9 ? 1e6 : 1e9) << (bytes < 1e9 ? " MB" : " GB");
  return s.str();
}

}  // namespace

OutputSchedule output_schedule(const Case& c, double dp) {
  const double frames = c.output.frame_interval;
  const double wanted = c.output.surface_interval > 0 ? c.output.surface_interval : sampling_interval(c, dp);
  OutputSchedule schedule{};
  schedule.per_frame = std::max<int64_t>(1, std::llround(frames / wanted));
  schedule.interval = frames / double(schedule.per_frame);
  schedule.last = std::max<int64_t>(1, int64_t(std::ceil(c.output.end_time / schedule.interval - 1e-6)));
  return schedule;
}

SurfaceMap output_map(const Case& c, const ParticleHeader& h) {
  SurfaceMap m;
  m.dx = c.output.map_spacing > 0 ? c.output.map_spacing : h.dp;
  const auto cells = [&](double low, double high) {
    return std::max<std::size_t>(1, std::size_t((high - low) / m.dx + 1e-9));
  };
  m.nx = cells(h.low[0], h.high[0]);
  m.x0 = h.low[0] + 0.5 * m.dx;
  m.ny = h.dimension == 3 ? cells(h.low[1], h.high[1]) : 1;
  m.y0 = h.dimension == 3 ? h.low[1] + 0.5 * m.dx : 0;
  return m;
}

OutputSize output_size(const Case& c, const ParticleHeader& header, double moving_bytes) {
  const OutputSchedule schedule = output_schedule(c, header.dp);
  const SurfaceMap map = output_map(c, header);
  // A checkpoint holds the maxima, too, and what the water was at first.
  const double maxima = double(map.size()) * 6 * sizeof(float);
  return {run_file_bytes(header.counts, map, schedule.frames(), schedule.last + 1), 3 * (moving_bytes + maxima)};
}

std::string space_warning(const OutputSize& size, double available, const std::string& folder) {
  if (size.total() <= available) return "";
  return "the run file takes up to " + amount(size.run) + ", its checkpoints " + amount(size.checkpoints) +
         " while it runs, and " + folder + " has " + amount(available) +
         " for it: make room, or raise output.frame_interval";
}

}  // namespace lgiw
