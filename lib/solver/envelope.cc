#include "solver/envelope.hh"

#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>

#include "physics/soil.hh"

namespace lgiw {
namespace {

constexpr double none = std::numeric_limits<double>::infinity();

nlohmann::ordered_json limit(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}

}  // namespace

std::vector<EnvelopeAxis> envelope_of(const Case& c, const ModelParameters& p) {
  std::vector<EnvelopeAxis> axes;
  const double g = std::hypot(p.gravity[0], p.gravity[1], p.gravity[2]);
  const double wave = std::sqrt(g * p.water_depth);
  const double speed = std::hypot(c.slide.velocity[0], c.slide.velocity[1], c.slide.velocity[2]);
  const bool water = p.water_depth > 0, soil = p.soil_height > 0;
  axes.push_back({"particle spacing (m)", p.dp, 0.001, 50, "nothing so small was tried", "nothing so large was tried"});
  if (water) {
    const char* slow = "the water is compressed, and waves come out low and late: raise water.sound_speed";
    axes.push_back({"water sound speed / sqrt(g depth)", p.sound_speed / wave, 10, none, slow, ""});
    if (soil && speed > 0) {
      axes.push_back({"water sound speed / speed of the slide", p.sound_speed / speed, 5, none, slow, ""});
      axes.push_back({"Froude number of the slide", speed / wave, 0, 10, "", "nothing so fast was tried"});
    }
  }
  if (soil) {
    const double weight = p.soil_density * g * p.soil_height;
    const double soil_wave = SoilMaterial<double>::wave_speed(p.young_modulus, p.poisson_ratio, p.soil_density);
    axes.push_back({"Young modulus / weight of the soil", p.young_modulus / weight, 2.7, none,
                    "the soil sags under its weight before it slides: raise soil.young_modulus", ""});
    axes.push_back(
        {"Poisson ratio", p.poisson_ratio, 0.1, 0.49, "nothing so low was tried", "nothing so high was tried"});
    axes.push_back({"cohesion / weight of the soil", p.cohesion / weight, 0, 5, "", "nothing so strong was tried"});
    if (water) {
      axes.push_back({"wave speed of the soil / of the water", soil_wave / p.sound_speed, 0.07, 30,
                      "nothing so soft was tried",
                      "nearly every time step is for the sound of the soil: lower soil.young_modulus"});
      axes.push_back({"density of the soil / of the water", p.soil_density / p.water_density, 0.9, 5,
                      "nothing so light was tried", "nothing so heavy was tried"});
    }
  }
  return axes;
}

std::vector<std::string> warnings_of(const std::vector<EnvelopeAxis>& envelope) {
  std::vector<std::string> out;
  for (const EnvelopeAxis& axis : envelope) {
    if (axis.inside()) continue;
    const bool low = axis.value < axis.low;
    char range[120];
    std::snprintf(range, sizeof range, " is %.3g, %s the %.3g up to which the solver is known to be sound; ",
                  axis.value, low ? "below" : "above", low ? axis.low : axis.high);
    out.push_back(axis.name + range + (low ? axis.below : axis.above));
  }
  return out;
}

nlohmann::ordered_json json_of(const std::vector<EnvelopeAxis>& envelope) {
  auto j = nlohmann::ordered_json::array();
  for (const EnvelopeAxis& axis : envelope)
    j.push_back({{"axis", axis.name},
                 {"value", axis.value},
                 {"low", limit(axis.low)},
                 {"high", limit(axis.high)},
                 {"inside", axis.inside()}});
  return j;
}

}  // namespace lgiw
