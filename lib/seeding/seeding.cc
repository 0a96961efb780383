#include "seeding/seeding.hh"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <unordered_map>

#include "base/error.hh"
#include "case/attribution.hh"
#include "case/polygon.hh"
#include "seeding/bed_surface.hh"
#include "seeding/initial_state.hh"
#include "seeding/initial_wave.hh"
#include "seeding/outline_filling.hh"
#include "seeding/packing.hh"
#include "seeding/phase_columns.hh"
#include "seeding/walls.hh"

namespace lgiw {

namespace {

constexpr int64_t chunk_columns = 512;                       // one thread's piece of work
constexpr double crowded_before = 0.7, crowded_after = 0.5;  // of dp: too near to others, during packing and after it
constexpr int shallow_layers = 4;                            // a column with fewer is shallow
constexpr double rounding = 1e-6;                            // of dp: coordinates this near to each other are equal
constexpr int64_t most_particles = 2000000000;               // particle numbers are int32 on the devices

/// What a stretch of columns yields; as blocks, or counted only.
struct Yield {
  ParticleBlock water, soil, wall;
  ParticleCounts counts;
  double wall_volume = 0, body_volume = 0;  // body: of a rigid slide of a DEM
  double water_excess = 0;                  // over dp^D a particle
  struct {                                  // of columns with soil
    int64_t low[2] = {INT64_MAX, INT64_MAX}, high[2] = {INT64_MIN, INT64_MIN};
    void add(int64_t i, int64_t j) {
      low[0] = std::min(low[0], i), low[1] = std::min(low[1], j);
      high[0] = std::max(high[0], i), high[1] = std::max(high[1], j);
    }
  } soil_range;
  std::map<int64_t, int64_t> soil_columns;  // number of columns by their number of soil particles
  void clear() { *this = {}; }
};

void append(ParticleBlock& to, const ParticleBlock& from) {
  const auto join = [](auto& a, const auto& b) { a.insert(a.end(), b.begin(), b.end()); };
  join(to.points, from.points), join(to.volume, from.volume), join(to.density, from.density);
  join(to.pressure, from.pressure), join(to.stress, from.stress), join(to.normal, from.normal);
  join(to.kind, from.kind), join(to.velocity, from.velocity), join(to.body, from.body);
}

}  // namespace

struct Seeder::Parts {
  Parts(const Case& given, const TerrainModel& terrain)
      : c(given),
        model(terrain),
        cells(map_cells(given, terrain)),
        bed(given, terrain, cells),
        wave(given, terrain, cells, bed),
        columns(given, terrain, cells, bed, wave),
        walls(given, terrain, cells, bed, columns.lattices()[0].z_phase, columns.highest()),
        filling(cells, bed, columns) {
    read_motions();
    integrate();
    describe();
    if (rigid_ground) fit_slide();
    if (c.water.present && !columns.outlines().empty()) pack_water();
  }

  void read_motions();
  void fit_slide();
  void pack_water();

  void integrate();
  void describe();
  /// A column of a lattice: place, bed, its lowest layer, and the number of layers over which a lift of that one fades.
  struct Column {
    double x, y, foot;
    int64_t lowest;
    double settled;
    bool on_slide = false;  // foot is the top of a rigid slide
  };
  /// A particle of packed water, and the elevation at which its pressure is zero.
  struct PackedWater {
    std::array<double, 3> place;
    double surface;
  };
  int64_t first_above(double z, const Lattice& lattice, bool tie_above) const;
  int64_t lowest_layer(double foot, double top, const Lattice& lattice, int64_t i, int64_t j) const;
  /// Calls visit(interval, column, begin, end) for the runs of lattice points over (i, j).
  template <class Visit>
  void visit_lattices(int64_t i, int64_t j, bool with_outlines, const Visit& visit) const;
  std::array<double, 3> lattice_point(const PhaseInterval& interval, const Column& place, int64_t k) const;
  void place_fluid(int64_t i, int64_t j, bool keep, Yield& yield) const;
  void place_interval(const PhaseInterval& interval, const Column& place, int64_t begin, int64_t end,
                      Yield& yield) const;
  void add_water(std::array<double, 3> p, double still_surface, double stretch, Yield& yield) const;
  void add_soil(const std::array<double, 3>& p, const PhaseInterval& interval, double volume, Yield& yield) const;
  double wave_layers(const PhaseInterval& interval) const;
  double stretch_of(const PhaseInterval& interval, double foot) const;
  void slide_column(int64_t i, int64_t j, bool keep, Yield& yield) const;
  void add_wall(const std::array<double, 3>& p, const std::array<double, 3>& normal, double volume, uint8_t kind,
                uint8_t body, ParticleBlock& block) const;
  uint8_t body_number(const Outline& outline) const;
  void place_outlines(const std::function<void(const ParticleBlock&)>& sink) const;
  double slide_top(double x, double y) const { return std::max(bed.height(x, y), model.ground.height(x, y)); }
  void keep_off(std::array<double, 3>& p, bool on_slide) const;
  void work_on(int64_t begin, int64_t end, bool keep, Yield& yield) const;

  const Case c;
  const TerrainModel& model;
  MapCells cells;
  BedSurface bed;
  InitialWave wave;
  PhaseColumns columns;
  Walls walls;
  OutlineFilling filling;
  std::unordered_map<int64_t, std::vector<PackedWater>> packed;  // by MapCells::index; columns not in it: lattices
  bool rigid_ground = false;                                     // a rigid slide between bed and ground of a DEM
  double slide_scale = 1, body_speed = 0;
  ParticleHeader header;
  SeedingReport report;
  bool pore_water = false;
  double gravity = 0;
};

/// Volumes and depths between the surfaces, by the midpoint rule on a grid finer than the particles.
void Seeder::Parts::integrate() {
  const int parts = cells.two_d ? 16 : 3;
  const double step = cells.dp / parts, area = cells.two_d ? step : step * step;
  double water = 0, soil = 0, moment = 0, deepest = 0, deepest_water = 0;
#pragma omp parallel reduction(+ : water, soil, moment) reduction(max : deepest, deepest_water)
  {
    std::vector<PhaseInterval> column;
#pragma omp for schedule(static)
    for (int64_t j = 0; j < cells.ny; ++j)
      for (int64_t i = 0; i < cells.nx; ++i)
        for (int b = 0; b < (cells.two_d ? 1 : parts); ++b)
          for (int a = 0; a < parts; ++a) {
            const double x = cells.x(i) - 0.5 * cells.dp + (a + 0.5) * step;
            const double y = cells.two_d ? 0.0 : cells.y(j) - 0.5 * cells.dp + (b + 0.5) * step;
            const double foot = bed.height(x, y);
            columns.at(x, y, foot, column);
            for (const PhaseInterval& s : column) {
              const double volume = area * (s.high - s.low);
              if (s.rigid) continue;
              if (s.phase == Phase::water) {
                water += volume;
                deepest = std::max(deepest, s.surface - foot);
                deepest_water = std::max(deepest_water, s.surface - s.low);
              } else {
                soil += volume;
                moment += volume * 0.5 * (s.low + s.high);
              }
            }
          }
  }
  report.water_expected = water, report.soil_expected = soil, report.max_water_depth = deepest;
  report.greatest_depth = deepest_water;
  if (soil > 0 && c.water.present && std::isfinite(model.still_water_level))
    report.slide_drop_height = std::max(0.0, moment / soil - model.still_water_level);
}

void Seeder::Parts::describe() {
  gravity = vertical_gravity(c);
  pore_water =
      c.water.present && c.soil.pore_pressure == PorePressure::hydrostatic && std::isfinite(model.still_water_level);
  report.east_moved = cells.east_moved, report.north_moved = cells.north_moved;

  header.dimension = c.dimension;
  header.dp = c.dp;
  header.origin = model.origin;
  header.crs_wkt = model.crs_wkt;
  header.vertical_datum = c.terrain.vertical_datum;
  header.attribution = terrain_attribution(c.terrain);
  header.still_water_level = c.water.present ? model.still_water_level : std::numeric_limits<double>::quiet_NaN();
  header.sound_speed = water_sound_speed(c, report.max_water_depth, report.slide_drop_height, body_speed);
  header.sides = {c.terrain.west, c.terrain.east, c.terrain.south, c.terrain.north};
  header.absorbing_width = c.terrain.absorbing_width > 0 ? c.terrain.absorbing_width : 10 * c.dp;
  header.bed = model.bed;
  header.ground = model.ground;
  header.case_text = c.text;
  header.initial_velocity = wave.moving() || (c.has_soil() && c.slide.velocity != std::array<double, 3>{0, 0, 0});
  report.body_volumes.assign(header.bodies.size(), 0);
  const double rows = cells.two_d ? 1 : double(cells.ny) * cells.dp;
  for (std::size_t k = 0; k < columns.outlines().size(); ++k)
    for (const TileParticle& t : filling.rigid()[k])
      report.body_volumes[body_number(columns.outlines()[k]) - 1u] += rows * t.area;

  // Horizontally the window; vertically with room for splashes as high again as everything at rest.
  const double thickness = 2 * c.numerics.h_over_dp * c.dp;
  double top = std::max(bed.highest(), walls.side_top());
  if (std::isfinite(columns.highest())) top = std::max(top, columns.highest());
  const double y_low = cells.two_d ? -0.5 * c.dp : cells.y_low, y_high = cells.two_d ? 0.5 * c.dp : cells.y_high();
  header.low = {cells.x_low, y_low, bed.lowest() - thickness};
  header.high = {cells.x_high(), y_high, top + std::max(top - bed.lowest(), 20 * c.dp)};
}

/// Number of the lowest lattice point above z; of a point exactly at z, `tie_above` says on which side it is.
int64_t Seeder::Parts::first_above(double z, const Lattice& lattice, bool tie_above) const {
  const double number = (z - lattice.z_phase) / cells.dp - 0.5, nearest = std::round(number);
  if (std::abs(number - nearest) < rounding) return int64_t(nearest) + (tie_above ? 0 : 1);
  return int64_t(std::ceil(number));
}

/// Number of the lowest lattice point of a column whose bed lies at `foot` and whose highest phase ends at `top`. A
/// column H layers deep gets floor(H + threshold) of them; the thresholds of neighbouring columns are a low-discrepancy
/// sequence (Roberts' R2: the inverse powers of the plastic number) around 1/2, so that their mean is H also over a
/// flat bed. In shallow columns they close in on 1/2: beaches get no particles that stand out of the water.
int64_t Seeder::Parts::lowest_layer(double foot, double top, const Lattice& lattice, int64_t i, int64_t j) const {
  double height = (foot - lattice.z_phase) / cells.dp;
  if (std::abs(height - std::round(height)) < rounding) height = std::round(height);
  const double sequence = 0.5 + 0.7548776662466927 * double(i) + 0.5698402909980532 * double(j);
  const double spread = std::min(1.0, (top - foot) / (shallow_layers * cells.dp));
  const double threshold = 0.5 + spread * (sequence - std::floor(sequence) - 0.5);
  return int64_t(std::ceil(height - threshold));
}

/// Motions of the slide and of the bodies, pivots in local coordinates.
void Seeder::Parts::read_motions() {
  rigid_ground = c.slide.motion && c.slide.bodies.empty();
  if (c.slide.motion) {
    const SlideMotion& given = *c.slide.motion;
    BodyMotion motion = read_motion_csv(c.resolve(given.file), c.dimension);
    motion.name = "slide", motion.heading = given.heading;
    double volume = 0;
    std::array<double, 3> moment{0, 0, 0};
    const auto add = [&](double part, double x, double y, double z) {
      volume += part, moment[0] += part * x, moment[1] += part * y, moment[2] += part * z;
    };
    const double middle = cells.two_d ? 0.0 : 0.5 * (cells.y_low + cells.y_high());
    for (const Outline& outline : columns.outlines()) {
      if (outline.body != slide_body) continue;
      const AreaAndCentroid a = area_and_centroid(outline.polygon);
      add(a.area, a.centroid[0], middle, a.centroid[1]);
    }
    if (rigid_ground)
      for (int64_t j = 0; j < cells.ny; ++j)
        for (int64_t i = 0; i < cells.nx; ++i) {
          const double x = cells.x(i), y = cells.y(j), low = bed.height(x, y), high = slide_top(x, y);
          add(high - low, x, y, 0.5 * (low + high));
        }
    LGIW_VALIDATE(volume > 0, c.where("slide") + ": the slide has no volume", "nothing would move",
                  "check its outline and its failure surface");
    for (std::size_t axis = 0; axis < 3; ++axis)
      motion.pivot[axis] = given.pivot ? (*given.pivot)[axis] - model.origin[axis] : moment[axis] / volume;
    header.bodies.push_back(std::move(motion));
  }
  for (const MovingBody& body : c.bodies) {
    BodyMotion motion = read_motion_csv(c.resolve(body.motion), c.dimension);
    motion.name = body.name;
    const Point2 pivot = body.pivot ? *body.pivot : area_and_centroid(body.outline).centroid;
    motion.pivot = {pivot[0] - model.origin[0], cells.two_d ? 0.0 : 0.5 * (cells.y_low + cells.y_high()),
                    pivot[1] - model.origin[2]};
    header.bodies.push_back(std::move(motion));
  }
  for (const BodyMotion& motion : header.bodies)
    for (std::size_t k = 1; k < motion.time.size(); ++k) {
      const auto &a = motion.displacement[k - 1], &b = motion.displacement[k];
      const double way = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
      body_speed = std::max(body_speed, way / (motion.time[k] - motion.time[k - 1]));
    }
}

/// Number of the outline's body in header.bodies, from 1.
uint8_t Seeder::Parts::body_number(const Outline& outline) const {
  const int first = c.slide.motion ? 2 : 1;
  return uint8_t(outline.body == slide_body ? 1 : first + outline.body);
}

/// The factor between the volume of a rigid slide in its columns and that of the terrain.
void Seeder::Parts::fit_slide() {
  Yield sum;
  for (int64_t j = 0; j < cells.ny; ++j)
    for (int64_t i = 0; i < cells.nx; ++i) slide_column(i, j, false, sum);
  if (model.slide_volume > 0 && sum.body_volume > 0) slide_scale = model.slide_volume / sum.body_volume;
  report.body_volumes[0] = slide_scale * sum.body_volume;
}

void Seeder::Parts::slide_column(int64_t i, int64_t j, bool keep, Yield& yield) const {
  const double dp = cells.dp, half = 0.5 * dp * (1 - 1e-6);
  const auto slope_at = [&](double x, double y) {
    return std::array<double, 2>{(slide_top(x + half, y) - slide_top(x - half, y)) / (2 * half),
                                 cells.two_d ? 0.0 : (slide_top(x, y + half) - slide_top(x, y - half)) / (2 * half)};
  };
  const std::array<int64_t, 2> parts = Walls::subdivision(slope_at(cells.x(i), cells.y(j)), cells.two_d);
  const double step_x = dp / double(parts[0]), step_y = dp / double(parts[1]);
  for (int64_t b = 0; b < parts[1]; ++b)
    for (int64_t a = 0; a < parts[0]; ++a) {
      const double x = cells.x(i) + (double(a) + 0.5) * step_x - 0.5 * dp;
      const double y = cells.two_d ? 0.0 : cells.y(j) + (double(b) + 0.5) * step_y - 0.5 * dp;
      const double foot = bed.height(x, y), top = slide_top(x, y);
      if (top - foot <= rounding * dp) continue;
      const std::array<double, 2> slope = slope_at(x, y);
      const double steepness = std::sqrt(1 + slope[0] * slope[0] + slope[1] * slope[1]), layer = dp * steepness;
      const double area = step_x * (cells.two_d ? 1.0 : step_y);
      const auto layers = std::max<int64_t>(1, int64_t(std::floor((top - foot) / layer + 1 - sliver)));
      for (int64_t k = 0; k < layers; ++k) {
        const double high = top - double(k) * layer, low = k + 1 == layers ? foot : high - layer;
        yield.counts.wall += 1, yield.body_volume += area * (high - low);
        if (keep)
          add_wall({x, y, 0.5 * (low + high)}, {-slope[0] / steepness, -slope[1] / steepness, 1 / steepness},
                   slide_scale * area * (high - low), 2, 1, yield.wall);
      }
    }
}

void Seeder::Parts::add_wall(const std::array<double, 3>& p, const std::array<double, 3>& normal, double volume,
                             uint8_t kind, uint8_t body, ParticleBlock& block) const {
  block.points.insert(block.points.end(), p.begin(), p.end());
  block.normal.insert(block.normal.end(), normal.begin(), normal.end());
  block.volume.push_back(float(volume));
  block.density.push_back(float(c.water.density));
  block.pressure.push_back(0);
  block.kind.push_back(kind);
  if (!header.bodies.empty()) block.body.push_back(body);
}

/// Rigid bodies of outlines, a row of map cells after the other.
void Seeder::Parts::place_outlines(const std::function<void(const ParticleBlock&)>& sink) const {
  for (std::size_t n = 0; n < columns.outlines().size(); ++n) {
    ParticleBlock block;
    block.phase = Phase::wall;
    for (int64_t j = 0; j < cells.ny; ++j)
      for (const TileParticle& t : filling.rigid()[n])
        add_wall({t.place[0], cells.y(j), t.place[1]}, {t.normal[0], 0, t.normal[1]},
                 t.area * (cells.two_d ? 1 : cells.dp), 2, body_number(columns.outlines()[n]), block);
    if (block.size() > 0) sink(block);
  }
}

template <class Visit>
void Seeder::Parts::visit_lattices(int64_t i, int64_t j, bool with_outlines, const Visit& visit) const {
  thread_local std::vector<PhaseInterval> column;
  const bool even = (i + j) % 2 == 0;
  for (std::size_t number = 0; number < columns.lattices().size(); ++number) {
    const Lattice& lattice = columns.lattices()[number];
    Column place{cells.x(i) + lattice.x_offset, cells.y(j), 0, 0, 0};
    place.foot = bed.height(place.x, place.y);
    columns.at(place.x, place.y, place.foot, column, with_outlines);
    if (column.empty()) continue;
    const auto end_of = [&](const PhaseInterval& interval) { return interval.high + wave_layers(interval); };
    // On the bed, or from the first interval on a rigid slide upwards.
    const auto stand = [&](double foot, double top, bool on_it) {
      place.foot = foot;
      place.lowest = on_it ? lowest_layer(foot, top, lattice, i, j) : first_above(foot, lattice, even);
      place.settled =
          double(std::clamp<int64_t>(first_above(top, lattice, even) - place.lowest, shallow_layers, settled_layers));
    };
    double touching = place.foot + rounding * cells.dp;
    const double top = end_of(column.back());
    stand(place.foot, top, column.front().low <= touching);
    for (const PhaseInterval& interval : column) {
      if (interval.rigid && interval.outline < 0) {
        place.on_slide = true;
        touching = interval.high + rounding * cells.dp;
        stand(interval.high, top, true);
      }
      if (interval.lattice != int(number)) continue;
      const int64_t begin =
          interval.low <= touching ? place.lowest : std::max(place.lowest, first_above(interval.low, lattice, even));
      const int64_t end = first_above(end_of(interval), lattice, even);
      if (end > begin) visit(interval, place, begin, end);
    }
  }
}

/// How far the lattice that fills a stretch of water ends from its surface: a whole number of layers from the still
/// water. 0 without a wave.
double Seeder::Parts::wave_layers(const PhaseInterval& interval) const {
  if (!wave.present() || interval.phase != Phase::water) return 0;
  const double still = model.still_water_level;
  return still + cells.dp * std::round((interval.high - still) / cells.dp) - interval.high;
}

/// By which factor heights above the bed grow so that the lattice ends at the wave's surface.
double Seeder::Parts::stretch_of(const PhaseInterval& interval, double foot) const {
  const double filled = interval.high + wave_layers(interval) - foot;
  return filled == interval.high - foot ? 1 : std::clamp((interval.high - foot) / std::max(filled, 1e-300), 0.5, 1.5);
}

std::array<double, 3> Seeder::Parts::lattice_point(const PhaseInterval& interval, const Column& place,
                                                   int64_t k) const {
  const Lattice& lattice = columns.lattices()[std::size_t(interval.lattice)];
  const double lift = 0.5 * cells.dp - (lattice.z_phase + (double(place.lowest) + 0.5) * cells.dp - place.foot);
  const double layer = double(k - place.lowest);
  std::array<double, 3> p{place.x, place.y, lattice.z_phase + (double(k) + 0.5) * cells.dp};
  p[2] += lift * std::max(0.0, 1 - layer / place.settled);
  if (layer < 3) keep_off(p, place.on_slide);
  return p;
}

void Seeder::Parts::place_fluid(int64_t i, int64_t j, bool keep, Yield& yield) const {
  const double dp = cells.dp, volume = cells.two_d ? dp * dp : dp * dp * dp;
  const auto ready = packed.find(cells.index(i, j));
  visit_lattices(i, j, true, [&](const PhaseInterval& interval, const Column& place, int64_t begin, int64_t end) {
    if (interval.phase == Phase::water) {
      if (ready != packed.end()) return;
      yield.water_excess += double(end - begin) * volume * (stretch_of(interval, place.foot) - 1);
    }
    (interval.phase == Phase::water ? yield.counts.water : yield.counts.soil) += end - begin;
    if (keep) place_interval(interval, place, begin, end, yield);
  });
  if (ready != packed.end()) {
    yield.counts.water += int64_t(ready->second.size());
    if (keep)
      for (const PackedWater& w : ready->second) add_water(w.place, w.surface, 1, yield);
  }
  thread_local std::vector<PhaseInterval> column;
  for (const SoilPoint& s : filling.soil(i)) {
    const double own = s.area * (cells.two_d ? 1 : dp);
    yield.counts.soil += 1;
    if (!keep) continue;
    std::array<double, 3> p{s.x, cells.y(j), s.z};
    columns.at(p[0], p[1], bed.height(p[0], p[1]), column);
    const PhaseInterval* around = nullptr;
    for (const PhaseInterval& piece : column)
      if (piece.outline >= 0 && !piece.rigid && piece.low <= p[2] && piece.high >= p[2]) around = &piece;
    LGIW_ASSERT(around);
    keep_off(p, false);
    add_soil(p, *around, own, yield);
  }
}

void Seeder::Parts::place_interval(const PhaseInterval& interval, const Column& place, int64_t begin, int64_t end,
                                   Yield& yield) const {
  const double volume = cells.two_d ? cells.dp * cells.dp : cells.dp * cells.dp * cells.dp;
  const double stretch = interval.phase == Phase::water ? stretch_of(interval, place.foot) : 1;
  for (int64_t k = begin; k < end; ++k) {
    const std::array<double, 3> p = lattice_point(interval, place, k);
    if (interval.phase == Phase::water)
      add_water(p, interval.surface, stretch, yield);
    else
      add_soil(p, interval, volume, yield);
  }
}

void Seeder::Parts::add_water(std::array<double, 3> p, double surface, double stretch, Yield& yield) const {
  const double dp = cells.dp, volume = stretch * (cells.two_d ? dp * dp : dp * dp * dp);
  double head = 0;
  ParticleBlock& block = yield.water;
  if (wave.present()) {
    const double foot = bed.height(p[0], p[1]);
    p[2] = foot + stretch * (p[2] - foot);
    head = wave.pressure_head(p[0], p[2], foot);
    if (header.initial_velocity) {
      const std::array<double, 3> v = wave.velocity(p[0], p[2], foot);
      block.velocity.insert(block.velocity.end(), v.begin(), v.end());
    }
  } else {
    head = std::max(0.0, surface - p[2]);
    if (header.initial_velocity) block.velocity.insert(block.velocity.end(), 3, 0.f);
  }
  block.points.insert(block.points.end(), p.begin(), p.end());
  block.volume.push_back(float(volume));
  const double pressure = c.water.density * gravity * head;
  block.pressure.push_back(float(pressure));
  block.density.push_back(float(water_density(pressure, c.water.density, header.sound_speed)));
}

void Seeder::Parts::add_soil(const std::array<double, 3>& p, const PhaseInterval& interval, double volume,
                             Yield& yield) const {
  ParticleBlock& block = yield.soil;
  block.points.insert(block.points.end(), p.begin(), p.end());
  block.volume.push_back(float(volume));
  const double pore = pore_water ? c.water.density * gravity * std::max(0.0, model.still_water_level - p[2]) : 0.0;
  const std::array<double, 6> stress = k0_stress(c, std::max(0.0, interval.high - p[2]), interval.top_pressure, pore);
  block.stress.insert(block.stress.end(), stress.begin(), stress.end());
  block.pressure.push_back(float(pore));
  block.density.push_back(float(c.soil.density));
  if (header.initial_velocity)
    block.velocity.insert(block.velocity.end(), c.slide.velocity.begin(), c.slide.velocity.end());
}

/// Moves a particle out along the normal of the bed (or of a rigid slide) where it is too near, but not through a side.
void Seeder::Parts::keep_off(std::array<double, 3>& p, bool on_slide) const {
  const double w = 0.5 * cells.dp * (1 - 1e-6);
  const auto top = [&](double x, double y) { return slide_top(x, y); };
  const std::array<double, 2> slope =
      !on_slide ? bed.gradient(p[0], p[1])
                : std::array<double, 2>{(top(p[0] + w, p[1]) - top(p[0] - w, p[1])) / (2 * w),
                                        cells.two_d ? 0.0 : (top(p[0], p[1] + w) - top(p[0], p[1] - w)) / (2 * w)};
  const double height = on_slide ? top(p[0], p[1]) : bed.height(p[0], p[1]);
  const double stretch = std::sqrt(1 + slope[0] * slope[0] + slope[1] * slope[1]);
  const double missing = nearest_wall * cells.dp - (p[2] - height) / stretch;
  if (missing <= 0) return;
  p[0] -= missing * slope[0] / stretch, p[1] -= missing * slope[1] / stretch, p[2] += missing / stretch;
  const double half = 0.5 * cells.dp;
  p[0] = std::clamp(p[0], cells.x_low + half, cells.x_high() - half);
  if (!cells.two_d) p[1] = std::clamp(p[1], cells.y_low + half, cells.y_high() - half);
}

/// Water around the outlines: see Seeder.
void Seeder::Parts::pack_water() {
  const double dp = cells.dp, volume = cells.two_d ? dp * dp : dp * dp * dp;
  const double support = 2 * c.numerics.h_over_dp * dp, margin = (packed_layers + 4) * dp, gap = 0.4 * dp;
  std::vector<uint8_t> near(std::size_t(cells.nx), 0);
  for (const Outline& outline : columns.outlines()) {
    const auto [west, east] = std::minmax_element(outline.polygon.begin(), outline.polygon.end());
    for (int64_t i = 0; i < cells.nx; ++i)
      if (cells.x(i) > (*west)[0] - margin && cells.x(i) < (*east)[0] + margin) near[std::size_t(i)] = 1;
  }
  struct Origin {
    int64_t index;
    double surface;
  };
  std::vector<PackedParticle> particles;
  std::vector<Origin> origins;  // of the water, which comes first
  bool cut_any = false;
  for (int64_t j = 0; j < cells.ny; ++j) {
    double owed = 0;  // cells that outlines have cut and that are not yet made up for
    for (int64_t i = 0; i < cells.nx; ++i) {
      if (!near[std::size_t(i)]) continue;
      visit_lattices(i, j, false, [&](const PhaseInterval& interval, const Column& place, int64_t begin, int64_t end) {
        if (interval.phase != Phase::water) return;
        for (int64_t k = begin; k < end; ++k) {
          PackedParticle p;
          p.place = lattice_point(interval, place, k);
          p.volume = volume;
          const Point2 at{p.place[0], p.place[2]};
          double left = 1, distance = HUGE_VAL;
          for (const Outline& outline : columns.outlines()) {
            distance = std::min(distance, nearest_boundary(outline.polygon, at).distance);
            left -= area_and_centroid(clipped(outline.polygon, {at[0] - 0.5 * dp, at[1] - 0.5 * dp},
                                              {at[0] + 0.5 * dp, at[1] + 0.5 * dp}))
                        .area /
                    (dp * dp);
          }
          if (left < rounding) continue;
          if (left < 1 - rounding) {
            cut_any = true;
            owed += left;
            if (owed < 0.5) continue;
            owed -= 1;
          }
          p.moves = distance < packed_layers * dp;
          p.level = interval.surface - p.place[2] < support;
          particles.push_back(p);
          origins.push_back({cells.index(i, j), interval.surface});
        }
      });
    }
  }
  if (!cut_any) return;  // the lattice fits

  std::vector<WallParticle> wall;
  for (int64_t n = 0; n < cells.count(); ++n) {
    const auto [i, j] = cells.cell(n);
    const int64_t inside = std::clamp<int64_t>(i, 0, cells.nx - 1);
    if (!near[std::size_t(inside)]) continue;
    wall.clear();
    walls.column(i, j, wall);
    for (const WallParticle& w : wall) particles.push_back({w.position, w.volume});
    if (!cells.inside(i, j)) continue;
    for (const SoilPoint& s : filling.soil(i))
      particles.push_back({{s.x, cells.y(j), s.z}, s.area * (cells.two_d ? 1 : dp)});
  }
  for (const auto& tiles : filling.rigid())
    for (const TileParticle& t : tiles)
      for (int64_t j = 0; j < cells.ny; ++j)
        particles.push_back({{t.place[0], cells.y(j), t.place[1]}, t.area * (cells.two_d ? 1 : dp)});

  const auto keep_out = [&](std::array<double, 3>& p) {
    for (const Outline& outline : columns.outlines()) {
      const Point2 at{p[0], p[2]};
      const NearestBoundary nearest = nearest_boundary(outline.polygon, at);
      const bool inside = contains(outline.polygon, at);
      if (!inside && nearest.distance >= gap) continue;
      if (nearest.distance <= 1e-9 * dp) continue;  // on the line: the next sweep tells which way
      const double way = (inside ? nearest.distance + gap : nearest.distance - gap) / nearest.distance;
      p[0] += way * (nearest.point[0] - at[0]), p[2] += way * (nearest.point[1] - at[1]);
    }
    keep_off(p, false);
    const double half = 0.5 * dp;
    p[0] = std::clamp(p[0], cells.x_low + half, cells.x_high() - half);
    if (!cells.two_d) p[1] = std::clamp(p[1], cells.y_low + half, cells.y_high() - half);
  };
  for (std::size_t k = 0; k < origins.size(); ++k)
    if (particles[k].moves) keep_out(particles[k].place);
  // In corners between body and bed there may be one too many: those go, and the others close up.
  for (const double distance : {crowded_before * dp, crowded_after * dp}) {
    pack(particles, dp, cells.two_d, keep_out);
    const std::vector<uint8_t> crowded = nearer_than(particles, distance);
    std::size_t kept = 0, water = 0;
    for (std::size_t k = 0; k < particles.size(); ++k) {
      if (crowded[k]) continue;
      if (k < origins.size()) origins[kept] = origins[k], ++water;
      particles[kept++] = particles[k];
    }
    particles.resize(kept), origins.resize(water);
  }

  for (int64_t n = 0; n < cells.count(); ++n) {
    const auto [i, j] = cells.cell(n);
    if (cells.inside(i, j) && near[std::size_t(i)]) packed[n];  // without water, too
  }
  for (std::size_t k = 0; k < origins.size(); ++k)
    packed[origins[k].index].push_back({particles[k].place, origins[k].surface});
}

void Seeder::Parts::work_on(int64_t begin, int64_t end, bool keep, Yield& yield) const {
  thread_local std::vector<WallParticle> wall;
  for (int64_t n = begin; n < end; ++n) {
    const auto [i, j] = cells.cell(n);
    const int64_t soil_before = yield.counts.soil;
    if (cells.inside(i, j)) place_fluid(i, j, keep, yield);
    if (yield.counts.soil > soil_before) {
      ++yield.soil_columns[yield.counts.soil - soil_before];
      yield.soil_range.add(i, j);
    }
    if (rigid_ground && cells.inside(i, j)) slide_column(i, j, keep, yield);
    wall.clear();
    yield.counts.wall_left_out += walls.column(i, j, wall);
    yield.counts.wall += int64_t(wall.size());
    for (const WallParticle& w : wall) {
      yield.wall_volume += w.volume;
      if (keep) add_wall(w.position, w.normal, w.volume, w.kind, 0, yield.wall);
    }
  }
}

Seeder::Seeder(const Case& c, const TerrainModel& model) : parts_(std::make_unique<Parts>(c, model)) {}
Seeder::~Seeder() = default;

const SeedingReport& Seeder::report() const { return parts_->report; }
const ParticleHeader& Seeder::header() const { return parts_->header; }

const SeedingReport& Seeder::count(const std::function<void(double)>& progress) {
  const int64_t columns = parts_->cells.count(), chunks = (columns + chunk_columns - 1) / chunk_columns;
  const int64_t round = std::max<int64_t>(1, chunks / 50);
  Yield sum;
  for (int64_t first = 0; first < chunks; first += round) {
    const int64_t last = std::min(chunks, first + round);
    std::vector<Yield> yields(
        static_cast<std::size_t>(last - first));  // summed in order, so that volumes do not depend on threads
#pragma omp parallel for schedule(dynamic)
    for (int64_t k = first; k < last; ++k)
      parts_->work_on(k * chunk_columns, std::min(columns, (k + 1) * chunk_columns), false,
                      yields[std::size_t(k - first)]);
    for (const Yield& y : yields) {
      sum.counts.water += y.counts.water, sum.counts.soil += y.counts.soil, sum.counts.wall += y.counts.wall;
      sum.counts.wall_left_out += y.counts.wall_left_out, sum.wall_volume += y.wall_volume;
      sum.water_excess += y.water_excess;
      for (const auto& [particles, number] : y.soil_columns) sum.soil_columns[particles] += number;
      if (!y.soil_columns.empty()) {
        sum.soil_range.add(y.soil_range.low[0], y.soil_range.low[1]);
        sum.soil_range.add(y.soil_range.high[0], y.soil_range.high[1]);
      }
    }
    if (progress) progress(double(last) / double(chunks));
  }
  const double dp = parts_->c.dp, volume = std::pow(dp, parts_->c.dimension);
  for (const auto& tiles : parts_->filling.rigid()) sum.counts.wall += parts_->cells.ny * int64_t(tiles.size());
  parts_->header.counts = parts_->report.counts = sum.counts;
  parts_->report.wall_volume = sum.wall_volume;
  parts_->report.water_volume = double(sum.counts.water) * volume + sum.water_excess;
  parts_->report.soil_volume = double(sum.counts.soil) * volume;  // all of one mass, however outlines share them out
  int64_t columns_with_soil = 0, thinner = 0;
  for (const auto& [particles, number] : sum.soil_columns) columns_with_soil += number;
  for (const auto& [particles, number] : sum.soil_columns) {
    parts_->report.median_soil_column = double(particles);
    if (2 * (thinner += number) >= columns_with_soil) break;
  }
  if (columns_with_soil > 0) {
    parts_->report.greatest_soil_column = double(sum.soil_columns.rbegin()->first);
    const int64_t widest =
        std::max(sum.soil_range.high[0] - sum.soil_range.low[0], sum.soil_range.high[1] - sum.soil_range.low[1]);
    parts_->report.soil_extent = dp * std::max(double(widest), parts_->report.greatest_soil_column);
  }
  LGIW_VALIDATE(sum.counts.total() <= most_particles, "too many particles: " + std::to_string(sum.counts.total()),
                "at most 2e9 can be numbered", "Choose a larger dp or a smaller terrain.window.");
  return parts_->report;
}

void Seeder::seed(const std::function<void(const ParticleBlock&)>& sink, const std::function<void(double)>& progress,
                  int64_t tile_columns) const {
  const int64_t columns = parts_->cells.count();
  for (int64_t begin = 0; begin < columns; begin += tile_columns) {
    const int64_t end = std::min(columns, begin + tile_columns);
    const int64_t chunks = (end - begin + chunk_columns - 1) / chunk_columns;
    std::vector<Yield> yields(static_cast<std::size_t>(chunks));
#pragma omp parallel for schedule(dynamic)
    for (int64_t k = 0; k < chunks; ++k)
      parts_->work_on(begin + k * chunk_columns, std::min(end, begin + (k + 1) * chunk_columns), true,
                      yields[std::size_t(k)]);
    for (ParticleBlock Yield::*phase : {&Yield::water, &Yield::soil, &Yield::wall}) {
      ParticleBlock tile;
      tile.phase = phase == &Yield::water ? Phase::water : phase == &Yield::soil ? Phase::soil : Phase::wall;
      for (Yield& y : yields) append(tile, y.*phase), y.*phase = {};
      if (tile.size() > 0) sink(tile);
    }
    if (progress) progress(double(end) / double(columns));
  }
  parts_->place_outlines(sink);
}

ParticleData seed_particles(const Case& c, const TerrainModel& model) {
  Seeder seeder(c, model);
  seeder.count();
  ParticleData data;
  data.header = seeder.header();
  data.water.phase = Phase::water, data.soil.phase = Phase::soil, data.wall.phase = Phase::wall;
  seeder.seed([&](const ParticleBlock& block) {
    append(block.phase == Phase::water ? data.water : block.phase == Phase::soil ? data.soil : data.wall, block);
  });
  return data;
}

}  // namespace lgiw
