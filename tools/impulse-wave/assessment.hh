// Empirical estimates at the places that a user asks for, beside what a run has there.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "files/run_file.hh"
#include "measure/empirical_wave.hh"
#include "measure/slide_entry.hh"

namespace lgiw {

/// One quantity by one formula.
struct PlaceEstimate {
  std::string quantity;  // with its unit at the end, such as first_crest_m
  Formula formula;
  double predicted = 0;
  double simulated = no_value;  // NaN: the run has none, or there is no run
  BrokenLimits broken;
};

struct Place {
  std::string kind;                   // impact, gauge, distance, bank
  std::string name;                   // of the gauge or section
  double distance = 0, angle = 0;     // m from the impact, degrees off the slide's axis
  bool near = false;                  // inside the impact zone of VAW 254, where its largest wave is printed
  double x = no_value, y = no_value;  // in the case's CRS
  double bank_slope = no_value, depth = no_value;  // of a bank: degrees, m
  std::vector<PlaceEstimate> estimates;
  /// Of a gauge of the run: its largest crest, whichever it is, and the first arrival.
  double largest_crest = no_value, time_of_largest = no_value, arrival = no_value;
};

/// Everything that the tool tells.
struct Assessment {
  bool channel = false, per_metre = false;  // 2-D formulas; of a channel without a width
  SlideImpact impact;                       // NaN where neither measured nor given
  bool complete = false;                    // whether all of it is known, and so there are places
  std::vector<std::string> given;           // the numbers that came from the command line
  std::string run, case_name;               // "" without
  std::optional<SlideEntry> entry;          // as measured in the run
  WaterAhead water;                         // before it
  double drop = no_value, travel_slope = no_value, friction_angle = no_value;  // what Koerner's speed is of
  Estimate koerner{no_value, {}};
  std::vector<Place> places;
  std::vector<std::string> notes;  // what a reader should know, a sentence each
};

/// The largest wave, at the impact.
Place impact_place(const Assessment& a);
/// Waves at a distance; times count from `start`, s.
Place wave_place(const Assessment& a, const std::string& kind, const std::string& name, double distance, double angle,
                 double start);
/// Run-up on a bank of `slope` degrees there, over a depth of `depth`.
Place bank_place(const Assessment& a, const std::string& name, double distance, double angle, double slope,
                 double depth);

/// Adds the gauges and the opposite banks of a run, with what it measured there; the banks on the case's sections, and
/// without any the one on the slide's axis.
void add_run_places(Assessment& a, const RunReader& run, const Case& c);

/// Every limit that is broken, once for each formula, as lines: "VAW 254 (Evers et al. 2019, 3-D): F 0.31 is not from
/// 0.4 to 3.4".
std::vector<std::string> limit_lines(const Assessment& a);

}  // namespace lgiw
