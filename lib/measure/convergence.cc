#include "measure/convergence.hh"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "base/error.hh"

namespace lgiw {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// The p > 0 with ratio = r21^p (r32^p - 1) / (r21^p - 1); NaN where there is none. The right side rises with p, from
/// ln r32 / ln r21 at 0.
double observed_order(double ratio, double r21, double r32) {
  const auto side = [&](double p) {
    return std::pow(r21, p) * std::expm1(p * std::log(r32)) / std::expm1(p * std::log(r21));
  };
  if (!(ratio > std::log(r32) / std::log(r21) * (1 + 1e-12))) return nothing;
  double low = 0, high = 1;
  while (side(high) < ratio)
    if ((high *= 2) > 64) return nothing;  // f2 = f1 but for rounding
  for (int k = 0; k < 100; ++k) {
    const double middle = (low + high) / 2;
    (side(middle) < ratio ? low : high) = middle;
  }
  return (low + high) / 2;
}

/// Scalars by dotted key.
void flatten(const YAML::Node& node, const std::string& key, std::map<std::string, std::string>& scalars) {
  const auto below = [&](const std::string& name) { return key.empty() ? name : key + "." + name; };
  if (node.IsMap()) {
    for (const auto& item : node) flatten(item.second, below(item.first.Scalar()), scalars);
  } else if (node.IsSequence()) {
    for (std::size_t k = 0; k < node.size(); ++k) flatten(node[k], below(std::to_string(k)), scalars);
  } else if (node.IsScalar()) {
    scalars[key] = node.Scalar();
  }
}

bool same(const std::string& a, const std::string& b) {
  if (a == b) return true;
  char *end_a = nullptr, *end_b = nullptr;
  const double x = std::strtod(a.c_str(), &end_a), y = std::strtod(b.c_str(), &end_b);
  return !a.empty() && !b.empty() && !*end_a && !*end_b && x == y;
}

}  // namespace

Convergence convergence_of(std::vector<SpacingResult> results) {
  std::sort(results.begin(), results.end(), [](const auto& a, const auto& b) { return a.spacing < b.spacing; });
  Convergence c{nothing, nothing, nothing, nothing, nothing, false, "the finest run has none"};
  if (!results.empty() && std::isnan(results.front().value)) return c;
  std::erase_if(results, [](const SpacingResult& r) { return std::isnan(r.value); });
  c.why = "fewer than two runs have it";
  if (results.size() < 2) return c;
  const std::size_t used = std::min<std::size_t>(results.size(), 3);
  const auto [low, high] = std::minmax_element(results.begin(), results.begin() + std::ptrdiff_t(used),
                                               [](const auto& a, const auto& b) { return a.value < b.value; });
  const double f1 = results[0].value, f2 = results[1].value, r21 = results[1].spacing / results[0].spacing;
  const auto relative = [&](double error) { return f1 != 0 ? error / std::abs(f1) : nothing; };
  LGIW_EXPECT(r21 > 1);
  c.error = high->value - low->value;
  c.spread = relative(c.error);
  c.why = "two runs";
  if (used < 3) return c;

  const double r32 = results[2].spacing / results[1].spacing, e21 = f2 - f1, e32 = results[2].value - f2;
  LGIW_EXPECT(r32 > 1);
  c.why = "the results oscillate";
  if (e32 * e21 < 0) return c;
  c.why = "no change between two runs";
  if (e32 == 0 || e21 == 0) return c;
  c.order = observed_order(e32 / e21, r21, r32);
  c.why = "the changes do not shrink";
  if (std::isnan(c.order)) return c;
  c.why = "order above 2";
  if (c.order > 2) return c;
  // Extrapolation then divides by next to nothing: order 0.15 gave a wave of 12 m an error of 7 where three runs agree
  // to 0.6.
  c.why = "order below 0.5";
  if (c.order < 0.5) return c;
  c.why = "three finest runs";
  c.use_gci = true;
  const double gain = std::pow(r21, c.order) - 1;
  c.error = 1.25 * std::abs(e21) / gain;
  c.gci = relative(c.error);
  c.richardson = f1 - e21 / gain;
  return c;
}

std::vector<std::string> case_differences(const std::vector<std::string>& case_texts) {
  static const std::set<std::string> hanging{"name",
                                             "particle_spacing",
                                             "numerics.h_over_dp",
                                             "numerics.threads",
                                             "numerics.backend",
                                             "output.map_spacing",
                                             "output.arrival_threshold",
                                             "output.checkpoint_interval",
                                             "terrain.absorbing_width",
                                             "slide.min_thickness"};
  std::vector<std::map<std::string, std::string>> cases;
  std::set<std::string> keys, different;
  for (const std::string& text : case_texts) {
    cases.emplace_back();
    flatten(YAML::Load(text), "", cases.back());
    for (const auto& [key, value] : cases.back()) keys.insert(key);
  }
  for (const std::string& key : keys) {
    if (hanging.count(key)) continue;
    for (const auto& c : cases) {
      const auto first = std::as_const(cases).front().find(key), here = c.find(key);
      const bool both = first != cases.front().end() && here != c.end();
      if (both ? !same(first->second, here->second) : first != cases.front().end() || here != c.end())
        different.insert(key);
    }
  }
  return {different.begin(), different.end()};
}

}  // namespace lgiw
