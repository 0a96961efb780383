// One run of a benchmark: what the tools left in its folder.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "case/case.hh"
#include "files/run_file.hh"

namespace lgiw::validation {

struct Run {
  std::string name;    // series and resolution: "a2-dp5", or "dp5" in the series ""
  std::string folder;  // with run.h5, run.json and what gauges and deposit-volume wrote
  bool quick = false;  // only one of the tests' own
  Case c;
  nlohmann::json summary;
  std::shared_ptr<const RunReader> file;

  /// The name up to the last hyphen, which is followed by the resolution.
  std::string series() const;
  double dp() const { return c.dp; }
  std::size_t particles() const;
  int64_t steps() const { return summary.at("steps"); }
  double wall_time() const { return summary.value("wall_time_s", 0.0); }

  const RunHeader& header() const { return file->header(); }
  std::size_t water_count() const { return std::size_t(header().particles.counts.water); }
  std::size_t soil_count() const { return std::size_t(header().particles.counts.soil); }
  double level() const { return header().particles.still_water_level; }  // local z
  const HeightField& bed() const { return header().particles.bed; }
  double origin(int axis) const { return header().particles.origin[std::size_t(axis)]; }
  /// The stored frame nearest to a time; infinity: the last.
  Frame frame_at(double time) const;
  std::size_t frame_index(double time) const;
  std::size_t surface_index(double time) const;
};

/// The runs that the `list` of a case names and that are there, in its order.
std::vector<Run> load_runs(const std::string& case_folder, const std::string& results_folder,
                           const std::string& list = "runs.txt");

}  // namespace lgiw::validation
