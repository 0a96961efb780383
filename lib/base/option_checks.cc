#include "base/option_checks.hh"

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace lgiw {
namespace {

/// NaN where `text` is no finite number.
double number(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return text.empty() || *end != '\0' || !std::isfinite(value) ? std::nan("") : value;
}

}  // namespace

std::string above_zero(const std::string& text) { return number(text) > 0 ? "" : text + " is not a number above 0"; }

std::function<std::string(const std::string&)> between(double low, double high) {
  return [low, high](const std::string& text) {
    const double value = number(text);
    if (value >= low && value <= high) return std::string();
    char range[80];
    std::snprintf(range, sizeof range, " is not a number from %g to %g", low, high);
    return text + range;
  };
}

}  // namespace lgiw
