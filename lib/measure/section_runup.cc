#include "measure/section_runup.hh"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "measure/earliest_arrival.hh"

namespace lgiw {
namespace {

/// The lowest ground that is under water, not bed: under the slide the bed is its failure surface. The number of
/// stations where all are dry.
std::size_t lowest_wet_station(const RunHeader& header, const std::vector<Station>& stations,
                               const std::vector<float>& water) {
  const HeightField& ground = ground_of(header.particles);
  double lowest = infinite;
  std::size_t found = stations.size();
  for (std::size_t k = 0; k < stations.size(); ++k) {
    const Station& s = stations[k];
    if (std::isnan(sample_surface(header.map, water, s.x, s.y))) continue;
    const double z = ground.height(s.x, s.y);
    if (z < lowest) lowest = z, found = k;
  }
  return found;
}

}  // namespace

RunupRecorder::RunupRecorder(const RunHeader& header, const std::vector<Section>& sections,
                             std::vector<double> earliest)
    : header_(header) {
  for (const Section& section : sections) {
    Line line;
    line.stations = section_stations(section, header.particles.origin, header.map.dx / 2);
    for (const Station& s : line.stations) {
      line.bed.push_back(header.particles.bed.height(s.x, s.y));
      line.earliest.push_back(earliest.empty() ? 0 : earliest_near(header.map, earliest, s.x, s.y));
    }
    lines_.push_back(std::move(line));
    SectionRunup runup;
    runup.name = section.name;
    runup.max_elevation = runup.max_height = runup.time_of_max = runup.overtopped = no_value;
    sections_.push_back(std::move(runup));
  }
}

void RunupRecorder::find_bank(Line& line, SectionRunup& section, const std::vector<float>& water) const {
  const std::size_t lowest = lowest_wet_station(header_, line.stations, water);
  if (lowest < line.stations.size()) line.first = lowest;
  const Station& end = line.stations.back();
  section.has_bank = lowest < line.stations.size() && std::isnan(sample_surface(header_.map, water, end.x, end.y)) &&
                     line.bed.back() > header_.particles.still_water_level;
}

void RunupRecorder::add(double time, const std::vector<float>& water) {
  for (std::size_t l = 0; l < lines_.size(); ++l) {
    Line& line = lines_[l];
    SectionRunup& section = sections_[l];
    if (section.time.empty()) {
      find_bank(line, section, water);
      if (section.has_bank) {
        section.max_elevation = header_.particles.still_water_level + header_.particles.origin[2];
        section.max_height = 0;
      }
    }
    double reached = no_value;
    bool by_wave = false;
    if (section.has_bank) {
      const std::size_t end = line.stations.size() - 1;
      std::size_t edge = line.stations.size();
      double surface = no_value;
      for (std::size_t k = line.first; k < line.stations.size(); ++k) {
        const double z = sample_surface(header_.map, water, line.stations[k].x, line.stations[k].y);
        if (std::isnan(z) || (edge < line.stations.size() && line.bed[k] < line.bed[edge])) continue;
        edge = k, surface = z;
      }
      if (edge < line.stations.size()) {
        // A map cell ahead is two stations: on a steep bank the cell that has just fallen dry may rise by more than dp.
        const std::size_t ahead = std::min(edge + 2, end);
        // Over the end of the line the water goes on, no one knows how high.
        const bool level = edge == end || line.bed[ahead] > surface - header_.particles.dp;
        by_wave = time >= line.earliest[edge];
        if (edge == end && by_wave && std::isnan(section.overtopped)) section.overtopped = time;
        reached = (level ? std::max(surface, line.bed[edge]) : line.bed[edge]) + header_.particles.origin[2];
      }
    }
    section.time.push_back(time);
    section.elevation.push_back(reached);
    if (by_wave && !std::isnan(reached) && (std::isnan(section.time_of_max) || !(reached <= section.max_elevation))) {
      section.max_elevation = reached;
      section.max_height = reached - header_.particles.origin[2] - header_.particles.still_water_level;
      section.time_of_max = time;
    }
  }
}

Bank opposite_bank(const RunHeader& header, const Section& section, const std::vector<float>& first_water) {
  const ParticleHeader& p = header.particles;
  const std::vector<Station> stations = section_stations(section, p.origin, header.map.dx / 2);
  const std::size_t lowest = lowest_wet_station(header, stations, first_water);
  Bank bank;
  if (lowest == stations.size()) return bank;
  const auto height = [&](std::size_t k) {  // above still water level
    return ground_of(p).height(stations[k].x, stations[k].y) - p.still_water_level;
  };
  bank.depth = -height(lowest);
  std::size_t foot = lowest, shore = lowest;
  while (shore < stations.size() && !(height(shore) >= 0)) {
    if (height(shore) <= -bank.depth / 2) foot = shore;
    ++shore;
  }
  bank.present = shore < stations.size();
  if (!bank.present) return bank;
  bank.x = stations[shore].x, bank.y = stations[shore].y;
  std::size_t top = shore;
  while (top + 1 < stations.size() && height(top) < bank.depth / 2) ++top;
  bank.slope =
      std::atan2(height(top) - height(foot), stations[top].distance - stations[foot].distance) * 180 / std::numbers::pi;
  return bank;
}

}  // namespace lgiw
