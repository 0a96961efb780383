#include "difference_maps.hh"

#include <cmath>
#include <functional>

#include "case/dotted_key.hh"
#include "measure/highest_surface.hh"
#include "measure/slide_history.hh"
#include "measure/surface_sampling.hh"
#include "terrain/geo_output.hh"

namespace lgiw {
namespace {

struct DifferenceMap {
  std::string name, description;
  /// Values of a run at the nodes of `map`, which is in local coordinates of that run; elevations in the case's datum.
  std::function<std::vector<float>(const RunReader&, const SurfaceMap& map)> values;
};

std::vector<float> sampled(const RunHeader& header, const std::vector<float>& raster, const SurfaceMap& map) {
  std::vector<float> values(map.size());
  for (std::size_t n = 0; n < values.size(); ++n)
    values[n] = float(
        sample_surface(header.map, raster, map.x0 + double(n % map.nx) * map.dx, map.y0 + double(n / map.nx) * map.dx) +
        header.particles.origin[2]);
  return values;
}

std::vector<DifferenceMap> maps_of(const RunReader& run, const Case& c) {
  std::vector<DifferenceMap> maps;
  if (run.has_water_surface())
    maps.push_back({"max_elevation", "highest water surface", [=](const RunReader& r, const SurfaceMap& map) {
                      return sampled(r.header(), highest_surface(r, c), map);
                    }});
  if (run.has_soil_surface())
    maps.push_back({"soil_surface", "soil surface at the end", [](const RunReader& r, const SurfaceMap& map) {
                      return sampled(r.header(), r.soil_surface(r.surface_times().size() - 1), map);
                    }});
  if (run.header().particles.counts.soil > 0)
    maps.push_back({"thickness", "thickness of the slide at the end", [=](const RunReader& r, const SurfaceMap& map) {
                      const SlideHistory history(r.header(), r.frame(r.frame_count() - 1), c.deposit.adps_threshold);
                      return history.thickness(map);
                    }});
  return maps;
}

std::string file_of(const std::string& folder, const std::string& map, const RunReader& run, const RunReader& finest) {
  const auto spacing = [](const RunReader& r) { return number_text(r.header().particles.dp); };
  return folder + "/" + map + "_" + spacing(run) + "m_minus_" + spacing(finest) + "m.tif";
}

}  // namespace

std::vector<std::string> difference_map_files(const std::string& folder,
                                              const std::vector<std::unique_ptr<RunReader>>& runs) {
  std::vector<std::string> files;
  for (const DifferenceMap& map : maps_of(*runs.front(), {}))
    for (std::size_t k = 1; k < runs.size(); ++k) files.push_back(file_of(folder, map.name, *runs[k], *runs.front()));
  return files;
}

void write_difference_maps(const std::string& folder, const std::vector<std::unique_ptr<RunReader>>& runs,
                           const Case& c, bool overwrite) {
  const RunHeader& coarsest = runs.back()->header();
  // The coarsest map in the local coordinates of another run.
  const auto nodes = [&](const RunReader& run) {
    SurfaceMap map = coarsest.map;
    map.x0 += coarsest.particles.origin[0] - run.header().particles.origin[0];
    map.y0 += coarsest.particles.origin[1] - run.header().particles.origin[1];
    return map;
  };
  for (const DifferenceMap& map : maps_of(*runs.front(), c)) {
    const bool none_is_zero = map.name == "thickness";
    const std::vector<float> finest = map.values(*runs.front(), nodes(*runs.front()));
    for (std::size_t k = 1; k < runs.size(); ++k) {
      std::vector<float> difference = map.values(*runs[k], nodes(*runs[k]));
      for (std::size_t n = 0; n < difference.size(); ++n) {
        const auto filled = [&](float value) { return none_is_zero && std::isnan(value) ? 0 : value; };
        const bool neither = std::isnan(difference[n]) && std::isnan(finest[n]);
        difference[n] = neither ? NAN : filled(difference[n]) - filled(finest[n]);
      }
      write_geotiff(file_of(folder, map.name, *runs[k], *runs.front()), coarsest.map, difference, coarsest.particles,
                    "m", map.description + ", minus that of the finest run", overwrite);
    }
  }
}

}  // namespace lgiw
