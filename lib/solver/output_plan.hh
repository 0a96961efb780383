// When a run writes what, and how much that will be.
#pragma once

#include <cstdint>
#include <string>

#include "case/case.hh"
#include "files/run_file.hh"

namespace lgiw {

/// Surface rasters at k * interval for k < last, and at the end time; a frame with each `per_frame`-th and the last.
struct OutputSchedule {
  double interval;  // s
  int64_t per_frame, last;
  bool with_frame(int64_t k) const { return k % per_frame == 0 || k == last; }
  int64_t frames() const { return last / per_frame + 1 + (last % per_frame != 0); }
};
OutputSchedule output_schedule(const Case&, double particle_spacing);

/// Nodes of the surface rasters: the middles of cells of output.map_spacing, or of the particle spacing.
SurfaceMap output_map(const Case&, const ParticleHeader&);

/// Bytes on the disk, at most.
struct OutputSize {
  double run;          // the file
  double checkpoints;  // while it runs: the newest, the one before, and the next being written
  double total() const { return run + checkpoints; }
};
/// `moving_bytes`: what the solver holds of particles that move, which a checkpoint does not exceed.
OutputSize output_size(const Case&, const ParticleHeader&, double moving_bytes);

/// One line where `available` bytes for the run in `folder` may be too few, otherwise empty.
std::string space_warning(const OutputSize&, double available, const std::string& folder);

}  // namespace lgiw
