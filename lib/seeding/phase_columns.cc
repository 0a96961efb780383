#include "seeding/phase_columns.hh"

#include <algorithm>
#include <cmath>
#include <limits>

#include "seeding/initial_state.hh"

namespace lgiw {

namespace {

/// Heights at which the vertical line through x enters and leaves the polygon, ascending. A vertex counts with the edge
/// on its right, so that neighbouring polygons share no column.
void crossings(const std::vector<Point2>& polygon, double x, std::vector<double>& heights) {
  heights.clear();
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Point2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    if ((a[0] <= x) == (b[0] <= x)) continue;
    heights.push_back(a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0]));
  }
  std::sort(heights.begin(), heights.end());
}

bool rectilinear(const std::vector<Point2>& polygon) {
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Point2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    if (a[0] != b[0] && a[1] != b[1]) return false;
  }
  return true;
}

/// Takes [low, high] out of the stretches.
void cut_out(std::vector<PhaseInterval>& stretches, double low, double high) {
  const std::size_t count = stretches.size();
  for (std::size_t k = 0; k < count; ++k) {
    if (stretches[k].high <= low || stretches[k].low >= high) continue;
    PhaseInterval above = stretches[k];
    above.low = high;
    stretches[k].high = low;
    if (above.high > above.low) stretches.push_back(above);
  }
  std::erase_if(stretches, [](const PhaseInterval& w) { return w.high <= w.low; });
}

}  // namespace

PhaseColumns::PhaseColumns(const Case& c, const TerrainModel& model, const MapCells& cells, const BedSurface& bed,
                           const InitialWave& wave)
    : model_(model), cells_(cells), wave_(wave), highest_(std::numeric_limits<double>::quiet_NaN()) {
  water_weight_ = c.water.density * vertical_gravity(c);
  level_water_ = c.water.present && c.water.bodies.empty();
  level_ = model.still_water_level;
  masked_ = c.terrain.profile.empty() || c.water.seed.has_value();
  raster_soil_ = c.slide.present && c.slide.bodies.empty();

  lattices_.push_back({0, level_water_ ? level_ : bed.lowest()});
  rigid_slide_ = c.slide.motion.has_value();
  if (rigid_slide_)
    for (const auto& polygon : c.slide.bodies) add_outline(polygon, slide_body);
  for (std::size_t k = 0; k < c.bodies.size(); ++k) add_outline(c.bodies[k].outline, int(k));
  if (!rigid_slide_) add_bodies(c.slide.bodies, !level_water_, soil_);
  if (c.water.present) add_bodies(c.water.bodies, !level_water_, water_);

  if (level_water_) highest_ = level_ + wave.highest();
  const auto raise = [&](double z) { highest_ = std::isnan(highest_) ? z : std::max(highest_, z); };
  for (const auto* bodies : {&soil_, &water_})
    for (const Body& body : *bodies)
      for (const Point2& p : body.polygon) raise(p[1]);
  if (raster_soil_)
    for (std::size_t n = 0; n < model.slide.size(); ++n)
      if (model.slide[n]) raise(model.ground.z[n]);
}

void PhaseColumns::add_outline(const std::vector<Point2>& given, int number) {
  Outline outline;
  for (const Point2& p : given) outline.polygon.push_back({p[0] - model_.origin[0], p[1] - model_.origin[2]});
  outline.body = number;
  soil_.push_back({outline.polygon, apart, int(outlines_.size()), outline.rigid()});
  outlines_.push_back(std::move(outline));
}

void PhaseColumns::add_bodies(const std::vector<std::vector<Point2>>& polygons, bool own_lattice,
                              std::vector<Body>& bodies) {
  for (const auto& given : polygons) {
    Body body;
    double x_low = std::numeric_limits<double>::infinity(), z_low = x_low;
    for (const Point2& p : given) {
      body.polygon.push_back({p[0] - model_.origin[0], p[1] - model_.origin[2]});
      x_low = std::min(x_low, body.polygon.back()[0]), z_low = std::min(z_low, body.polygon.back()[1]);
    }
    if (own_lattice && rectilinear(body.polygon)) {
      const double dp = cells_.dp, shift = (x_low - cells_.x_low) / dp;
      double offset = shift - std::round(shift);  // in cells; tiny ones are rounding of the coordinates
      if (std::abs(offset) < 1e-6) offset = 0;
      body.lattice = int(lattices_.size());
      lattices_.push_back({offset * dp, z_low});
    }
    if (&bodies == &soil_ && body.lattice == 0) {
      add_outline(given, -1);
      continue;
    }
    bodies.push_back(std::move(body));
  }
}

bool PhaseColumns::wet_at(double x, double y) const {
  if (!masked_) return true;
  const HeightField& f = model_.ground;
  // The nearest corner that lies below the level decides: the shore is where the interpolated ground passes the level,
  // and a hollow behind a sill stays dry.
  const double u = std::clamp((x - f.x0) / f.dx, 0.0, double(f.nx - 1));
  const double v = f.ny < 2 ? 0.0 : std::clamp((y - f.y0) / f.dx, 0.0, double(f.ny - 1));
  const std::size_t i0 = std::size_t(u), j0 = std::size_t(v);
  double nearest = std::numeric_limits<double>::infinity();
  bool wet = false;
  for (std::size_t j = j0; j <= std::min(j0 + 1, f.ny - 1); ++j)
    for (std::size_t i = i0; i <= std::min(i0 + 1, f.nx - 1); ++i) {
      const double distance = std::hypot(u - double(i), v - double(j));
      if (f.at(i, j) < level_ && distance < nearest) nearest = distance, wet = model_.wet[j * f.nx + i] != 0;
    }
  return wet;
}

void PhaseColumns::at(double x, double y, double bed, std::vector<PhaseInterval>& column, bool with_outlines) const {
  column.clear();
  thread_local std::vector<double> heights;
  thread_local std::vector<PhaseInterval> water, pieces;
  water.clear();

  // Soil first: in overlapping bodies the one given first; what a later one has above and below it is its own.
  const auto add_soil = [&](double low, double high, int lattice, bool rigid, int outline) {
    low = std::max(low, bed);
    if (high <= low) return;
    pieces.assign(1, {Phase::soil, low, high, 0, 0, lattice, rigid, outline});
    for (const PhaseInterval& other : column) cut_out(pieces, other.low, other.high);
    column.insert(column.end(), pieces.begin(), pieces.end());
  };
  for (const Body& body : soil_) {
    if (!with_outlines && body.lattice == apart) continue;
    crossings(body.polygon, x, heights);
    for (std::size_t k = 0; k + 1 < heights.size(); k += 2)
      add_soil(heights[k], heights[k + 1], body.lattice, body.rigid, body.outline);
  }
  if (raster_soil_) add_soil(bed, model_.ground.height(x, y), rigid_slide_ ? apart : 0, rigid_slide_, -1);

  const double surface = level_water_ ? level_ + wave_.elevation(x) : 0;
  if (level_water_ && surface > bed && wet_at(x, y)) water.push_back({Phase::water, bed, surface, surface, 0, 0});
  for (const Body& body : water_) {
    crossings(body.polygon, x, heights);
    for (std::size_t k = 0; k + 1 < heights.size(); k += 2) {
      const double low = std::max(heights[k], bed), high = heights[k + 1];
      if (high <= low) continue;
      cut_out(water, low, high);
      water.push_back({Phase::water, low, high, high, 0, body.lattice});
    }
  }
  for (PhaseInterval& soil : column) {
    for (const PhaseInterval& w : water)
      if (w.low <= soil.high && soil.high < w.high) soil.top_pressure = water_weight_ * (w.surface - soil.high);
  }
  const std::size_t soil_count = column.size();
  for (std::size_t k = 0; k < soil_count; ++k) cut_out(water, column[k].low, column[k].high);
  column.insert(column.end(), water.begin(), water.end());
  std::sort(column.begin(), column.end(), [](const PhaseInterval& a, const PhaseInterval& b) { return a.low < b.low; });
}

}  // namespace lgiw
