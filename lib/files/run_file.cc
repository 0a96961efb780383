#include "files/run_file.hh"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "base/atomic_file.hh"
#include "base/error.hh"
#include "files/vtkhdf.hh"

namespace lgiw {

namespace {

const std::string format = "lgiw-run 1";
const std::string steps = "/VTKHDF/Steps", point_data = "/VTKHDF/PointData/";
constexpr hsize_t series_chunk = 1024;

/// A field of a frame: its dataset, numbers a particle, and whether the scene has it.
struct Field {
  const char* name;
  int width;
  bool present;
};

std::vector<Field> frame_fields(const ParticleCounts& counts) {
  return {{"Velocity", 3, true}, {"Pressure", 1, counts.water > 0}, {"Adps", 1, counts.soil > 0}};
}

std::vector<std::string> maxima_names(const ParticleCounts& counts) {
  std::vector<std::string> names;
  if (counts.water > 0) names = {"elevation", "depth", "speed", "arrival"};
  if (counts.soil > 0) names.push_back("soil_speed");
  return names;
}

std::vector<std::string> surface_names(const ParticleCounts& counts) {
  std::vector<std::string> names;
  if (counts.water > 0) names.push_back("water");
  if (counts.soil > 0) names.push_back("soil");
  return names;
}

const std::string pressure_group = "/lgiw/pressure_gauges";

std::string one_a_line(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += name + "\n";
  return text;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

int64_t moving(const ParticleCounts& counts) { return counts.water + counts.soil; }

h5::Shape rows_shape(hsize_t n, int width) { return width == 1 ? h5::Shape{n} : h5::Shape{n, hsize_t(width)}; }

/// `n` nodes in equal tiles of at most `most`.
hsize_t tile(hsize_t n, hsize_t most) {
  const hsize_t tiles = (n + most - 1) / most;
  return (n + tiles - 1) / tiles;
}

void append_number(h5::File& file, const std::string& name, int64_t value) { file.append(name, &value, {1}); }
void append_number(h5::File& file, const std::string& name, double value) { file.append(name, &value, {1}); }

[[noreturn]] void misused(const h5::File& file, const std::string& what, const std::string& why) {
  throw WorkError("cannot add " + what + " to '" + file.path() + "'", why, "report this as a fault of the program");
}

void require_length(const h5::File& file, const std::string& what, std::size_t length, std::size_t wanted) {
  if (length != wanted) misused(file, what, std::to_string(length) + " values instead of " + std::to_string(wanted));
}

/// Times up to `count`: finite and never falling.
std::vector<double> read_times(const h5::File& file, const std::string& name, int64_t count) {
  std::vector<double> times = read_finite_rows<double>(file, name, 0, count, 1);
  if (!std::is_sorted(times.begin(), times.end())) refuse(file, name, "a time is earlier than the one before it");
  return times;
}

int64_t read_count(const h5::File& file, const std::string& object, const std::string& name) {
  const double value = file.number_attribute(object, name);
  if (!(value >= 0 && value <= 1e12 && value == std::floor(value)))
    refuse(file, object + "@" + name, std::to_string(value) + " is not a count");
  return int64_t(value);
}

}  // namespace

double run_file_bytes(const ParticleCounts& counts, const SurfaceMap& map, int64_t frames, int64_t surfaces) {
  double a_particle = 3 * sizeof(float) + sizeof(uint8_t);  // Points, Lost
  for (const Field& field : frame_fields(counts))
    if (field.present) a_particle += double(field.width) * sizeof(float);
  const double a_raster = double(map.size()) * sizeof(float);
  const double first = double(moving(counts)) * (sizeof(uint8_t) + 2 * sizeof(int64_t)) +  // Phase, Vertices
                       double(counts.soil) * 3 * sizeof(float) + a_raster * double(maxima_names(counts).size());
  const double names = 2e6;  // groups, headers, chunks of series that are not full, bed, ground, case
  const double series = 40 * sizeof(double);
  return first + names + double(frames) * (double(moving(counts)) * a_particle + 20 * sizeof(double)) +
         double(surfaces) * (a_raster * double(surface_names(counts).size()) + series);
}

RunWriter::RunWriter(const std::string& path, const RunHeader& header)
    : file_((check_particle_header(header.particles, path), h5::File::create_journaled(path))), header_(header) {
  const ParticleCounts& counts = header_.particles.counts;
  const hsize_t n = hsize_t(moving(counts));
  const SurfaceMap& map = header_.map;
  if (n == 0) misused(file_, "frames", "the scene has neither water nor soil");
  if (!(header_.particle_volume > 0)) misused(file_, "frames", "the particles have no volume");
  if (map.size() == 0) misused(file_, "surfaces", "the map has no nodes");
  require_length(file_, "initial soil", header_.initial_soil.size(), 3 * std::size_t(counts.soil));

  write_vtkhdf_frame(file_, int64_t(n));
  std::vector<uint8_t> phase(n, uint8_t(Phase::soil));
  std::fill_n(phase.begin(), counts.water, uint8_t(Phase::water));
  file_.write(point_data + "Phase", phase);
  // A frame takes few chunks, of at most 32 MiB of points: HDF5 holds their index in memory while the file is written.
  const hsize_t rows = tile(n, (hsize_t(32) << 20) / (3 * sizeof(float)));
  file_.create_dataset<float>("/VTKHDF/Points", {0, 3}, true, false, {rows, 3});
  for (const Field& field : frame_fields(counts))
    if (field.present)
      file_.create_dataset<float>(point_data + field.name, rows_shape(0, field.width), true, false,
                                  rows_shape(rows, field.width));
  file_.create_dataset<uint8_t>(point_data + "Lost", {0}, true, false, {rows});

  file_.create_dataset<double>(steps + "/Values", {0}, true, false, {series_chunk});
  for (const char* name : {"PartOffsets", "NumberOfParts", "PointOffsets"})
    file_.create_dataset<int64_t>(steps + "/" + name, {0}, true, false, {series_chunk});
  for (const char* name : {"CellOffsets", "ConnectivityIdOffsets"})
    file_.create_dataset<int64_t>(steps + "/" + name, {0, 4}, true, false, {series_chunk, 4});
  for (const std::string& name : file_.children("/VTKHDF/PointData"))
    file_.create_dataset<int64_t>(steps + "/PointDataOffsets/" + name, {0}, true, false, {series_chunk});
  file_.set_attribute(steps, "NSteps", int64_t(0));

  write_particle_header(file_, header_.particles, format);
  file_.set_attribute("/lgiw", "ParticleVolume", header_.particle_volume);
  file_.set_attribute("/lgiw", "WallCount", counts.wall);
  file_.set_attribute("/lgiw", "LeftOut", header_.left_out);
  if (counts.soil > 0) file_.write("/lgiw/soil/InitialPoints", header_.initial_soil.data(), {hsize_t(counts.soil), 3});

  file_.create_dataset<double>("/lgiw/surface/time", {0}, true, false, {series_chunk});
  const hsize_t most = map.ny == 1 ? 16384 : 128;
  for (const std::string& name : surface_names(counts))
    file_.create_dataset<float>("/lgiw/surface/" + name, {0, map.ny, map.nx}, true, true,
                                {1, tile(map.ny, most), tile(map.nx, most)});
  file_.set_attribute("/lgiw/surface", "x0", map.x0);
  file_.set_attribute("/lgiw/surface", "y0", map.y0);
  file_.set_attribute("/lgiw/surface", "dx", map.dx);
  file_.set_attribute("/lgiw/surface", "Count", int64_t(0));
  const std::vector<float> none(map.size(), NAN);
  for (const std::string& name : maxima_names(counts))
    file_.write("/lgiw/maxima/" + name, none.data(), {map.ny, map.nx});
  if (!header_.pressure_gauges.empty()) {
    const std::vector<std::string>& names = header_.pressure_gauges;
    file_.create_dataset<double>(pressure_group + "/time", {0}, true, false, {series_chunk});
    for (const std::string& name : names) {
      if (name.empty() || name == "time" || name.find_first_of("/\n") != std::string::npos ||
          file_.exists(pressure_group + "/" + name))
        misused(file_, "pressures", "'" + name + "' is no name for a new gauge");
      file_.create_dataset<float>(pressure_group + "/" + name, {0}, true, false, {series_chunk});
    }
    file_.set_attribute(pressure_group, "Names", one_a_line(names));
    file_.set_attribute(pressure_group, "Count", int64_t(0));
  }
  file_.create_dataset<double>("/lgiw/diagnostics/time", {0}, true, false, {series_chunk});
  file_.set_attribute("/lgiw/diagnostics", "Count", int64_t(0));
  flush();
}

RunWriter RunWriter::reopen(const std::string& path, int64_t n_frames, int64_t n_surfaces, int64_t n_diagnostics) {
  h5::carry_out_journal(path);
  RunReader old(path);
  const auto require = [&](const std::string& what, int64_t found, int64_t wanted) {
    LGIW_VALIDATE(
        found >= wanted, "cannot continue '" + path + "'",
        "it has " + std::to_string(found) + " " + what + " where the checkpoint has " + std::to_string(wanted),
        "give the run that belongs to the checkpoint");
  };
  require("frames", int64_t(old.frame_count()), n_frames);
  require("surfaces", int64_t(old.surface_times().size()), n_surfaces);
  require("rows of diagnostics", int64_t(old.diagnostics_count_), n_diagnostics);

  // What was added when is told by the places of the chunks. Rows of diagnostics need one only for the first of a
  // chunk, and its other rows move nothing.
  struct Addition {
    haddr_t place;
    enum { frame, surface, diagnostics } kind;
    int64_t index;
  };
  std::vector<Addition> additions;
  const hsize_t n = hsize_t(moving(old.header().particles.counts));
  for (int64_t k = 0; k < n_frames; ++k)
    additions.push_back({old.file_.chunk_address(point_data + "Lost", {hsize_t(k + 1) * n - 1}), Addition::frame, k});
  const std::string surface = "/lgiw/surface/" + surface_names(old.header().particles.counts).front();
  for (int64_t k = 0; k < n_surfaces; ++k)
    additions.push_back({old.file_.chunk_address(surface, {hsize_t(k), 0, 0}), Addition::surface, k});
  for (int64_t k = 0; k < n_diagnostics; k += series_chunk)
    additions.push_back({old.file_.chunk_address("/lgiw/diagnostics/time", {hsize_t(k)}), Addition::diagnostics, k});
  std::stable_sort(additions.begin(), additions.end(),
                   [](const Addition& a, const Addition& b) { return a.place < b.place; });

  std::vector<std::vector<float>> pressures;
  for (std::size_t g = 0; g < old.header().pressure_gauges.size(); ++g) pressures.push_back(old.pressure(g));

  const std::map<std::string, std::vector<double>> rows = old.diagnostics();
  std::vector<std::pair<haddr_t, std::string>> columns;
  for (const auto& [name, values] : rows)
    if (name != "time" && n_diagnostics > 0)
      columns.emplace_back(old.file_.chunk_address("/lgiw/diagnostics/" + name, {0}), name);
  std::sort(columns.begin(), columns.end());

  AtomicFile replacement(path, true);
  RunWriter writer(replacement.temporary(), old.header());
  for (const Addition& addition : additions) {
    const std::size_t k = std::size_t(addition.index);
    if (addition.kind == Addition::frame) {
      writer.add_frame(old.frame(k));
    } else if (addition.kind == Addition::surface) {
      std::vector<float> at_gauges;
      for (const std::vector<float>& series : pressures) at_gauges.push_back(series[k]);
      writer.add_surface(old.surface_times()[k], old.has_water_surface() ? old.water_surface(k) : std::vector<float>(),
                         old.has_soil_surface() ? old.soil_surface(k) : std::vector<float>(), at_gauges);
    } else {
      for (std::size_t row = k; row < std::min<std::size_t>(k + series_chunk, std::size_t(n_diagnostics)); ++row) {
        std::vector<std::pair<std::string, double>> values;
        for (const auto& column : columns) values.emplace_back(column.second, rows.at(column.second)[row]);
        writer.add_diagnostics(rows.at("time")[row], values);
      }
    }
  }
  std::map<std::string, std::vector<float>> maxima;
  for (const std::string& name : maxima_names(old.header().particles.counts)) maxima[name] = old.maximum(name);
  writer.write_maxima(maxima);
  writer.flush();
  replacement.commit();
  writer.file_.renamed(path);
  return writer;
}

void RunWriter::add_frame(const Frame& frame) {
  const ParticleCounts& counts = header_.particles.counts;
  const std::size_t n = std::size_t(moving(counts));
  require_length(file_, "points", frame.points.size(), 3 * n);
  require_length(file_, "velocities", frame.velocity.size(), 3 * n);
  require_length(file_, "pressures", frame.pressure.size(), counts.water > 0 ? n : 0);
  require_length(file_, "plastic strains", frame.adps.size(), counts.soil > 0 ? n : 0);
  require_length(file_, "flags of lost particles", frame.lost.size(), n);

  file_.append("/VTKHDF/Points", frame.points.data(), {n, 3});
  file_.append(point_data + "Velocity", frame.velocity.data(), {n, 3});
  if (counts.water > 0) file_.append(point_data + "Pressure", frame.pressure.data(), {n});
  if (counts.soil > 0) file_.append(point_data + "Adps", frame.adps.data(), {n});
  file_.append(point_data + "Lost", frame.lost.data(), {n});

  // One part a step, always the first: topology and phases are those of step 0.
  const int64_t offset = frames_ * int64_t(n), zeros[4] = {0, 0, 0, 0};
  append_number(file_, steps + "/Values", frame.time);
  append_number(file_, steps + "/PartOffsets", int64_t(0));
  append_number(file_, steps + "/NumberOfParts", int64_t(1));
  append_number(file_, steps + "/PointOffsets", offset);
  file_.append(steps + "/CellOffsets", zeros, {1, 4});
  file_.append(steps + "/ConnectivityIdOffsets", zeros, {1, 4});
  for (const std::string& name : file_.children("/VTKHDF/PointData"))
    append_number(file_, steps + "/PointDataOffsets/" + name, name == "Phase" ? 0 : offset);
  ++frames_;
}

void RunWriter::add_surface(double time, const std::vector<float>& water, const std::vector<float>& soil,
                            const std::vector<float>& pressures) {
  const ParticleCounts& counts = header_.particles.counts;
  const SurfaceMap& map = header_.map;
  require_length(file_, "a water surface", water.size(), counts.water > 0 ? map.size() : 0);
  require_length(file_, "a soil surface", soil.size(), counts.soil > 0 ? map.size() : 0);
  require_length(file_, "pressures", pressures.size(), header_.pressure_gauges.size());
  if (counts.water > 0) file_.append("/lgiw/surface/water", water.data(), {1, map.ny, map.nx});
  if (counts.soil > 0) file_.append("/lgiw/surface/soil", soil.data(), {1, map.ny, map.nx});
  append_number(file_, "/lgiw/surface/time", time);
  if (!pressures.empty()) {
    for (std::size_t g = 0; g < pressures.size(); ++g)
      file_.append(pressure_group + "/" + header_.pressure_gauges[g], &pressures[g], {1});
    append_number(file_, pressure_group + "/time", time);
  }
  ++surfaces_;
}

void RunWriter::add_diagnostics(double time, const std::vector<std::pair<std::string, double>>& values) {
  if (diagnostics_ == 0) {
    for (const auto& [name, value] : values) {
      if (name.empty() || name == "time" || name.find('/') != std::string::npos ||
          std::find(columns_.begin(), columns_.end(), name) != columns_.end())
        misused(file_, "diagnostics", "'" + name + "' is no name for a new column");
      columns_.push_back(name);
      file_.create_dataset<double>("/lgiw/diagnostics/" + name, {0}, true, false, {series_chunk});
    }
    // HDF5 gives the heap of a group with many members its place in the file at the next flush only: now, then, and not
    // at a moment that differs from run to run.
    file_.flush();
  }
  if (!std::equal(values.begin(), values.end(), columns_.begin(), columns_.end(),
                  [](const auto& value, const std::string& name) { return value.first == name; }))
    misused(file_, "diagnostics", "the columns are not those of the first row");
  append_number(file_, "/lgiw/diagnostics/time", time);
  for (const auto& [name, value] : values) append_number(file_, "/lgiw/diagnostics/" + name, value);
  ++diagnostics_;
}

void RunWriter::write_maxima(const std::map<std::string, std::vector<float>>& rasters) {
  const SurfaceMap& map = header_.map;
  const std::vector<std::string> names = maxima_names(header_.particles.counts);
  for (const auto& [name, raster] : rasters) {
    if (std::find(names.begin(), names.end(), name) == names.end())
      misused(file_, "the maximum '" + name + "'", "the scene has none of that name");
    require_length(file_, "the maximum '" + name + "'", raster.size(), map.size());
    file_.write_slab("/lgiw/maxima/" + name, raster.data(), {0, 0}, {map.ny, map.nx});
  }
}

void RunWriter::write_summary(const std::string& json) { file_.set_attribute("/lgiw", "Summary", json); }

void RunWriter::flush() {
  file_.set_attribute(steps, "NSteps", frames_);
  file_.set_attribute("/lgiw/surface", "Count", surfaces_);
  if (!header_.pressure_gauges.empty()) file_.set_attribute(pressure_group, "Count", surfaces_);
  file_.set_attribute("/lgiw/diagnostics", "Count", diagnostics_);
  file_.flush();
}

void RunWriter::close() {
  flush();
  file_.close();
}

RunReader::RunReader(const std::string& path) : file_(h5::File::open_read(path)) {
  header_.particles = read_header(file_, format, "a run file", "lgiw-run");
  const ParticleCounts& counts = header_.particles.counts;
  const int64_t n = moving(counts);
  if (n == 0) refuse(file_, "/lgiw@Counts", "there is neither water nor soil");
  header_.particle_volume = file_.number_attribute("/lgiw", "ParticleVolume");
  if (!(std::isfinite(header_.particle_volume) && header_.particle_volume > 0))
    refuse(file_, "/lgiw@ParticleVolume", std::to_string(header_.particle_volume) + " is not above 0");
  header_.left_out = file_.text_attribute("/lgiw", "LeftOut");
  header_.initial_soil = read_finite_rows<float>(file_, "/lgiw/soil/InitialPoints", 0, counts.soil, 3);

  const std::vector<uint8_t> phases = read_finite_rows<uint8_t>(file_, point_data + "Phase", 0, n, 1);
  for (int64_t k = 0; k < n; ++k) {
    const Phase wanted = k < counts.water ? Phase::water : Phase::soil;
    if (phases[std::size_t(k)] != uint8_t(wanted))
      refuse(file_, point_data + "Phase",
             "particle " + std::to_string(k) + " has phase " + std::to_string(phases[std::size_t(k)]) +
                 " where /lgiw@Counts says " + std::to_string(int(wanted)));
  }

  const auto require_rows = [&](const std::string& name, int64_t rows, int64_t width) {
    const h5::Shape shape = file_.shape(name);
    if (shape.empty() || shape[0] / hsize_t(width) < hsize_t(rows))
      refuse(file_, name, "it is shorter than the " + std::to_string(rows) + " rows that are counted");
  };
  const int64_t n_frames = read_count(file_, steps, "NSteps");
  times_ = read_times(file_, steps + "/Values", n_frames);
  for (const Field& field : frame_fields(counts))
    if (field.present) require_rows(point_data + field.name, n_frames, n);
  require_rows("/VTKHDF/Points", n_frames, n);
  require_rows(point_data + "Lost", n_frames, n);

  SurfaceMap& map = header_.map;
  map.x0 = file_.number_attribute("/lgiw/surface", "x0");
  map.y0 = file_.number_attribute("/lgiw/surface", "y0");
  map.dx = file_.number_attribute("/lgiw/surface", "dx");
  if (!(std::isfinite(map.x0) && std::isfinite(map.y0) && std::isfinite(map.dx) && map.dx > 0))
    refuse(file_, "/lgiw/surface", "x0, y0 and dx must be finite and dx above 0");
  // The rasters of the maxima say how large the map is: unlike the series, they are in the file from the start.
  const h5::Shape raster = file_.shape("/lgiw/maxima/" + maxima_names(counts).front());
  if (raster.size() != 2 || raster[0] == 0 || raster[1] == 0) refuse(file_, "/lgiw/maxima", "they are not rasters");
  map.ny = raster[0];
  map.nx = raster[1];
  for (const std::string& name : maxima_names(counts))
    if (file_.shape("/lgiw/maxima/" + name) != raster)
      refuse(file_, "/lgiw/maxima/" + name, "its size is not that of the other maxima");
  const int64_t n_surfaces = read_count(file_, "/lgiw/surface", "Count");
  surface_times_ = read_times(file_, "/lgiw/surface/time", n_surfaces);
  for (const std::string& name : surface_names(counts)) {
    const h5::Shape shape = file_.shape("/lgiw/surface/" + name);
    if (shape.size() != 3 || shape[1] != raster[0] || shape[2] != raster[1])
      refuse(file_, "/lgiw/surface/" + name, "its maps have not the size of the maxima");
    require_rows("/lgiw/surface/" + name, n_surfaces, 1);
  }
  if (file_.exists(pressure_group)) {
    header_.pressure_gauges = lines_of(file_.text_attribute(pressure_group, "Names"));
    // Written with the surfaces.
    if (read_count(file_, pressure_group, "Count") != n_surfaces)
      refuse(file_, pressure_group + "@Count", "it is not that of the surfaces");
    for (const std::string& name : header_.pressure_gauges) require_rows(pressure_group + "/" + name, n_surfaces, 1);
  }
  diagnostics_count_ = std::size_t(read_count(file_, "/lgiw/diagnostics", "Count"));
  for (const std::string& name : file_.children("/lgiw/diagnostics"))
    require_rows("/lgiw/diagnostics/" + name, int64_t(diagnostics_count_), 1);
}

Frame RunReader::frame(std::size_t k) const {
  LGIW_EXPECT(k < times_.size());
  const ParticleCounts& counts = header_.particles.counts;
  const int64_t n = moving(counts), start = int64_t(k) * n;
  Frame frame;
  frame.time = times_[k];
  frame.points = read_finite_rows<float>(file_, "/VTKHDF/Points", start, n, 3);
  frame.velocity = read_finite_rows<float>(file_, point_data + "Velocity", start, n, 3);
  if (counts.water > 0) frame.pressure = read_finite_rows<float>(file_, point_data + "Pressure", start, n, 1);
  if (counts.soil > 0) frame.adps = read_finite_rows<float>(file_, point_data + "Adps", start, n, 1);
  frame.lost = read_finite_rows<uint8_t>(file_, point_data + "Lost", start, n, 1);
  for (std::size_t row = 0; row < frame.lost.size(); ++row)
    if (frame.lost[row] > 1)
      refuse(file_, point_data + "Lost", "that of row " + std::to_string(start + int64_t(row)) + " is neither 0 nor 1");
  return frame;
}

bool RunReader::has_water_surface() const { return header_.particles.counts.water > 0; }

bool RunReader::has_soil_surface() const { return header_.particles.counts.soil > 0; }

std::vector<float> RunReader::surface(const std::string& name, std::size_t k) const {
  LGIW_EXPECT(k < surface_times_.size());
  const SurfaceMap& map = header_.map;
  std::vector<float> values(map.size());
  file_.read_slab("/lgiw/surface/" + name, values.data(), {k, 0, 0}, {1, map.ny, map.nx});
  return values;
}

std::vector<float> RunReader::series(const std::string& name, std::size_t i, std::size_t j) const {
  LGIW_EXPECT(i < header_.map.nx && j < header_.map.ny);
  std::vector<float> values(surface_times_.size());
  file_.read_slab("/lgiw/surface/" + name, values.data(), {0, j, i}, {values.size(), 1, 1});
  return values;
}

std::vector<float> RunReader::water_surface(std::size_t k) const { return surface("water", k); }

std::vector<float> RunReader::soil_surface(std::size_t k) const { return surface("soil", k); }

std::vector<float> RunReader::water_surface_at(std::size_t i, std::size_t j) const { return series("water", i, j); }

std::vector<float> RunReader::soil_surface_at(std::size_t i, std::size_t j) const { return series("soil", i, j); }

std::vector<float> RunReader::maximum(const std::string& name) const {
  const std::string object = "/lgiw/maxima/" + name;
  return file_.exists(object) ? file_.read<float>(object) : std::vector<float>();
}

std::vector<float> RunReader::pressure(std::size_t k) const {
  LGIW_EXPECT(k < header_.pressure_gauges.size());
  return read_finite_rows<float>(file_, pressure_group + "/" + header_.pressure_gauges[k], 0,
                                 int64_t(surface_times_.size()), 1);
}

std::map<std::string, std::vector<double>> RunReader::diagnostics() const {
  std::map<std::string, std::vector<double>> columns;
  for (const std::string& name : file_.children("/lgiw/diagnostics")) {
    std::vector<double>& column = columns[name];
    column.resize(diagnostics_count_);
    file_.read_slab("/lgiw/diagnostics/" + name, column.data(), {0}, {diagnostics_count_});
  }
  return columns;
}

std::string RunReader::summary() const {
  return file_.has_attribute("/lgiw", "Summary") ? file_.text_attribute("/lgiw", "Summary") : "";
}

void write_xdmf(const std::string& run_path, const std::string& xmf_path, bool overwrite) {
  const RunReader run(run_path);
  const ParticleCounts& counts = run.header().particles.counts;
  const std::string n = std::to_string(moving(counts)),
                    all = std::to_string(moving(counts) * int64_t(run.frame_count()));
  namespace fs = std::filesystem;
  const fs::path folder = fs::absolute(xmf_path).parent_path();
  std::string file;
  for (char c : fs::absolute(run_path).lexically_relative(folder).string())
    file += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);

  std::ostringstream xml;
  xml.precision(17);
  // Rows `start` to start + n of a dataset of `width` numbers a row: start, stride, count and full size, a number an
  // axis.
  const auto item = [&](const std::string& dataset, int64_t start, const std::string& rows, int width,
                        const std::string& type) {
    const std::string w = std::to_string(width), dims = width == 1 ? n : n + " " + w;
    xml << "<DataItem Format=\"HDF\" " << type << " Dimensions=\"" << dims << "\">" << file << ":" << dataset << "|"
        << start;
    if (width == 1)
      xml << ":1:" << n << ":" << rows;
    else
      xml << " 0:1 1:" << n << " " << w << ":" << rows << " " << w;
    xml << "</DataItem>";
  };
  const std::string float_type = "NumberType=\"Float\" Precision=\"4\"",
                    byte_type = "NumberType=\"UChar\" Precision=\"1\"", id_type = "NumberType=\"Int\" Precision=\"8\"";
  xml << "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n"
      << "<Grid Name=\"run\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  for (std::size_t k = 0; k < run.frame_count(); ++k) {
    const int64_t start = int64_t(k) * moving(counts);
    const auto attribute = [&](const std::string& name, int64_t first, const std::string& rows, int width,
                               const std::string& type) {
      xml << "<Attribute Name=\"" << name << "\" AttributeType=\"" << (width == 3 ? "Vector" : "Scalar")
          << "\" Center=\"Node\">";
      item(point_data + name, first, rows, width, type);
      xml << "</Attribute>\n";
    };
    xml << "<Grid Name=\"particles\" GridType=\"Uniform\">\n<Time Value=\"" << run.frame_time(k) << "\"/>\n"
        << "<Topology TopologyType=\"Polyvertex\" NumberOfElements=\"" << n << "\" NodesPerElement=\"1\">";
    item("/VTKHDF/Vertices/Connectivity", 0, n, 1, id_type);
    xml << "</Topology>\n<Geometry GeometryType=\"XYZ\">";
    item("/VTKHDF/Points", start, all, 3, float_type);
    xml << "</Geometry>\n";
    for (const Field& field : frame_fields(counts))
      if (field.present) attribute(field.name, start, all, field.width, float_type);
    attribute("Lost", start, all, 1, byte_type);
    attribute("Phase", 0, n, 1, byte_type);
    xml << "</Grid>\n";
  }
  xml << "</Grid>\n</Domain>\n</Xdmf>\n";
  write_text_file(xmf_path, xml.str(), overwrite);
}

}  // namespace lgiw
