// Gauge series as netCDF after the CF conventions.
#pragma once

#include <string>
#include <vector>

#include "files/particle_file.hh"
#include "measure/gauge_series.hh"

namespace lgiw {

/// Writes a CF-1.8 discrete-sampling file of featureType timeSeries (orthogonal representation: one time axis for all
/// stations). Throws InputError when it exists and `overwrite` is false, WorkError when it cannot be written.
/// `case_name` and `provenance` become attributes; an empty provenance is left out.
void write_gauge_netcdf(const std::string& path, const ParticleHeader& header, const std::vector<GaugeSeries>& series,
                        const std::string& case_name, const std::string& provenance, bool overwrite);

}  // namespace lgiw
