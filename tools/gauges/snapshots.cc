#include "snapshots.hh"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include "measure/column_surface.hh"
#include "terrain/geo_output.hh"

namespace lgiw {
namespace {

std::string text_of(const char* pattern, double value) {
  char text[60];
  std::snprintf(text, sizeof text, pattern, value);
  return text;
}

/// "12s" of each frame, with as many decimals as the frames of the run are apart, whichever of them are asked for.
std::vector<std::string> time_names(const RunReader& run, const std::vector<std::size_t>& frames) {
  const auto named = [&](std::size_t k, int decimals) {
    char text[60];
    std::snprintf(text, sizeof text, "%.*fs", decimals, run.frame_time(k));
    return std::string(text);
  };
  double interval = std::numeric_limits<double>::infinity();
  for (std::size_t k = 1; k < run.frame_count(); ++k)
    interval = std::min(interval, run.frame_time(k) - run.frame_time(k - 1));
  const auto exact = [&](int decimals) {
    for (std::size_t k = 0; k < run.frame_count(); ++k)
      if (!(std::abs(std::stod(named(k, decimals)) - run.frame_time(k)) <= 0.1 * interval)) return false;
    return true;
  };
  int decimals = 0;
  while (decimals < 9 && !exact(decimals)) ++decimals;
  std::vector<std::string> names;
  for (std::size_t k : frames) names.push_back(named(k, decimals));
  return names;
}

std::string wave_file(const std::string& folder, const std::string& time) { return folder + "/wave_" + time + ".tif"; }
std::string speed_file(const std::string& folder, const std::string& time) {
  return folder + "/slide_speed_" + time + ".tif";
}

}  // namespace

std::vector<std::string> snapshot_files(const std::string& folder, const RunReader& run,
                                        const std::vector<std::size_t>& frames) {
  std::vector<std::string> files;
  for (const std::string& time : time_names(run, frames)) {
    files.push_back(wave_file(folder, time));
    if (run.has_soil_surface()) files.push_back(speed_file(folder, time));
  }
  return files;
}

void write_snapshots(const std::string& folder, const RunReader& run, const std::vector<std::size_t>& frames,
                     bool overwrite) {
  if (frames.empty()) return;
  const RunHeader& header = run.header();
  const ParticleHeader& particles = header.particles;
  const GeoReference where(particles);
  const RasterGrid grid(header.map);
  const std::vector<std::string> times = time_names(run, frames);
  ColumnSurfaceMap surfaces_of(header.map, particles.bed);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const Frame frame = run.frame(frames[k]);
    const ColumnSurfaces& surfaces = surfaces_of(column_particles(particles, frame));
    const std::string at = text_of(" at %.2f s", frame.time);
    std::vector<float> height = surfaces.water;
    for (float& z : height) z = float(z - particles.still_water_level);
    write_geotiff(wave_file(folder, times[k]), grid, height, where, "m",
                  "water surface above the still water level" + at, overwrite);
    if (run.has_soil_surface())
      write_geotiff(speed_file(folder, times[k]), grid, surfaces.soil_speed, where, "m/s", "speed of the slide" + at,
                    overwrite);
  }
}

}  // namespace lgiw
