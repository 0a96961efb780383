#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.hh"
#include "terrain/analytic_terrain.hh"
#include "terrain/raster_source.hh"
#include "terrain/reservoir.hh"
#include "terrain/slide_body.hh"
#include "terrain/terrain_model.hh"

namespace lgiw {
namespace {

using namespace detail;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
/// A terrain of more than a million nodes and of more than this many for each cell of its sources is mostly
/// interpolation.
constexpr double max_nodes_per_cell = 1000, max_nodes_of_any_source = 1e6;

struct Mosaic {
  std::vector<RasterSource> sources;
  OGRSpatialReference crs;
  RasterGrid grid;  // case coordinates, source resolution
};

Mosaic open_sources(const Case& c, TerrainModel& model, Provenance& provenance) {
  Mosaic mosaic;
  for (const TerrainSource& source : c.terrain.sources)
    mosaic.sources.emplace_back(c.resolve(source.file),
                                at_key(c, "terrain.sources") + "terrain source '" + source.file + "'", provenance);
  mosaic.crs =
      c.terrain.crs.empty() ? case_crs_from_source(mosaic.sources[0]) : case_crs_from_text(c, mosaic.sources[0]);
  for (RasterSource& source : mosaic.sources) {
    if (!source.has_crs() && c.terrain.crs.empty()) case_crs_from_source(source);  // throws: only named CRS are assumed
    if (source.place(mosaic.crs))
      model.notes.push_back(source.what() + " names no CRS: taken to be in " + c.terrain.crs);
  }
  return mosaic;
}

/// Window and spacing: nodes on the finest source's cell centres where they can be.
RasterGrid choose_grid(const Case& c, const Mosaic& mosaic, TerrainModel& model) {
  Extent common{-HUGE_VAL, -HUGE_VAL, HUGE_VAL, HUGE_VAL}, all{HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  const RasterSource* finest = &mosaic.sources[0];
  double cells = 0;
  for (const RasterSource& source : mosaic.sources) {
    const Extent& e = source.extent();
    // A local map that is spliced into what lies below it narrows nothing.
    const bool within = e[0] >= common[0] && e[1] >= common[1] && e[2] <= common[2] && e[3] <= common[3];
    const bool first = &source == &mosaic.sources[0];
    for (int k = 0; k < 2; ++k) {
      if (first || !within) common[k] = std::max(common[k], e[k]), common[k + 2] = std::min(common[k + 2], e[k + 2]);
      all[k] = std::min(all[k], e[k]), all[k + 2] = std::max(all[k + 2], e[k + 2]);
    }
    if (source.pixel() <= finest->pixel() * (1 + 1e-9)) finest = &source;
    cells += source.cells();
  }
  const double pixel = finest->pixel();
  Extent window = common;
  if (c.terrain.window) {
    window = *c.terrain.window;
    LGIW_VALIDATE(window[0] < window[2] && window[1] < window[3],
                  at_key(c, "terrain.window") + "terrain.window is empty", describe(window),
                  "give it as [x_min, y_min, x_max, y_max]");
    const double slack = 1e-6 * pixel;
    LGIW_VALIDATE(window[0] >= all[0] - slack && window[1] >= all[1] - slack && window[2] <= all[2] + slack &&
                      window[3] <= all[3] + slack,
                  at_key(c, "terrain.window") + "terrain.window reaches outside the terrain sources",
                  "it is " + describe(window) + "; they cover " + describe(all), "cut the window or add a source");
  } else {
    LGIW_VALIDATE(window[0] < window[2] && window[1] < window[3],
                  at_key(c, "terrain.window") + "the terrain sources have no common extent",
                  "together they cover " + describe(all), "set terrain.window or check their CRS");
  }
  // A reprojected or turned source leaves no cells to keep: the window's corner is as good a start as any.
  const auto anchor =
      finest->is_aligned() ? finest->anchor() : std::array{window[0] + 0.5 * pixel, window[1] + 0.5 * pixel};
  RasterGrid grid;
  for (double factor = 1;; ++factor) {
    grid.dx = factor * pixel;
    double first[2], count[2];
    for (int k = 0; k < 2; ++k) {
      const double start = anchor[k] + std::ceil((window[k] - anchor[k]) / pixel - 1e-6) * pixel;
      const double fine = std::floor((window[k + 2] - start) / pixel + 1e-6) + 1;
      first[k] = start + 0.5 * (factor - 1) * pixel;  // in the middle of factor x factor cells
      count[k] = std::floor(fine / factor);
    }
    LGIW_VALIDATE(count[0] >= 3 && count[1] >= 3,
                  at_key(c, "terrain.window") + "the terrain has fewer than 3 x 3 nodes",
                  describe(window) + text(" at a spacing of %g m", grid.dx), "enlarge terrain.window");
    const double nodes = count[0] * count[1];
    if (nodes <= double(max_cells)) {
      LGIW_VALIDATE(nodes <= std::max(max_nodes_of_any_source, max_nodes_per_cell * cells),
                    at_key(c, "terrain.window") +
                        text("the terrain would have %.4g x %.4g nodes of %g m", count[0], count[1], grid.dx),
                    text("%s is so fine; its sources have %.0f cells in all", finest->what().c_str(), cells),
                    "cut it with terrain.window to what the finest source is for, or resample that source");
      grid.nx = std::size_t(count[0]), grid.ny = std::size_t(count[1]);
      grid.x0 = first[0], grid.y0 = first[1];
      if (factor > 1)
        model.notes.push_back(text("terrain: cells of %g m averaged to %g m while reading", pixel, grid.dx));
      return grid;
    }
    LGIW_VALIDATE((factor + 1) * pixel <= c.dp,
                  at_key(c, "terrain.window") +
                      text("the terrain window has %.4g x %.4g cells of %g m", count[0], count[1], grid.dx),
                  text("more than %lld do not fit into memory, and particle_spacing is %g m",
                       static_cast<long long>(max_cells), c.dp),
                  "cut it with terrain.window or choose a larger particle_spacing");
    // Straight to the factor that the numbers ask for, and no further than dp allows.
    const double wanted = std::floor(factor * std::sqrt(nodes / double(max_cells)));
    factor = std::max(factor, std::min(wanted, std::floor(c.dp / pixel)) - 1);
  }
}

double smooth_step(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// Splices the sources: later ones on top, blended over the width of the seam by distance to their edge or voids.
std::vector<double> splice(const Case& c, Mosaic& mosaic, TerrainModel& model) {
  const RasterGrid& grid = mosaic.grid;
  std::vector<double> z(grid.size(), nan);
  double coarsest = 0;
  for (std::size_t s = 0; s < mosaic.sources.size(); ++s) {
    RasterSource& source = mosaic.sources[s];
    const TerrainSource& wish = c.terrain.sources[s];
    const double threshold =
        c.terrain.spike_threshold > 0 ? c.terrain.spike_threshold : 3 * source.pixel() * std::numbers::sqrt3;
    Spikes spikes;
    std::vector<double> layer = source.sample(grid, threshold, c.terrain.remove_spikes, &spikes, nan);
    if (wish.vertical_shift != 0)
      for (double& value : layer) value += wish.vertical_shift;
    if (spikes.count > 0) {
      model.spikes += spikes.count;
      if (c.terrain.remove_spikes) model.spikes_removed += spikes.count;
      model.notes.push_back(source.what() +
                            text(": %lld spike%s of more than %.4g m, the worst %+.4g m at %.8g, %.8g; %s",
                                 static_cast<long long>(spikes.count), spikes.count == 1 ? "" : "s", spikes.threshold,
                                 spikes.worst, spikes.x, spikes.y, c.terrain.remove_spikes ? "removed" : "kept"));
    }
    coarsest = std::max(coarsest, source.pixel());
    if (s == 0) {
      z = std::move(layer);
      continue;
    }
    const double blend = (wish.blend > 0 ? wish.blend : 4 * coarsest) / grid.dx;
    const std::vector<float> distance = distance_to_void(layer, grid, blend + 1);
    for (std::size_t k = 0; k < z.size(); ++k) {
      if (std::isnan(layer[k])) continue;
      const double weight = std::isnan(z[k]) ? 1 : smooth_step(distance[k] / (blend + 1));
      z[k] = weight * layer[k] + (weight < 1 ? (1 - weight) * z[k] : 0);
    }
  }
  return z;
}

/// Fills or refuses what the sources leave empty. Voids are holes; what is connected to the window's edge is border.
void handle_voids(const Case& c, const RasterGrid& grid, std::vector<double>& z, TerrainModel& model) {
  std::vector<uint8_t> missing(z.size()), edge(z.size(), 0);
  int64_t count = 0;
  for (std::size_t k = 0; k < z.size(); ++k) {
    missing[k] = std::isnan(z[k]);
    count += missing[k];
    const std::size_t i = k % grid.nx, j = k / grid.nx;
    edge[k] = missing[k] && (i == 0 || j == 0 || i + 1 == grid.nx || j + 1 == grid.ny);
  }
  if (count == 0) return;
  LGIW_VALIDATE(count < int64_t(z.size()),
                at_key(c, "terrain.window") + "the terrain window holds no elevations at all",
                text("all of its %lld cells are no-data or NaN", static_cast<long long>(count)),
                "move terrain.window or check the source");
  const std::vector<uint8_t> border = connected_to(edge, missing, grid.nx, grid.ny, 8);
  const int64_t border_count = std::count(border.begin(), border.end(), 1), holes = count - border_count;
  if (c.terrain.fill_voids) {
    fill_voids(z, grid);
    model.voids_filled = count;
    model.notes.push_back(text("terrain: %lld void cells filled, %lld of them at the border of the window",
                               static_cast<long long>(count), static_cast<long long>(border_count)));
    return;
  }
  // The first of a kind, reading like a map: from the north-west.
  const auto first = [&](bool at_border) {
    for (std::size_t j = grid.ny; j-- > 0;)
      for (std::size_t i = 0; i < grid.nx; ++i)
        if (const std::size_t k = j * grid.nx + i; missing[k] && (border[k] != 0) == at_border)
          return text("the first at %.8g, %.8g", grid.x0 + double(i) * grid.dx, grid.y0 + double(j) * grid.dx);
    return std::string();
  };
  LGIW_VALIDATE(
      border_count > 0,
      at_key(c, "terrain.window") + text("the terrain window has %lld void cells", static_cast<long long>(holes)),
      first(false), "fill them with terrain.voids: fill, or add a source below");
  const CellRange r = largest_valid_range(z, grid.nx, grid.ny);
  const int digits = std::max(0, 1 - int(std::floor(std::log10(grid.dx))));
  // A third of a cell wide of the outermost centres, so that the numbers as printed choose exactly these cells.
  const double margin = grid.dx / 3;
  throw InputError(
      at_key(c, "terrain.window") +
          text("the terrain window touches the no-data border of the sources (%lld cells there, %lld voids inside)",
               static_cast<long long>(border_count), static_cast<long long>(holes)),
      first(true),
      text("set terrain.window to the largest one without, [%.*f, %.*f, %.*f, %.*f], or terrain.voids: fill", digits,
           grid.x0 + double(r.i0) * grid.dx - margin, digits, grid.y0 + double(r.j0) * grid.dx - margin, digits,
           grid.x0 + double(r.i1) * grid.dx + margin, digits, grid.y0 + double(r.j1) * grid.dx + margin));
}

HeightField local_field(const RasterGrid& grid, std::vector<double> z, const std::array<double, 3>& origin) {
  HeightField field;
  field.nx = grid.nx, field.ny = grid.ny, field.dx = grid.dx;
  field.x0 = grid.x0 - origin[0], field.y0 = grid.y0 - origin[1];
  field.z = std::move(z);
  return field;
}

/// Means of k x k cells; the cells left over in the east and north are dropped.
template <class T>
std::vector<double> block_means(const std::vector<T>& cells, const RasterGrid& from, const RasterGrid& to,
                                std::size_t k) {
  std::vector<double> means(to.size(), 0);
  for (std::size_t j = 0; j < to.ny * k; ++j)
    for (std::size_t i = 0; i < to.nx * k; ++i) means[(j / k) * to.nx + i / k] += double(cells[j * from.nx + i]);
  for (double& mean : means) mean /= double(k * k);
  return means;
}

TerrainModel build_raster_terrain(const Case& c, Provenance& provenance) {
  LGIW_VALIDATE(c.dimension == 3, "terrain.sources in a 2-D case", "a plane-strain scene takes its bed from a profile",
                "give terrain.profile, or set dimension: 3");
  const QuietGdal quiet;
  TerrainModel model;
  Mosaic mosaic = open_sources(c, model, provenance);
  mosaic.grid = choose_grid(c, mosaic, model);
  const RasterGrid& cells = mosaic.grid;
  std::vector<double> z = splice(c, mosaic, model);
  handle_voids(c, cells, z, model);
  const HeightField ground = local_field(cells, std::move(z), {0, 0, 0});  // in case coordinates still

  model.still_water_level = nan;
  std::vector<uint8_t> wet(cells.size(), 0);
  if (c.water.present) {
    model.still_water_level = c.water.level;
    Reservoir reservoir = fill_reservoir(ground, c);
    model.reservoir_area = reservoir.area;
    model.reservoir_volume = reservoir.volume;
    model.max_water_depth = reservoir.max_depth;
    wet = std::move(reservoir.wet);
  }
  SlideBody slide;
  if (c.slide.present) {
    LGIW_VALIDATE(c.slide.bodies.empty(), at_key(c, "slide.bodies") + "slide.bodies with terrain.sources",
                  "bodies in (x, z) belong to terrain.profile", "give slide.polygon and a failure surface");
    slide = make_slide(c, ground, mosaic.crs, provenance, model.notes);
    model.slide_volume = slide.volume;
  } else {
    slide.bed = ground.z;
    slide.mask.assign(cells.size(), 0);
  }

  model.crs_wkt = wkt_of(mosaic.crs);
  model.origin = {std::floor(cells.x0), std::floor(cells.y0), 0};
  const auto k = std::size_t(std::max(1.0, std::floor(c.dp / cells.dx * (1 + 1e-9))));
  if (k == 1) {
    model.ground = local_field(cells, ground.z, model.origin);
    model.bed = local_field(cells, std::move(slide.bed), model.origin);
    model.wet = std::move(wet);
    model.slide = std::move(slide.mask);
  } else {
    const double middle = 0.5 * double(k - 1) * cells.dx;
    const RasterGrid nodes(cells.nx / k, cells.ny / k, cells.x0 + middle, cells.y0 + middle, double(k) * cells.dx);
    LGIW_VALIDATE(
        nodes.nx >= 3 && nodes.ny >= 3,
        at_key(c, "terrain.window") + text("the terrain has fewer than 3 x 3 nodes at particle_spacing %g m", c.dp),
        text("the window is %g x %g m wide", double(cells.nx) * cells.dx, double(cells.ny) * cells.dx),
        "enlarge terrain.window or choose a smaller particle_spacing");
    model.ground = local_field(nodes, block_means(ground.z, cells, nodes, k), model.origin);
    model.bed = local_field(nodes, block_means(slide.bed, cells, nodes, k), model.origin);
    const std::vector<double> wet_part = block_means(wet, cells, nodes, k);
    const std::vector<double> slide_part = block_means(slide.mask, cells, nodes, k);
    model.wet.resize(nodes.size()), model.slide.resize(nodes.size());
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      model.wet[n] = wet_part[n] >= 0.5 && model.ground.z[n] < model.still_water_level;
      model.slide[n] = slide_part[n] > 0;  // the mean thickness of its cells, so that the volume is kept
    }
  }
  model.domain = {model.ground.x0, model.ground.y0, model.ground.x_max(), model.ground.y_max()};
  return model;
}

}  // namespace

TerrainModel build_terrain(const Case& c, Provenance& provenance) {
  LGIW_VALIDATE(c.dp > 0, "particle_spacing is not positive", text("it is %g", c.dp), "give the particle spacing in m");
  LGIW_VALIDATE(
      c.terrain.sources.empty() != c.terrain.profile.empty(),
      c.terrain.sources.empty() ? "the case has no terrain" : "the case has both terrain.sources and terrain.profile",
      "the bed comes either from rasters or from a profile", "give one of terrain.sources and terrain.profile");
  return c.terrain.sources.empty() ? build_analytic_terrain(c) : build_raster_terrain(c, provenance);
}

std::vector<uint8_t> reachable_nodes(const TerrainModel& model, const Case& c) {
  const HeightField& ground = model.ground;
  std::vector<uint8_t> reached(ground.z.size(), 0);
  if (!c.terrain.profile.empty()) {
    std::fill(reached.begin(), reached.end(), 1);
    return reached;
  }
  double top = -HUGE_VAL;
  std::size_t top_node = 0;
  for (std::size_t k = 0; k < reached.size(); ++k)
    if (model.slide[k] && ground.z[k] > top) top = ground.z[k], top_node = k;
  const bool soil = top > -HUGE_VAL;

  std::vector<uint8_t> allowed(reached.size());
  if (c.water.present) {
    const double drop = soil ? top - model.still_water_level : 0;
    const double allowance =
        c.terrain.runup_allowance > 0 ? c.terrain.runup_allowance : std::max(10 * c.dp, 0.5 * drop);
    for (std::size_t k = 0; k < allowed.size(); ++k) allowed[k] = ground.z[k] < model.still_water_level + allowance;
    reached = connected_to(model.wet, allowed, ground.nx, ground.ny, 8);
  }
  if (soil) {
    const double fall = std::tan(c.terrain.reach_angle * std::numbers::pi / 180) * ground.dx;
    const double top_i = double(top_node % ground.nx), top_j = double(top_node / ground.nx);
    for (std::size_t k = 0; k < allowed.size(); ++k) {
      const double distance = std::hypot(double(k % ground.nx) - top_i, double(k / ground.nx) - top_j);
      allowed[k] = ground.z[k] <= top - fall * distance;
    }
    const std::vector<uint8_t> by_soil = connected_to(model.slide, allowed, ground.nx, ground.ny, 8);
    for (std::size_t k = 0; k < reached.size(); ++k) reached[k] |= by_soil[k];
  }

  // Widened by the support of the kernel: a square, first along rows, then along columns.
  const auto radius = int64_t(std::ceil((2 * c.numerics.h_over_dp + 1) * c.dp / ground.dx));
  const auto widen = [&](std::size_t lines, std::size_t length, std::size_t line_step, std::size_t step) {
    std::vector<uint8_t> widened(reached.size(), 0);
    for (std::size_t line = 0; line < lines; ++line) {
      int64_t last = std::numeric_limits<int64_t>::min() / 2;  // reached node behind, then ahead
      for (int64_t n = 0; n < int64_t(length); ++n) {
        const std::size_t k = line * line_step + std::size_t(n) * step;
        if (reached[k]) last = n;
        widened[k] = n - last <= radius;
      }
      last = std::numeric_limits<int64_t>::max() / 2;
      for (int64_t n = int64_t(length); n-- > 0;) {
        const std::size_t k = line * line_step + std::size_t(n) * step;
        if (reached[k]) last = n;
        widened[k] |= last - n <= radius;
      }
    }
    reached = std::move(widened);
  };
  widen(ground.ny, ground.nx, ground.nx, 1);
  widen(ground.nx, ground.ny, 1, ground.nx);
  return reached;
}

}  // namespace lgiw
