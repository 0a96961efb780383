#include "measure/empirical_wave.hh"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lgiw {

namespace formulas {
const Formula vaw254_channel{"VAW 254", "Evers et al. 2019, 2-D"};
const Formula vaw254_basin{"VAW 254", "Evers et al. 2019, 3-D"};
const Formula fritz{"Fritz", "Fritz et al. 2004, 2-D", false};
const Formula huber_hager_channel{"Huber-Hager", "Huber & Hager 1997, 2-D", false};
const Formula huber_hager_basin{"Huber-Hager", "Huber & Hager 1997, 3-D", false};
const Formula mohammed_fritz{"Mohammed-Fritz", "Mohammed & Fritz 2012, 3-D", false, false};
const Formula mueller{"Mueller", "Mueller 1995", true, false};
const Formula evers_boes{"Evers-Boes", "Evers & Boes 2019", false};
const Formula synolakis{"Synolakis", "Synolakis 1987"};
const Formula hall_watts{"Hall-Watts", "Hall & Watts 1953", false};
const Formula koerner{"Koerner", "Koerner 1976"};
}  // namespace formulas

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), unbounded = std::numeric_limits<double>::infinity();

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

/// Notes a value outside its range; rounding does not put one outside.
void check(BrokenLimits& broken, const std::string& quantity, double value, double low, double high) {
  const double slack = 1e-9 * std::abs(value);
  if (!(value >= low - slack && value <= high + slack)) broken.push_back({quantity, value, low, high});
}

BrokenLimits channel_limits(const SlideImpact& impact, bool per_metre) {
  const ImpulseNumbers n = impulse_numbers(impact);
  BrokenLimits broken;
  check(broken, "F", n.froude, 0.86, 6.83);
  check(broken, "S", n.thickness, 0.09, 1.64);
  check(broken, "M", n.mass, 0.11, 10.02);
  check(broken, "V/(b h2)", n.volume, 0.05, 5.94);
  if (!per_metre) check(broken, "B", n.width, 0.74, 3.33);
  check(broken, "D", n.density, 0.59, 1.72);
  check(broken, "P", n.impulse_product, 0.17, 8.13);
  check(broken, "slope", impact.slope, 30, 90);
  return broken;
}

BrokenLimits basin_limits(const SlideImpact& impact) {
  const ImpulseNumbers n = impulse_numbers(impact);
  BrokenLimits broken;
  check(broken, "F", n.froude, 0.4, 3.4);
  check(broken, "S", n.thickness, 0.15, 0.6);
  check(broken, "M", n.mass, 0.25, 1);
  check(broken, "V/(b h2)", n.volume, 0.187, 0.75);
  check(broken, "B", n.width, 0.83, 5);
  check(broken, "P", n.impulse_product, 0.13, 2.08);
  check(broken, "slope", impact.slope, 30, 90);
  return broken;
}

BasinWave basin_wave(const SlideImpact& impact, double beyond, double angle) {
  const ImpulseNumbers n = impulse_numbers(impact);
  const double P = n.impulse_product, B = n.width, c = n.effective_cosine, h = impact.depth;
  const double root = std::sqrt(beyond / h), sideways = c * std::exp(-0.15 * root);
  const auto decayed = [&](double a0, double k, double q) {
    return a0 * std::exp(-k * std::pow(a0 / h, -0.3) * root) * std::pow(1 / std::cosh(q * angle / 90), sideways);
  };
  BasinWave wave;
  wave.crest = decayed(0.2 * std::pow(P, 0.5) * std::pow(B, 0.75) * std::pow(c, 0.25) * h, 0.4, 3.2);
  wave.trough = decayed(0.35 * std::pow(P * B * c, 0.5) * h, 0.4, 3.6);
  wave.second_crest = decayed(0.14 * std::pow(P * B * c, 0.25) * h, 0.1, 3);
  wave.celerity = 0.95 * std::sqrt(impact.gravity * (h + wave.crest));
  wave.broken = basin_limits(impact);
  return wave;
}

}  // namespace

ImpulseNumbers impulse_numbers(const SlideImpact& impact) {
  const double h = impact.depth;
  ImpulseNumbers n;
  n.froude = impact.speed / std::sqrt(impact.gravity * h);
  n.thickness = impact.thickness / h;
  n.volume = impact.volume / (impact.width * h * h);
  n.density = impact.density / impact.water_density;
  n.mass = n.density * n.volume;
  n.width = impact.width / h;
  n.effective_cosine = std::cos(radians(6 * impact.slope / 7));
  n.impulse_product =
      n.froude * std::sqrt(n.thickness) * std::pow(n.mass, 0.25) * std::sqrt(std::max(0.0, n.effective_cosine));
  return n;
}

double vaw254_peak_distance(const SlideImpact& impact) {
  return 5.5 * std::sqrt(impulse_numbers(impact).impulse_product) * impact.depth;
}

ChannelWave vaw254_channel(const SlideImpact& impact, double x, bool per_metre) {
  const double P = impulse_numbers(impact).impulse_product, h = impact.depth;
  ChannelWave wave;
  wave.broken = channel_limits(impact, per_metre);
  wave.near = x < vaw254_peak_distance(impact);
  const double wave_time = 9 * std::sqrt(h / impact.gravity);
  if (wave.near) {
    wave.height = 5.0 / 9 * std::pow(P, 0.8) * h;
    wave.period = wave_time * std::sqrt(P);
  } else {
    const double X = x / h;
    wave.height = 0.75 * std::pow(P / std::cbrt(X), 0.8) * h;
    wave.period = wave_time * std::pow(P, 0.25) * std::pow(X, 5.0 / 16);
    check(wave.broken, "x/h", X, 2.7, 59.2);
  }
  wave.crest = 0.8 * wave.height;
  wave.celerity = std::sqrt(impact.gravity * (h + wave.crest));
  return wave;
}

double vaw254_impact_radius(const SlideImpact& impact, double angle) {
  const ImpulseNumbers n = impulse_numbers(impact);
  const double along = 2.5 * std::pow(n.impulse_product * n.width * n.effective_cosine, 0.25) * impact.depth;
  const double across = impact.width / 2 + 1.5 * std::pow(n.impulse_product * n.effective_cosine, 0.25) * impact.depth;
  return 1 / std::hypot(std::cos(radians(angle)) / along, std::sin(radians(angle)) / across);
}

BasinWave vaw254_impact(const SlideImpact& impact) { return basin_wave(impact, 0, 0); }

BasinWave vaw254_basin(const SlideImpact& impact, double r, double angle) {
  const double r0 = vaw254_impact_radius(impact, angle);
  BasinWave wave = basin_wave(impact, std::max(0.0, r - r0), angle);
  wave.near = r < r0;
  check(wave.broken, "r/h", r / impact.depth, 1, 16);
  check(wave.broken, "angle", angle, -90, 90);
  if (std::abs(angle) > 90) wave.crest = wave.trough = wave.second_crest = wave.celerity = nan;
  return wave;
}

Estimate fritz_crest(const SlideImpact& impact) {
  const ImpulseNumbers n = impulse_numbers(impact);
  Estimate crest{0.25 * std::pow(n.froude, 1.4) * std::pow(n.thickness, 0.8) * impact.depth, {}};
  check(crest.broken, "F", n.froude, 1, 4.8);
  check(crest.broken, "slope", impact.slope, 44, 46);
  return crest;
}

Estimate huber_hager_channel_height(const SlideImpact& impact, double x) {
  const ImpulseNumbers n = impulse_numbers(impact);
  Estimate height{0.88 * std::sin(radians(impact.slope)) * std::pow(n.density, 0.25) * std::sqrt(n.volume) *
                      std::pow(x / impact.depth, -0.25) * impact.depth,
                  {}};
  check(height.broken, "slope", impact.slope, 28, 60);
  return height;
}

Estimate huber_hager_basin_height(const SlideImpact& impact, double r, double angle) {
  const ImpulseNumbers n = impulse_numbers(impact);
  const double off_axis = std::cos(radians(2 * angle / 3));
  Estimate height{1.76 * std::sin(radians(impact.slope)) * off_axis * off_axis * std::pow(n.density, 0.25) *
                      std::sqrt(n.volume) * std::pow(r / impact.depth, -2.0 / 3) * impact.depth,
                  {}};
  check(height.broken, "slope", impact.slope, 28, 60);
  check(height.broken, "angle", angle, -90, 90);
  if (std::abs(angle) > 90) height.value = nan;
  return height;
}

Estimate mohammed_fritz_crest(const SlideImpact& impact, double r, double angle) {
  const ImpulseNumbers n = impulse_numbers(impact);
  const double decay = -1.2 * std::pow(n.froude, 0.25) * std::pow(n.thickness, -0.02) * std::pow(n.width, -0.33);
  Estimate crest{0.31 * std::pow(n.froude, 2.1) * std::pow(n.thickness, 0.6) * std::pow(r / impact.depth, decay) *
                     std::cos(radians(angle)) * impact.depth,
                 {}};
  check(crest.broken, "angle", angle, -90, 90);
  if (std::abs(angle) > 90) crest.value = nan;
  return crest;
}

Estimate mueller_runup(const BankWave& wave) {
  return {1.25 * wave.depth * std::pow(wave.height / wave.depth, 1.25) * std::pow(wave.height / wave.length, -0.15) *
              std::pow(90 / wave.slope, 0.2),
          {}};
}

Estimate evers_boes_runup(const BankWave& wave) {
  const double e = wave.crest / wave.depth;
  Estimate runup{2 * e * std::exp(0.4 * e) * std::pow(90 / wave.slope, 0.2) * wave.depth, {}};
  check(runup.broken, "a/h", e, 0.007, 0.69);
  check(runup.broken, "bank", wave.slope, 10, 90);
  return runup;
}

Estimate synolakis_runup(const BankWave& wave) {
  const double e = wave.crest / wave.depth, tangent = std::tan(radians(wave.slope)), cotangent = 1 / tangent;
  Estimate runup{2.831 * std::sqrt(cotangent) * std::pow(e, 1.25) * wave.depth, {}};
  // Asymptotic for (a/h)^(1/2) well above 0.288 tan(beta): towards a wall it would vanish. Above, the wave breaks.
  check(runup.broken, "a/h", e, 0.288 * 0.288 * tangent * tangent, 0.818 * std::pow(cotangent, -10.0 / 9));
  return runup;
}

Estimate hall_watts_runup(const BankWave& wave) {
  const double tangent = std::tan(radians(wave.slope)), e = wave.crest / wave.depth;
  Estimate runup{3.05 * std::pow(tangent, -0.13) * std::pow(e, 1.15 * std::pow(tangent, 0.02)) * wave.depth, {}};
  check(runup.broken, "bank", wave.slope, 12, 45);
  return runup;
}

Estimate koerner_speed(double drop, double slope, double friction_angle, double gravity) {
  const double share = 1 - std::tan(radians(friction_angle)) / std::tan(radians(slope));
  Estimate speed{std::sqrt(std::max(0.0, 2 * gravity * drop * share)), {}};
  check(speed.broken, "friction angle", friction_angle, 15, 35);
  return speed;
}

}  // namespace lgiw
