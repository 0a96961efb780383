// Run-up on the opposite bank along section lines.
#pragma once

#include <string>
#include <vector>

#include "case/case.hh"
#include "files/run_file.hh"
#include "measure/surface_sampling.hh"

namespace lgiw {

struct SectionRunup {
  std::string name;
  bool has_bank = false;          // whether the line leaves the lake at its far end
  std::vector<double> time;       // s
  std::vector<double> elevation;  // highest bed reached by water on the opposite bank, case datum; NaN without a bank
  /// Height above still water level; NaN without a bank. 0 where nothing has reached the bank as yet, without a time.
  double max_elevation = 0, max_height = 0, time_of_max = 0;
  double overtopped = 0;  // s: when water first stands at the line's end, whence run-up is a lower bound; NaN: never
};

/// Follows the water's edge along section lines from the slide to the opposite bank. That bank is the part of the line
/// beyond the lowest ground that is under water at the first time, provided that the line ends on dry land. The edge
/// lies at the wet place with the highest bed; run-up is the water surface there carried level to the bank, since water
/// less than half of dp deep is not seen (a lake at rest has run-up 0), or the bed itself before a front steeper than
/// that. The largest does not count what the surface there does before `earliest` (earliest_arrival.hh), which may be
/// empty.
class RunupRecorder {
 public:
  RunupRecorder(const RunHeader& header, const std::vector<Section>& sections, std::vector<double> earliest = {});
  /// The next water surface, [ny,nx] local.
  void add(double time, const std::vector<float>& water);
  const std::vector<SectionRunup>& sections() const { return sections_; }

 private:
  struct Line {
    std::vector<Station> stations;
    std::vector<double> bed;  // local
    std::vector<double> earliest;
    std::size_t first = 0;  // of the opposite bank
  };
  void find_bank(Line& line, SectionRunup& section, const std::vector<float>& water) const;

  const RunHeader& header_;
  std::vector<Line> lines_;
  std::vector<SectionRunup> sections_;
};

/// The opposite bank of a section line as a wave meets it.
struct Bank {
  bool present = false;
  double x = 0, y = 0;  // local: where the still water ends
  double depth = 0;     // m: greatest still water depth on the line
  double slope = 0;  // degrees: mean from half that depth below still water level to as much above, or the line's end
};
Bank opposite_bank(const RunHeader& header, const Section& section, const std::vector<float>& first_water);

}  // namespace lgiw
