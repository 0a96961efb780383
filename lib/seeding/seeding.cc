#include "seeding/seeding.hh"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/error.hh"
#include "seeding/bed_surface.hh"
#include "seeding/initial_state.hh"
#include "seeding/phase_columns.hh"
#include "seeding/walls.hh"

namespace lgiw {

namespace {

constexpr int64_t chunk_columns = 512;          // one thread's piece of work
constexpr int shallow_layers = 4;               // a column with fewer is shallow
constexpr double rounding = 1e-6;               // of dp: coordinates this near to each other are equal
constexpr int64_t most_particles = 2000000000;  // particle numbers are int32 on the devices

/// What a stretch of columns yields; as blocks, or counted only.
struct Yield {
  ParticleBlock water, soil, wall;
  ParticleCounts counts;
  double wall_volume = 0;
  void clear() { *this = {}; }
};

void append(ParticleBlock& to, const ParticleBlock& from) {
  const auto join = [](auto& a, const auto& b) { a.insert(a.end(), b.begin(), b.end()); };
  join(to.points, from.points), join(to.volume, from.volume), join(to.density, from.density);
  join(to.pressure, from.pressure), join(to.stress, from.stress), join(to.normal, from.normal);
  join(to.kind, from.kind);
}

}  // namespace

struct Seeder::Parts {
  Parts(const Case& given, const TerrainModel& terrain)
      : c(given),
        model(terrain),
        cells(map_cells(given, terrain)),
        bed(given, terrain, cells),
        columns(given, terrain, cells, bed),
        walls(given, terrain, cells, bed, columns.lattices()[0].z_phase, columns.highest()) {
    integrate();
    describe();
  }

  void integrate();
  void describe();
  /// A column of a lattice: place, bed, its lowest layer, and the number of layers over which a lift of that one fades.
  struct Column {
    double x, y, foot;
    int64_t lowest;
    double settled;
  };
  int64_t first_above(double z, const Lattice& lattice, bool tie_above) const;
  int64_t lowest_layer(double foot, double top, const Lattice& lattice, int64_t i, int64_t j) const;
  void place_fluid(int64_t i, int64_t j, bool keep, Yield& yield) const;
  void place_interval(const PhaseInterval& interval, const Column& place, int64_t begin, int64_t end,
                      Yield& yield) const;
  void keep_off_bed(std::array<double, 3>& p) const;
  void work_on(int64_t begin, int64_t end, bool keep, Yield& yield) const;

  const Case c;
  const TerrainModel& model;
  MapCells cells;
  BedSurface bed;
  PhaseColumns columns;
  Walls walls;
  ParticleHeader header;
  SeedingReport report;
  bool pore_water = false;
  double gravity = 0;
};

/// Volumes and depths between the surfaces, by the midpoint rule on a grid finer than the particles.
void Seeder::Parts::integrate() {
  const int parts = cells.two_d ? 16 : 3;
  const double step = cells.dp / parts, area = cells.two_d ? step : step * step;
  double water = 0, soil = 0, moment = 0, deepest = 0;
#pragma omp parallel reduction(+ : water, soil, moment) reduction(max : deepest)
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
              if (s.phase == Phase::water) {
                water += volume;
                deepest = std::max(deepest, s.surface - foot);
              } else {
                soil += volume;
                moment += volume * 0.5 * (s.low + s.high);
              }
            }
          }
  }
  report.water_expected = water, report.soil_expected = soil, report.max_water_depth = deepest;
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
  header.still_water_level = c.water.present ? model.still_water_level : std::numeric_limits<double>::quiet_NaN();
  header.sound_speed = water_sound_speed(c, report.max_water_depth, report.slide_drop_height);
  header.sides = {c.terrain.west, c.terrain.east, c.terrain.south, c.terrain.north};
  header.absorbing_width = c.terrain.absorbing_width > 0 ? c.terrain.absorbing_width : 10 * c.dp;
  header.bed = model.bed;
  header.ground = model.ground;
  header.case_text = c.text;

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

void Seeder::Parts::place_fluid(int64_t i, int64_t j, bool keep, Yield& yield) const {
  thread_local std::vector<PhaseInterval> column;
  const bool even = (i + j) % 2 == 0;
  for (std::size_t number = 0; number < columns.lattices().size(); ++number) {
    const Lattice& lattice = columns.lattices()[number];
    Column place{cells.x(i) + lattice.x_offset, cells.y(j), 0, 0, 0};
    place.foot = bed.height(place.x, place.y);
    columns.at(place.x, place.y, place.foot, column);
    if (column.empty()) continue;
    const double top = column.back().high, touching = place.foot + rounding * cells.dp;
    const bool on_bed = column.front().low <= touching;
    place.lowest = on_bed ? lowest_layer(place.foot, top, lattice, i, j) : first_above(place.foot, lattice, even);
    place.settled =
        double(std::clamp<int64_t>(first_above(top, lattice, even) - place.lowest, shallow_layers, settled_layers));
    for (const PhaseInterval& interval : column) {
      if (interval.lattice != int(number)) continue;
      const int64_t begin =
          interval.low <= touching ? place.lowest : std::max(place.lowest, first_above(interval.low, lattice, even));
      const int64_t end = first_above(interval.high, lattice, even);
      if (end <= begin) continue;
      (interval.phase == Phase::water ? yield.counts.water : yield.counts.soil) += end - begin;
      if (keep) place_interval(interval, place, begin, end, yield);
    }
  }
}

void Seeder::Parts::place_interval(const PhaseInterval& interval, const Column& place, int64_t begin, int64_t end,
                                   Yield& yield) const {
  const Lattice& lattice = columns.lattices()[std::size_t(interval.lattice)];
  const bool water = interval.phase == Phase::water;
  const double dp = cells.dp, volume = cells.two_d ? dp * dp : dp * dp * dp;
  const double lift = 0.5 * dp - (lattice.z_phase + (double(place.lowest) + 0.5) * dp - place.foot);
  ParticleBlock& block = water ? yield.water : yield.soil;
  for (int64_t k = begin; k < end; ++k) {
    const double layer = double(k - place.lowest);
    std::array<double, 3> p{place.x, place.y, lattice.z_phase + (double(k) + 0.5) * dp};
    p[2] += lift * std::max(0.0, 1 - layer / place.settled);
    if (layer < 3) keep_off_bed(p);
    block.points.insert(block.points.end(), p.begin(), p.end());
    block.volume.push_back(float(volume));
    if (water) {
      const double pressure = c.water.density * gravity * std::max(0.0, interval.surface - p[2]);
      block.pressure.push_back(float(pressure));
      block.density.push_back(float(water_density(pressure, c.water.density, header.sound_speed)));
    } else {
      const double pore = pore_water ? c.water.density * gravity * std::max(0.0, model.still_water_level - p[2]) : 0.0;
      const std::array<double, 6> stress =
          k0_stress(c, std::max(0.0, interval.high - p[2]), interval.top_pressure, pore);
      block.stress.insert(block.stress.end(), stress.begin(), stress.end());
      block.pressure.push_back(float(pore));
      block.density.push_back(float(c.soil.density));
    }
  }
}

/// Moves a particle out along the bed's normal where it is too near, but not through a side.
void Seeder::Parts::keep_off_bed(std::array<double, 3>& p) const {
  const std::array<double, 2> slope = bed.gradient(p[0], p[1]);
  const double stretch = std::sqrt(1 + slope[0] * slope[0] + slope[1] * slope[1]);
  const double missing = nearest_wall * cells.dp - (p[2] - bed.height(p[0], p[1])) / stretch;
  if (missing <= 0) return;
  p[0] -= missing * slope[0] / stretch, p[1] -= missing * slope[1] / stretch, p[2] += missing / stretch;
  const double half = 0.5 * cells.dp;
  p[0] = std::clamp(p[0], cells.x_low + half, cells.x_high() - half);
  if (!cells.two_d) p[1] = std::clamp(p[1], cells.y_low + half, cells.y_high() - half);
}

void Seeder::Parts::work_on(int64_t begin, int64_t end, bool keep, Yield& yield) const {
  thread_local std::vector<WallParticle> wall;
  for (int64_t n = begin; n < end; ++n) {
    const auto [i, j] = cells.cell(n);
    if (cells.inside(i, j)) place_fluid(i, j, keep, yield);
    wall.clear();
    yield.counts.wall_left_out += walls.column(i, j, wall);
    yield.counts.wall += int64_t(wall.size());
    for (const WallParticle& w : wall) {
      yield.wall_volume += w.volume;
      if (!keep) continue;
      yield.wall.points.insert(yield.wall.points.end(), w.position.begin(), w.position.end());
      yield.wall.normal.insert(yield.wall.normal.end(), w.normal.begin(), w.normal.end());
      yield.wall.volume.push_back(float(w.volume));
      yield.wall.density.push_back(float(c.water.density));
      yield.wall.pressure.push_back(0);
      yield.wall.kind.push_back(w.kind);
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
    }
    if (progress) progress(double(last) / double(chunks));
  }
  const double dp = parts_->c.dp, volume = std::pow(dp, parts_->c.dimension);
  parts_->header.counts = parts_->report.counts = sum.counts;
  parts_->report.wall_volume = sum.wall_volume;
  parts_->report.water_volume = double(sum.counts.water) * volume;
  parts_->report.soil_volume = double(sum.counts.soil) * volume;
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
