// The particles in a slice along a section line: what moves inside the slide and the water.
#pragma once

#include <string>
#include <vector>

#include "case/case.hh"
#include "files/run_file.hh"

namespace lgiw {

struct SliceParticle {
  double distance, z;  // along the line, m; elevation in the case's vertical datum, m
  bool soil;
  double speed, adps;  // m/s; accumulated plastic strain, NaN of water
};

/// Particles at most a particle spacing beside the line (in 2-D all), water first; those that are lost are left
/// out. Beside a corner of the line a particle may come twice or not at all.
std::vector<SliceParticle> section_slice(const RunHeader& header, const Frame& frame, const Section& section);

}  // namespace lgiw
