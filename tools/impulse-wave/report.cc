#include "report.hh"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "case/dotted_key.hh"
#include "measure/norms.hh"

namespace lgiw {
namespace {

using nlohmann::ordered_json;

/// `digits` significant ones, and all before the point.
std::string text_of(double value, int digits = 3) {
  if (std::isnan(value)) return "-";
  return number_text(value, std::max(digits, std::abs(value) < 1 ? 0 : int(std::log10(std::abs(value))) + 1));
}

std::string left(const std::string& text, std::size_t width) {
  return text.size() < width ? text + std::string(width - text.size(), ' ') : text;
}
std::string right(const std::string& text, std::size_t width) {
  return text.size() < width ? std::string(width - text.size(), ' ') + text : text;
}

std::string limits_text(const BrokenLimits& broken) {
  std::string text;
  for (const BrokenLimit& l : broken)
    text += (text.empty() ? "" : "; ") + l.quantity + " " + number_text(l.value, 3) + " (" + number_text(l.low, 3) +
            ".." + number_text(l.high, 3) + ")";
  return text;
}

/// "first_crest_m" as "first crest, m".
std::string spoken(std::string quantity) {
  const std::size_t unit = quantity.rfind('_');
  quantity.replace(unit, 1, ", ");
  std::replace(quantity.begin(), quantity.end(), '_', ' ');
  return quantity;
}

std::string heading(const Formula& formula) { return formula.name + (formula.verified ? "" : "*"); }

/// Places down, their quantities below each other, formulas across.
std::string place_table(const Assessment& a, const std::string& kind) {
  std::vector<std::string> columns;
  bool simulated = false;
  for (const Place& p : a.places)
    for (const PlaceEstimate& e : p.estimates) {
      if (p.kind != kind) continue;
      const std::string name = heading(e.formula);
      if (std::find(columns.begin(), columns.end(), name) == columns.end()) columns.push_back(name);
      simulated = simulated || !std::isnan(e.simulated);
    }
  if (columns.empty()) return "";
  constexpr std::size_t width = 12;
  std::string text = "\n" + left(kind, 10) + right("r (m)", 9) + right("angle", 7) + "  " + left("quantity", 20);
  if (kind == "bank")
    text = "\n" + left(kind, 10) + right("r (m)", 9) + right("slope", 7) + "  " + left("quantity", 20);
  if (simulated) text += right("simulated", 10);
  for (const std::string& column : columns) text += right(column, std::max(width, column.size() + 2));
  text += "\n";
  for (const Place& p : a.places) {
    if (p.kind != kind) continue;
    bool first = true;
    std::vector<std::string> done;
    for (const PlaceEstimate& row : p.estimates) {
      if (std::find(done.begin(), done.end(), row.quantity) != done.end()) continue;
      done.push_back(row.quantity);
      const std::string where = left(p.name + (p.near ? " +" : ""), 10) + right(text_of(p.distance), 9) +
                                right(text_of(kind == "bank" ? p.bank_slope : p.angle), 7);
      text += (first ? where : std::string(26, ' ')) + "  " + left(spoken(row.quantity), 20);
      first = false;
      if (simulated) text += right(text_of(row.simulated), 10);
      for (const std::string& column : columns) {
        double value = no_value;
        for (const PlaceEstimate& e : p.estimates)
          if (e.quantity == row.quantity && heading(e.formula) == column) value = e.predicted;
        text += right(text_of(value), std::max(width, column.size() + 2));
      }
      while (text.back() == ' ') text.pop_back();
      text += "\n";
    }
  }
  return text;
}

ordered_json limits_json(const BrokenLimits& broken) {
  ordered_json list = ordered_json::array();
  for (const BrokenLimit& l : broken)
    list.push_back({{"quantity", l.quantity},
                    {"value", l.value},
                    {"low", std::isfinite(l.low) ? ordered_json(l.low) : ordered_json()},
                    {"high", std::isfinite(l.high) ? ordered_json(l.high) : ordered_json()}});
  return list;
}

}  // namespace

std::string report_text(const Assessment& a) {
  const SlideImpact& s = a.impact;
  std::string text = a.run.empty() ? "Slide at impact, as given\n" : "Slide at impact, as measured in " + a.run + "\n";
  const auto line = [&](const std::string& option, const std::string& name, double value, const std::string& unit,
                        const std::string& remark = "") {
    const bool given = !a.run.empty() && std::find(a.given.begin(), a.given.end(), option) != a.given.end();
    text += "  " + left(name, 22) + right(text_of(value, 4), 11) + " " + left(unit, 6);
    if (given || !remark.empty()) text += "  " + (given ? "given on the command line" : remark);
    while (text.back() == ' ') text.pop_back();
    text += "\n";
  };
  const std::string per_metre = a.per_metre ? "m3/m" : "m3";
  line("speed", "speed", s.speed, "m/s",
       a.entry && !std::isnan(a.entry->speed)
           ? "mean; 10th to 90th percentile " + text_of(a.entry->slow_speed) + " to " + text_of(a.entry->fast_speed)
           : "");
  line("thickness", "thickness", s.thickness, "m");
  if (!a.per_metre) line("width", "width", s.width, "m");
  line("volume", "volume", s.volume, per_metre, a.entry ? "that crossed still water level" : "");
  line("density", "bulk density", s.density, "kg/m3");
  line("slope", "impact angle", s.slope, "deg");
  line("depth", "still water depth", s.depth, "m", a.entry ? "greatest before the slide" : "");
  if (a.entry && a.entry->volume > 0)
    text += "  entered the water from " + text_of(a.entry->start) + " to " + text_of(a.entry->end) + " s at x " +
            number_text(a.water.x, 9) + (a.channel ? "" : ", y " + number_text(a.water.y, 9)) + ", towards " +
            text_of(a.entry->direction) + " deg\n";
  if (!std::isnan(a.koerner.value))
    text += "  speed after Koerner " + text_of(a.koerner.value) + " m/s: sunk by " + text_of(a.drop) + " m on " +
            text_of(a.travel_slope) + " deg against a friction angle of " + text_of(a.friction_angle) + " deg\n";
  if (a.complete) {
    const ImpulseNumbers n = impulse_numbers(s);
    text += "  F " + text_of(n.froude) + ", S " + text_of(n.thickness) + ", M " + text_of(n.mass) + ", V/(b h2) " +
            text_of(n.volume) + (a.per_metre ? "" : ", B " + text_of(n.width)) + ", D " + text_of(n.density) +
            "; impulse product parameter P " + text_of(n.impulse_product) + "\n";
  }
  for (const char* kind : {"impact", "distance", "gauge", "bank"}) text += place_table(a, kind);
  bool near = false, recalled = false;
  for (const Place& p : a.places) {
    near = near || p.near;
    for (const PlaceEstimate& e : p.estimates) recalled = recalled || !e.formula.verified;
  }
  if (near || recalled) text += "\n";
  if (near) text += "+ nearer than where the wave is full-grown: the largest of VAW 254 is printed\n";
  if (recalled) text += "* recalled, not verified against the source\n";
  const std::vector<std::string> limits = limit_lines(a);
  if (!limits.empty()) text += "\nOutside the limits, so an extrapolation:\n";
  for (const std::string& limit : limits) text += "  " + limit + "\n";
  if (!a.notes.empty()) text += "\n";
  for (const std::string& note : a.notes) text += "Note: " + note + "\n";
  return text;
}

CsvTable report_table(const Assessment& a) {
  CsvTable table({"place", "kind", "distance_m", "angle_deg", "quantity", "formula", "verified", "predicted",
                  "simulated", "error_percent", "limits_broken"});
  for (const Place& p : a.places)
    for (const PlaceEstimate& e : p.estimates)
      table.add(p.name, p.kind, p.distance, p.angle, e.quantity, e.formula.name, e.formula.verified ? 1.0 : 0.0,
                e.predicted, e.simulated, percent_error(e.simulated, e.predicted), limits_text(e.broken));
  return table;
}

ordered_json report_json(const Assessment& a) {
  const SlideImpact& s = a.impact;
  ordered_json slide{{"speed_m_s", s.speed},
                     {"thickness_m", s.thickness},
                     {"width_m", s.width},
                     {"volume_m3", s.volume},
                     {"density_kg_m3", s.density},
                     {"slope_deg", s.slope},
                     {"still_water_depth_m", s.depth},
                     {"given", a.given}};
  if (a.entry) {
    const SlideEntry& e = *a.entry;
    slide["measured"] = {{"speed_m_s", e.speed},
                         {"slow_speed_m_s", e.slow_speed},
                         {"fast_speed_m_s", e.fast_speed},
                         {"thickness_m", e.thickness},
                         {"width_m", e.width},
                         {"volume_m3", e.volume},
                         {"submerged_volume_m3", e.submerged_volume},
                         {"slope_deg", e.slope},
                         {"x", a.water.x},
                         {"y", a.water.y},
                         {"direction_deg", e.direction},
                         {"start_s", e.start},
                         {"end_s", e.end}};
  }
  if (!std::isnan(a.koerner.value))
    slide["koerner"] = {{"speed_m_s", a.koerner.value},
                        {"drop_m", a.drop},
                        {"slope_deg", a.travel_slope},
                        {"friction_angle_deg", a.friction_angle},
                        {"limits_broken", limits_json(a.koerner.broken)}};
  ordered_json numbers;
  if (a.complete) {
    const ImpulseNumbers n = impulse_numbers(s);
    numbers = {{"F", n.froude},
               {"S", n.thickness},
               {"M", n.mass},
               {"V", n.volume},
               {"B", a.per_metre ? ordered_json() : ordered_json(n.width)},
               {"D", n.density},
               {"P", n.impulse_product}};
  }
  ordered_json places = ordered_json::array();
  for (const Place& p : a.places) {
    ordered_json place{{"kind", p.kind},
                       {"name", p.name},
                       {"distance_m", p.distance},
                       {"angle_deg", p.angle},
                       {"in_impact_zone", p.near}};
    if (!std::isnan(p.x)) place["x"] = p.x, place["y"] = p.y;
    if (p.kind == "bank") place["bank_slope_deg"] = p.bank_slope, place["still_water_depth_m"] = p.depth;
    if (p.kind == "gauge")
      place["simulated"] = {{"largest_crest_m", p.largest_crest},
                            {"time_of_largest_crest_s", p.time_of_largest},
                            {"arrival_s", p.arrival}};
    place["estimates"] = ordered_json::array();
    for (const PlaceEstimate& e : p.estimates)
      place["estimates"].push_back({{"quantity", e.quantity},
                                    {"formula", e.formula.name},
                                    {"source", e.formula.source},
                                    {"verified", e.formula.verified},
                                    {"limits_known", e.formula.limits_known},
                                    {"predicted", e.predicted},
                                    {"simulated", e.simulated},
                                    {"limits_broken", limits_json(e.broken)}});
    places.push_back(std::move(place));
  }
  ordered_json result{{"dimension", a.channel ? 2 : 3},  {"slide", slide},  {"numbers", numbers}, {"places", places},
                      {"limits_broken", limit_lines(a)}, {"notes", a.notes}};
  return {{"impulse_wave", result}};
}

}  // namespace lgiw
