// A case from YAML text through terrain and seeding to a running simulation.
#pragma once

#include <memory>
#include <string>

#include "measure/column_surface.hh"
#include "physics/kernel.hh"
#include "seeding/seeding.hh"
#include "solver/diagnostics.hh"
#include "solver/make_setup.hh"

namespace lgiw::test {

struct CaseRun {
  Case c;
  ParticleData data;
  ModelParameters p;
  std::unique_ptr<Simulation> simulation;

  explicit CaseRun(const std::string& yaml) : CaseRun(parse_case(yaml, "case")) {}
  explicit CaseRun(Case the_case) : c(std::move(the_case)) {
    Provenance provenance;
    const TerrainModel model = build_terrain(c, provenance);
    data = seed_particles(c, model);
    p = make_model(c, data);
    simulation = make_cpu_simulation(p, make_particles(c, data), number_type(c.numerics.precision));
  }
  /// Runs to time t and returns the state; a particle that fails ends the test.
  ParticleState at(double t) {
    const StepState st = simulation->advance(t, INT64_MAX);
    if (st.failed_water != UINT32_MAX || st.failed_soil != UINT32_MAX) throw std::runtime_error("the run diverged");
    ParticleState s;
    simulation->download(s);
    return s;
  }
  double level() const { return data.header.still_water_level; }
  double top_of_soil() const {
    double z = -1e30;
    for (std::size_t i = 0; i < data.soil.size(); ++i) z = std::max(z, data.soil.points[3 * i + 2]);
    return z + 0.5 * c.dp;
  }
  /// Water and soil surface at the given x of a 2-D scene.
  ColumnSurfaces surfaces(const ParticleState& s, double x0, double dx, std::size_t n) const {
    std::vector<float> xyz(s.water_x.begin(), s.water_x.end());
    xyz.insert(xyz.end(), s.soil_x.begin(), s.soil_x.end());
    ColumnParticles columns = column_particles(data.header);
    columns.n_water = s.water_x.size() / 3, columns.n_soil = s.soil_x.size() / 3, columns.xyz = xyz.data();
    return column_surfaces(columns, SurfaceMap{n, 1, x0, 0, dx}, data.header.bed);
  }
  double diagnostic(const ParticleState& s, const std::string& name) const {
    for (const auto& [key, value] : diagnose(p, s, simulation->state(), data.header.bed))
      if (key == name) return value;
    throw std::runtime_error("no diagnostic " + name);
  }
  double energy(const ParticleState& s) const {
    return diagnostic(s, "kinetic_energy") + diagnostic(s, "potential_energy");
  }
};

/// Root mean square over particles of value(i) - expected(i), relative to scale.
template <class F>
double relative_rms(std::size_t n, double scale, F&& difference) {
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) sum += std::pow(difference(i), 2);
  return std::sqrt(sum / double(n)) / scale;
}

}  // namespace lgiw::test
