// What can be said about the error of a run without a reference: residuals of the conserved quantities,
// compressibility, phases that pass through each other, and how many particles resolve the slide and the water.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "files/particle_file.hh"
#include "solver/diagnostics.hh"

namespace lgiw {

/// Limits above or below which a run is warned of.
namespace warn_at {
constexpr double slide_particles = 8;      // fewer across the slide's thickness
constexpr double gauge_particles = 4;      // fewer in the water below a gauge
constexpr double mach_number = 0.1;        // density varies with its square: 1 %
constexpr double density_error = 0.01;     // of the 99.9th percentile
constexpr double energy_created = 0.01;    // of the energy released
constexpr double interpenetrating = 0.05;  // of the particles of the smaller phase; a front tears off some grains
}  // namespace warn_at

/// Limits above which a run stops.
namespace stop_at {
constexpr double density_error = 0.2;  // of the 99.9th percentile
}

/// How many particles lie across what matters, at the start: counted in columns of particles one dp wide.
struct Resolution {
  struct GaugeDepth {
    std::string name;
    double particles;
  };
  std::optional<double> slide_median, slide_tenth;  // thickness, vertically: median and 10 % quantile over the columns
  std::optional<double> deepest_water;              // of all columns
  std::vector<GaugeDepth> gauges;                   // the surface gauges that stand in water
};
Resolution resolution_of(const Case& c, const ParticleData& data);

/// Running extremes and last values of a run, by name; kept in its checkpoints.
using Extremes = std::map<std::string, double>;
/// Takes in a row of the diagnostics. For the energies: "energy_created", the largest rise of total_energy above its
/// running minimum, and "energy_released", the largest of the kinetic energy and of the fall of the potential energy
/// since the first row.
void accumulate(const DiagnosticsRow& row, Extremes& extremes);

/// Each is absent where the scene has none of it.
struct ErrorBudget {
  double mass_residual = 0;              // mass that has left over mass at the start
  double momentum_residual = 0;          // largest |net force of the particles on each other| / sum of its magnitudes
  double energy_released = 0;            // J
  double energy_rise = 0;                // J: largest rise of the total energy above its running minimum
  double energy_floor = 0;               // J: the weight times dp; scenes at rest release next to nothing
  std::optional<double> energy_created;  // rise / max(released, floor); absent with bodies that do work
  std::optional<double> density_error, density_error_p999, mach_number;
  std::optional<double> interpenetrating, interpenetrating_share;  // largest number; over the smaller phase's particles
  double below_bed = 0;                                            // at the end
};
ErrorBudget error_budget(const ModelParameters& p, const ParticleHeader& header, const Extremes& extremes);

/// One sentence each.
std::vector<std::string> warnings_of(const Resolution& resolution);
std::vector<std::string> warnings_of(const ErrorBudget& budget);

/// One line for a log.
std::string text_of(const Resolution& resolution);
std::string text_of(const ErrorBudget& budget);

nlohmann::ordered_json json_of(const Resolution& resolution);
nlohmann::ordered_json json_of(const ErrorBudget& budget);

}  // namespace lgiw
