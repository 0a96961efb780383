// The run file: what lgiw-run writes and gauges and deposit-volume read.
//
// VTKHDF temporal PolyData of the moving particles, water first, then soil, in the order of the particles file, the same
// count in every step: /VTKHDF/Points float32 [steps*N,3] local, PointData: Phase uint8 [N] (shared by all steps),
// Velocity float32 [.,3], Pressure float32 (scenes with water), Adps float32 (scenes with soil; 0 on water),
// Lost uint8 (1: has left the domain; its position is the last one inside). Steps/* as VTKHDF wants them.
// Programs need HDF5 1.10 or newer to read it.
// Outside, group /lgiw: the attributes, bed and ground of the particles file (Format = "lgiw-run 1"), and
//   attributes ParticleVolume (dp^D), WallCount, LeftOut (JSON list of strings), Summary (JSON, at the end)
//   /lgiw/soil/InitialPoints float32 [n_soil,3]
//   /lgiw/surface: attributes x0, y0, dx, Count (nt); datasets by map cell (node (i,j) at x0+i*dx, y0+j*dx; ny = 1 in 2-D)
//       time float64 [nt]; water float32 [nt,ny,nx] water-surface elevation, NaN where dry (absent without water);
//       soil float32 [nt,ny,nx] soil-surface elevation, NaN where there is none (absent without soil)
//   /lgiw/maxima: float32 [ny,nx], same map, accumulated while running: elevation (of the water surface), depth, speed
//       (of water), arrival (first time at which the surface differs from the first one, or a dry bed is wet, by more than
//       the arrival threshold, also before any wave can be there; gauges makes its maps of the surfaces; NaN: never),
//       soil_speed (absent without soil). Absent without water except soil_speed.
//   /lgiw/pressure_gauges, where the case has any: attributes Count (nt), Names (one a line); time float64 [nt], the times of
//       the surfaces; one float32 [nt] dataset a gauge, by its name: pressure of the water, Pa; 0 where there is none
//   /lgiw/diagnostics: attribute Count (nd); time float64 [nd], and one float64 [nd] dataset a quantity (the columns of the
//       diagnostics CSV)
// Steps@NSteps and the Count attributes are written at flush(), with all else that it brings to the file: they alone say how
// much of it is valid. In a file whose writer was killed, datasets may be longer than they say.
// Surface series are deflated tiles of at most 128 x 128 nodes of one map, so that a node's series is cheap to read.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "files/particle_file.hh"

namespace lgiw {

/// Rasters by map cell, all [ny,nx].
struct SurfaceMap {
  std::size_t nx = 0, ny = 0;
  double x0 = 0, y0 = 0, dx = 1;
  std::size_t size() const { return nx * ny; }
  double x(std::size_t node) const { return x0 + double(node % nx) * dx; }
  double y(std::size_t node) const { return y0 + double(node / nx) * dx; }
};

struct Frame {
  double time = 0;
  std::vector<float> points;     // [n,3]
  std::vector<float> velocity;   // [n,3]
  std::vector<float> pressure;   // [n] or empty
  std::vector<float> adps;       // [n] or empty
  std::vector<uint8_t> lost;     // [n]
};

struct RunHeader {
  ParticleHeader particles;      // counts.water, counts.soil: the first so many points of a frame
  double particle_volume = 0;
  std::string left_out;          // JSON list of strings
  SurfaceMap map;
  std::vector<float> initial_soil;  // [n_soil,3]
  std::vector<std::string> pressure_gauges;  // their names
};

/// Bytes that a run file takes at most: frames as they are stored, surface rasters as before they are deflated.
double run_file_bytes(const ParticleCounts&, const SurfaceMap&, int64_t frames, int64_t surfaces);

/// Writes a run frame by frame; the file is whole and readable after every flush(), whatever happens to the process before
/// the next one: killed within a flush(), it is brought to the end of that one or the one before by reopen(). The moments
/// of flush() leave no trace in the file. Throws WorkError when arrays have the wrong length or the disk is full. Vectors
/// for what the scene lacks (pressure and water without water, adps and soil without soil) are empty.
class RunWriter {
 public:
  RunWriter(const std::string& path, const RunHeader& header);
  /// Drops what lies behind a checkpoint's counts (and the summary), so that a resumed run ends in the same bytes as an
  /// uninterrupted one. HDF5 cannot take back bytes in place: the part to be kept is replayed, in the order in which it was
  /// once written, into a temporary file that then takes the name `path`; needs that much disk, and leaves the old file as
  /// it was until it is done. The rasters of the maxima are those of the last flush; write_maxima() replaces them.
  static RunWriter reopen(const std::string& path, int64_t frames, int64_t surfaces, int64_t diagnostics);
  void add_frame(const Frame& frame);
  /// `pressures` are those at the header's pressure gauges, in its order.
  void add_surface(double time, const std::vector<float>& water, const std::vector<float>& soil,
                   const std::vector<float>& pressures = {});
  void add_diagnostics(double time, const std::vector<std::pair<std::string, double>>& values);
  void write_maxima(const std::map<std::string, std::vector<float>>& rasters);  // replaces
  void write_summary(const std::string& json);
  int64_t frames() const { return frames_; }
  int64_t surfaces() const { return surfaces_; }
  int64_t diagnostics() const { return diagnostics_; }
  void flush();
  void close();

 private:
  h5::File file_;
  RunHeader header_;
  std::vector<std::string> columns_;  // of the diagnostics
  int64_t frames_ = 0, surfaces_ = 0, diagnostics_ = 0;
};

/// Reads a run lazily. Throws InputError for anything that is not a sound run file: the constructor for the header, sizes,
/// counts and times, the others for the values that they return.
class RunReader {
 public:
  explicit RunReader(const std::string& path);
  const RunHeader& header() const { return header_; }
  std::size_t frame_count() const { return times_.size(); }
  double frame_time(std::size_t k) const { return times_[k]; }
  Frame frame(std::size_t k) const;
  const std::vector<double>& surface_times() const { return surface_times_; }
  bool has_water_surface() const;
  bool has_soil_surface() const;
  std::vector<float> water_surface(std::size_t k) const;   // [ny*nx]
  std::vector<float> soil_surface(std::size_t k) const;
  /// One node's series over all times, read as a column.
  std::vector<float> water_surface_at(std::size_t i, std::size_t j) const;
  std::vector<float> soil_surface_at(std::size_t i, std::size_t j) const;
  std::vector<float> maximum(const std::string& name) const;  // empty when absent
  /// Series of the header's `k`-th pressure gauge at surface_times(), Pa.
  std::vector<float> pressure(std::size_t k) const;
  std::map<std::string, std::vector<double>> diagnostics() const;
  std::string summary() const;   // JSON text, "" while the run is not finished

 private:
  friend class RunWriter;  // reopen() replays
  std::vector<float> surface(const std::string& name, std::size_t k) const;
  std::vector<float> series(const std::string& name, std::size_t i, std::size_t j) const;
  h5::File file_;
  RunHeader header_;
  std::vector<double> times_, surface_times_;
  std::size_t diagnostics_count_ = 0;
};

/// An Xdmf3 sidecar: what ParaView before 5.12 opens instead of the run, which it refers to relative to the sidecar's folder.
void write_xdmf(const std::string& run_path, const std::string& xmf_path, bool overwrite = false);

}  // namespace lgiw
