// What particles files and run files have in common: the frame of a VTKHDF PolyData file, and the header in /lgiw.
#pragma once

#include <cstdint>
#include <string>

#include "files/h5.hh"
#include "files/particle_file.hh"

namespace lgiw {

/// Group /VTKHDF with Version and Type, NumberOfPoints, one vertex cell a point, and empty lines, polygons and strips.
void write_vtkhdf_frame(h5::File& file, int64_t n_points);

/// Throws InputError with `path` when a header's values contradict each other.
void check_particle_header(const ParticleHeader& header, const std::string& path);

/// Attributes of /lgiw, bed and ground. `format` goes into the attribute Format.
void write_particle_header(h5::File& file, const ParticleHeader& header, const std::string& format);

/// Reads and checks them. `what` and `maker` are for the error: "a particles file", "dem2particles".
ParticleHeader read_header(const h5::File& file, const std::string& format, const std::string& what,
                           const std::string& maker);

/// Reads `n` rows of `width` numbers from row `start`; InputError unless the dataset has that width and all are finite.
template <class T>
std::vector<T> read_finite_rows(const h5::File& file, const std::string& name, int64_t start, int64_t n, int width);

/// InputError `problem` with the file in it, for contents that disagree.
[[noreturn]] void refuse(const h5::File& file, const std::string& problem, const std::string& why);

}  // namespace lgiw
