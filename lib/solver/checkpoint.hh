// Restart state on disk: always one whole file, sealed with a digest of all its bytes, replaced only by a newer whole
// one.
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
  std::vector<std::string> retakes;  // what was said of failed steps
  std::vector<RawArray> arrays;      // Simulation::save()
};

/// Writes to a temporary file, brings it to the disk, and gives it the name; what had it is kept as `path` +
/// ".previous".
void write_checkpoint(const std::string& path, const Checkpoint& checkpoint);
/// Throws InputError when the file is damaged (told by its digest, before HDF5 sees it) or belongs to another run.
Checkpoint read_checkpoint(const std::string& path, const std::string& identity);
/// The newest sound one of `path` and its predecessor; a damaged newer one is reported through `note`.
Checkpoint read_newest_checkpoint(const std::string& path, const std::string& identity, std::string* note);
std::string previous_checkpoint(const std::string& path);
/// Appends the digest without which read_checkpoint() takes a file for damaged.
void seal_checkpoint(const std::string& path);

}  // namespace lgiw
