#include "files/domain.hh"

#include <cstdio>

#include "base/error.hh"

namespace lgiw {
namespace {

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

void check_point(const ParticleHeader& header, const std::string& what, double x, double y) {
  LGIW_VALIDATE(
      inside_domain(header, x, y),
      what + " at x = " + number(x) + (header.dimension == 3 ? ", y = " + number(y) : "") + " lies outside the run",
      "its domain is " + domain_text(header), "give a place inside, in the coordinates of the case");
}

}  // namespace

bool inside_domain(const ParticleHeader& header, double x, double y) {
  const double slack = 1e-6 * header.dp;
  const auto within = [&](double value, int axis) {
    return value >= header.low[axis] - slack && value <= header.high[axis] + slack;
  };
  return within(x - header.origin[0], 0) && (header.dimension == 2 || within(y - header.origin[1], 1));
}

std::string domain_text(const ParticleHeader& header) {
  const auto range = [&](int axis) {
    return std::string("from ") + number(header.low[axis] + header.origin[axis]) + " to " +
           number(header.high[axis] + header.origin[axis]);
  };
  return "x " + range(0) + (header.dimension == 3 ? " and y " + range(1) : "");
}

void check_inside(const ParticleHeader& header, const std::vector<Gauge>& gauges,
                  const std::vector<Section>& sections) {
  for (const Gauge& gauge : gauges) check_point(header, "gauge " + gauge.name, gauge.x, gauge.y);
  for (const Section& section : sections)
    for (const Point2& p : section.points) check_point(header, "section " + section.name, p[0], p[1]);
}

}  // namespace lgiw
