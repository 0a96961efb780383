#include "wave_maps.hh"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.hh"
#include "measure/shore.hh"
#include "measure/surface_sampling.hh"
#include "terrain/geo_output.hh"

namespace lgiw {
namespace {

std::string in_folder(const std::string& folder, const std::string& name) { return folder + "/" + name; }

std::string arrival_name(double threshold) {
  char text[60];
  std::snprintf(text, sizeof text, "arrival_%gm.tif", threshold);
  return text;
}

/// The pieces of the shore, each half-way to the points before and behind, with the run-up of the point in its middle.
std::vector<VectorFeature> shore_pieces(const ParticleHeader& header,
                                        const std::vector<std::vector<ShorePoint>>& lines) {
  std::vector<VectorFeature> pieces;
  for (std::size_t l = 0; l < lines.size(); ++l)
    for (std::size_t k = 0; k < lines[l].size(); ++k) {
      const ShorePoint& p = lines[l][k];
      const double z = header.still_water_level;
      VectorFeature piece;
      const auto half_way = [&](const ShorePoint& q) { piece.points.push_back({(p.x + q.x) / 2, (p.y + q.y) / 2, z}); };
      if (k > 0) half_way(lines[l][k - 1]);
      piece.points.push_back({p.x, p.y, z});
      if (k + 1 < lines[l].size()) half_way(lines[l][k + 1]);
      piece.attributes = {{"shore", int64_t(l + 1)},
                          {"distance_m", p.distance},
                          {"runup_m", p.runup},
                          {"elevation_m", p.runup_elevation + header.origin[2]}};
      pieces.push_back(std::move(piece));
    }
  return pieces;
}

}  // namespace

std::vector<std::string> wave_map_files(const std::string& folder, const std::vector<double>& thresholds) {
  std::vector<std::string> files;
  for (const char* name :
       {"ground.tif", "max_elevation.tif", "max_depth.tif", "max_speed.tif", "arrival.tif", "hazard.tif", "wave.gpkg"})
    files.push_back(in_folder(folder, name));
  for (double threshold : thresholds) files.push_back(in_folder(folder, arrival_name(threshold)));
  return files;
}

double write_wave_maps(const std::string& folder, const RunReader& run, const HighestSurface& highest,
                       const ArrivalMap& arrivals, const std::vector<GaugeSeries>& gauges,
                       const std::vector<GaugePeaks>& peaks, bool overwrite) {
  const RunHeader& header = run.header();
  const ParticleHeader& particles = header.particles;
  const GeoReference where(particles);
  const RasterGrid grid(header.map);
  const auto raster = [&](const std::string& name, const std::vector<float>& values, const char* unit,
                          const std::string& description) {
    write_geotiff(in_folder(folder, name), grid, values, where, unit, description, overwrite);
  };

  const std::vector<float>& elevation = highest.elevation();
  std::vector<float> depth = run.maximum("depth");
  for (std::size_t n = 0; n < depth.size(); ++n)
    if (std::isnan(elevation[n])) depth[n] = float(no_value);  // wet before the wave alone
  std::vector<float> in_datum = elevation;
  for (float& z : in_datum) z = float(z + particles.origin[2]);
  std::vector<float> ground;
  for (double z : at_nodes(header.map, ground_of(particles))) ground.push_back(float(z + particles.origin[2]));
  const std::string datum = particles.vertical_datum.empty() ? "" : " above " + particles.vertical_datum;
  raster("ground.tif", ground, "m", "ground before the slide" + datum);
  raster("max_elevation.tif", in_datum, "m", "highest water surface" + datum);
  raster("max_depth.tif", depth, "m", "largest water depth");
  raster("max_speed.tif", run.maximum("speed"), "m/s", "largest speed of the water");
  for (std::size_t t = 0; t < arrivals.thresholds().size(); ++t) {
    char text[80];
    std::snprintf(text, sizeof text, "arrival of a change of %g m", arrivals.thresholds()[t]);
    raster(t == 0 ? "arrival.tif" : arrival_name(arrivals.thresholds()[t]), arrivals.arrival(t), "s", text);
  }

  const std::vector<uint8_t>& lake = highest.lake();
  const std::vector<uint8_t> hazard = hazard_classes(header, lake, elevation, depth);
  raster("hazard.tif", std::vector<float>(hazard.begin(), hazard.end()), "class",
         "1 below 1 m, 2 from 1 m to 3 m, 3 above 3 m: wave height in the lake, flow depth on land");

  GeoPackage package(in_folder(folder, "wave.gpkg"), where, overwrite);
  std::vector<VectorFeature> points;
  for (std::size_t g = 0; g < gauges.size(); ++g) {
    const GaugeSeries& s = gauges[g];
    points.push_back({{{s.gauge.x - particles.origin[0], s.gauge.y - particles.origin[1], s.bed - particles.origin[2]}},
                      {{"name", s.gauge.name},
                       {"surface", std::string(s.surface == GaugeSurface::soil ? "soil" : "water")},
                       {"max_elevation_m", peaks[g].max_elevation},
                       {"max_height_m", peaks[g].max_height},
                       {"time_of_max_s", peaks[g].time_of_max},
                       {"arrival_s", peaks[g].arrival.front()}}});
  }
  package.add_points("gauges", points);

  const auto lines = shorelines(header, lake);
  std::vector<VectorFeature> shore;
  for (std::size_t l = 0; l < lines.size(); ++l) {
    VectorFeature line;
    for (const auto& p : lines[l]) line.points.push_back({p[0], p[1], particles.still_water_level});
    line.attributes = {{"shore", int64_t(l + 1)}};
    shore.push_back(std::move(line));
  }
  package.add_lines("shoreline", shore);
  const auto runup = shore_runup(header, lines, elevation);
  package.add_lines("shore_runup", shore_pieces(particles, runup));

  std::vector<uint8_t> flooded(lake.size());
  for (std::size_t n = 0; n < lake.size(); ++n) flooded[n] = lake[n] ? 1 : std::isnan(elevation[n]) ? 0 : 2;
  package.add_polygons("inundation", grid, flooded, {"lake at rest", "inundated land"});
  package.add_polygons("hazard", grid, hazard, {"below 1 m", "1 m to 3 m", "above 3 m"});
  package.commit();

  double top = no_value;
  for (const auto& line : runup)
    for (const ShorePoint& p : line)
      if (!std::isnan(p.runup) && !(p.runup <= top)) top = p.runup;
  return top;
}

}  // namespace lgiw
