#include "solver/error_budget.hh"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace lgiw {
namespace {

std::string format(const char* pattern, auto... values) {
  char text[300];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

double value_of(const Extremes& extremes, const std::string& name) {
  const auto it = extremes.find(name);
  return it == extremes.end() ? 0 : it->second;
}

std::optional<double> optional_of(const Extremes& extremes, const std::string& name) {
  const auto it = extremes.find(name);
  return it == extremes.end() ? std::nullopt : std::optional<double>(it->second);
}

nlohmann::ordered_json json_of(const std::optional<double>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
}

using Column = std::pair<int64_t, int64_t>;

/// The column, one dp wide in plan, that holds (x, y); its walls lie midway between lattice points.
Column column_at(const ParticleHeader& header, double x, double y) {
  const auto index = [&](double at, int k) { return int64_t(std::floor((at - header.low[k]) / header.dp)); };
  return {index(x, 0), header.dimension == 3 ? index(y, 1) : 0};
}

std::map<Column, double> column_counts(const ParticleHeader& header, const ParticleBlock& block) {
  std::map<Column, double> counts;
  auto it = counts.end();
  for (std::size_t i = 0; i < block.size(); ++i) {
    const Column column = column_at(header, block.points[3 * i], block.points[3 * i + 1]);
    if (it == counts.end() || it->first != column) it = counts.try_emplace(column, 0).first;  // files go up by columns
    ++it->second;
  }
  return counts;
}

double quantile(const std::map<Column, double>& counts, double share) {
  std::vector<double> values;
  for (const auto& [column, count] : counts) values.push_back(count);
  const auto at = values.begin() + long(share * double(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

Resolution resolution_of(const Case& c, const ParticleData& data) {
  const ParticleHeader& header = data.header;
  Resolution r;
  if (data.soil.size()) {
    const auto counts = column_counts(header, data.soil);
    r.slide_median = quantile(counts, 0.5), r.slide_tenth = quantile(counts, 0.1);
  }
  const auto water = column_counts(header, data.water);
  for (const auto& [column, count] : water) r.deepest_water = std::max(r.deepest_water.value_or(0), count);
  for (const Gauge& gauge : c.gauges) {
    if (gauge.quantity != GaugeQuantity::surface) continue;
    const auto it = water.find(column_at(header, gauge.x - header.origin[0], gauge.y - header.origin[1]));
    if (it != water.end()) r.gauges.push_back({gauge.name, it->second});
  }
  return r;
}

void accumulate(const DiagnosticsRow& row, Extremes& extremes) {
  const bool first = !extremes.count("last_total_energy");
  for (const auto& [name, value] : row) {
    const bool largest = name.compare(0, 4, "max_") == 0;
    if (largest) extremes[name] = std::max(extremes[name], value);
    if (!largest) extremes["last_" + name] = value;
    for (const char* other : {"mach_number", "density_error_p999", "interpenetrating", "momentum_residual"})
      if (name == other) extremes["max_" + name] = std::max(extremes["max_" + name], value);
  }
  const double total = extremes["last_total_energy"], potential = extremes["last_potential_energy"];
  if (first) extremes["lowest_energy"] = total, extremes["first_potential_energy"] = potential;
  double &lowest = extremes["lowest_energy"], &created = extremes["energy_created"];
  double& released = extremes["energy_released"];
  created = std::max(created, total - lowest);
  lowest = std::min(lowest, total);
  released = std::max({released, extremes["last_kinetic_energy"], extremes["first_potential_energy"] - potential});
}

ErrorBudget error_budget(const ModelParameters& p, const ParticleHeader& header, const Extremes& extremes) {
  const double volume = std::pow(p.dp, p.dimension);
  const double water = double(header.counts.water) * volume * p.water_density,
               soil = double(header.counts.soil) * volume * p.soil_density, mass = water + soil;
  ErrorBudget b;
  b.mass_residual = mass > 0 ? volume *
                                   (value_of(extremes, "last_lost_water") * p.water_density +
                                    value_of(extremes, "last_lost_soil") * p.soil_density) /
                                   mass
                             : 0.0;
  b.momentum_residual = value_of(extremes, "max_momentum_residual");
  b.energy_released = value_of(extremes, "energy_released"), b.energy_rise = value_of(extremes, "energy_created");
  b.energy_floor = mass * std::hypot(p.gravity[0], p.gravity[1], p.gravity[2]) * p.dp;
  const double scale = std::max(b.energy_released, b.energy_floor);
  if (header.bodies.empty() && scale > 0) b.energy_created = b.energy_rise / scale;
  b.density_error = optional_of(extremes, "max_density_error");
  b.density_error_p999 = optional_of(extremes, "max_density_error_p999");
  b.mach_number = optional_of(extremes, "max_mach_number");
  b.interpenetrating = optional_of(extremes, "max_interpenetrating");
  if (b.interpenetrating)
    b.interpenetrating_share = *b.interpenetrating / double(std::min(header.counts.water, header.counts.soil));
  b.below_bed = value_of(extremes, "last_below_bed");
  return b;
}

std::vector<std::string> warnings_of(const Resolution& r) {
  std::vector<std::string> out;
  if (r.slide_median && *r.slide_median < warn_at::slide_particles)
    out.push_back(
        format("the slide is %.0f particles thick (median); below %.0f its run-out and wave depend on the "
               "spacing: refine particle_spacing",
               *r.slide_median, warn_at::slide_particles));
  for (const auto& [name, depth] : r.gauges)
    if (depth < warn_at::gauge_particles)
      out.push_back("gauge " + name +
                    format(" stands in %.0f particles of water; below %.0f waves are damped and late there: refine "
                           "particle_spacing or move it",
                           depth, warn_at::gauge_particles));
  return out;
}

std::vector<std::string> warnings_of(const ErrorBudget& b) {
  std::vector<std::string> out;
  if (b.mach_number && *b.mach_number > warn_at::mach_number)
    out.push_back(format("the Mach number of the water reached %.2g, above %.2g: raise water.sound_speed",
                         *b.mach_number, warn_at::mach_number));
  if (b.density_error_p999 && *b.density_error_p999 > warn_at::density_error)
    out.push_back(
        format("the density error of the water (99.9th percentile) reached %.2g %%, above %.2g %%: raise "
               "water.sound_speed",
               100 * *b.density_error_p999, 100 * warn_at::density_error));
  if (b.energy_created && *b.energy_created > warn_at::energy_created)
    out.push_back(
        format("energy was created: %.2g %% of what was released, above %.2g %%: lower numerics.cfl or raise "
               "water.viscosity_alpha",
               100 * *b.energy_created, 100 * warn_at::energy_created));
  if (b.interpenetrating_share && *b.interpenetrating_share > warn_at::interpenetrating)
    out.push_back(
        format("%.0f particles were enclosed by the other phase, %.2g %% of the smaller one, above %.2g %%: "
               "refine particle_spacing",
               *b.interpenetrating, 100 * *b.interpenetrating_share, 100 * warn_at::interpenetrating));
  return out;
}

std::string text_of(const Resolution& r) {
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (r.slide_median)
    add(format("slide %.0f particles thick (median; a tenth of it %.0f or fewer)", *r.slide_median, *r.slide_tenth));
  if (r.deepest_water) add(format("water %.0f deep", *r.deepest_water));
  for (const auto& [name, depth] : r.gauges) add("gauge " + name + format(" in %.0f", depth));
  return "resolution: " + text;
}

std::string text_of(const ErrorBudget& b) {
  std::string text = format("error budget: mass %.2g, momentum %.2g", b.mass_residual, b.momentum_residual);
  if (b.energy_created)
    text += format(", energy created %.2g %% of %.3g J released", 100 * *b.energy_created,
                   std::max(b.energy_released, b.energy_floor));
  if (b.density_error)
    text += format(", density error %.2g %% (99.9th percentile; largest %.2g %%), Mach %.2g",
                   100 * *b.density_error_p999, 100 * *b.density_error, *b.mach_number);
  if (b.interpenetrating) text += format(", %.0f interpenetrating", *b.interpenetrating);
  return text + format(", %.0f below the bed", b.below_bed);
}

nlohmann::ordered_json json_of(const Resolution& r) {
  nlohmann::ordered_json j;
  if (r.slide_median) j["slide_thickness_particles"] = {{"median", *r.slide_median}, {"tenth", *r.slide_tenth}};
  if (r.deepest_water) j["water_depth_particles"] = *r.deepest_water;
  j["gauge_depth_particles"] = nlohmann::ordered_json::object();
  for (const auto& [name, depth] : r.gauges) j["gauge_depth_particles"][name] = depth;
  return j;
}

nlohmann::ordered_json json_of(const ErrorBudget& b) {
  nlohmann::ordered_json j;
  j["mass_residual"] = b.mass_residual;
  j["momentum_residual"] = b.momentum_residual;
  j["energy_created"] = json_of(b.energy_created);
  j["energy_rise_J"] = b.energy_rise;
  j["energy_released_J"] = b.energy_released;
  if (b.density_error) {
    j["density_error"] = *b.density_error;
    j["density_error_p999"] = *b.density_error_p999;
    j["mach_number"] = *b.mach_number;
  }
  if (b.interpenetrating) {
    j["interpenetrating"] = *b.interpenetrating;
    j["interpenetrating_share"] = *b.interpenetrating_share;
  }
  j["below_bed"] = b.below_bed;
  return j;
}

}  // namespace lgiw
