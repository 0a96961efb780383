// Restart state on disk: always one whole file, checksummed, replaced only by a newer whole one.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "solver/simulation.hh"

namespace lgiw {

struct Checkpoint {
  std::string identity;  // SHA-256 over what the run depends on; a checkpoint of another run is refused
  int64_t outputs = 0;   // surface times written so far
  int64_t frames = 0, surfaces = 0, diagnostics = 0;
  double wall_time = 0;                              // s spent before
  std::map<std::string, double> extremes;            // running maxima of the summary
  std::map<std::string, std::vector<float>> maxima;  // rasters
  std::vector<float> initial_elevation;
  std::vector<RawArray> arrays;  // Simulation::save()
};

/// Writes to a temporary file, keeps the present `path` as `path` + ".previous", and renames.
void write_checkpoint(const std::string& path, const Checkpoint& checkpoint);
/// Throws InputError when the file is damaged (checksum) or belongs to another run.
Checkpoint read_checkpoint(const std::string& path, const std::string& identity);
/// The newest sound one of `path` and its predecessor; a damaged newer one is reported through `note`.
Checkpoint read_newest_checkpoint(const std::string& path, const std::string& identity, std::string* note);
std::string previous_checkpoint(const std::string& path);

}  // namespace lgiw
