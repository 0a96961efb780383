#include "files/particle_file.hh"

#include <algorithm>
#include <cmath>

#include "base/error.hh"
#include "files/vtkhdf.hh"

namespace lgiw {

namespace {

const std::string format = "lgiw-particles 1";
const std::string velocity_name = "/VTKHDF/PointData/Velocity";
const char* const phase_names[] = {"water", "soil", "wall"};

std::array<int64_t, 3> by_phase(const ParticleCounts& counts) { return {counts.water, counts.soil, counts.wall}; }

void require_rows(const h5::File& file, const std::string& name, int64_t n) {
  const h5::Shape shape = file.shape(name);
  const hsize_t rows = shape.empty() ? 0 : shape[0];
  if (rows != hsize_t(n))
    refuse(file, name, "it has " + std::to_string(rows) + " rows where /lgiw@Counts says " + std::to_string(n));
}

h5::File open_particles(const std::string& path, ParticleHeader& header) {
  h5::File file = h5::File::open_read(path);
  header = read_header(file, format, "a particles file", "dem2particles");
  const ParticleCounts& counts = header.counts;
  for (const char* name : {"Points", "PointData/Phase", "PointData/Volume", "PointData/Density", "PointData/Pressure"})
    require_rows(file, std::string("/VTKHDF/") + name, counts.total());
  if (counts.soil > 0) require_rows(file, "/lgiw/soil/Stress", counts.soil);
  if (counts.wall > 0) require_rows(file, "/lgiw/wall/Normal", counts.wall);
  if (counts.wall > 0) require_rows(file, "/lgiw/wall/Kind", counts.wall);
  if (counts.wall > 0 && !header.bodies.empty()) require_rows(file, "/lgiw/wall/Body", counts.wall);
  header.initial_velocity = file.exists(velocity_name);
  if (header.initial_velocity) require_rows(file, velocity_name, counts.total());
  return file;
}

void check_phases(const h5::File& file, Phase phase, int64_t start, int64_t n) {
  const std::vector<uint8_t> phases = read_finite_rows<uint8_t>(file, "/VTKHDF/PointData/Phase", start, n, 1);
  for (int64_t k = 0; k < n; ++k) {
    if (phases[k] == uint8_t(phase)) continue;
    const std::string which = "particle " + std::to_string(start + k);
    if (phases[k] > 2)
      refuse(file, "/VTKHDF/PointData/Phase", which + " has the unknown phase " + std::to_string(phases[k]));
    refuse(file, "/VTKHDF/PointData/Phase",
           which + " is " + phase_names[phases[k]] + " where /lgiw@Counts says " + phase_names[int(phase)]);
  }
}

void check_positive(const h5::File& file, const std::string& name, int64_t start, const std::vector<float>& values) {
  for (std::size_t k = 0; k < values.size(); ++k)
    if (!(values[k] > 0))
      refuse(file, name, "that of particle " + std::to_string(start + int64_t(k)) + " is " + std::to_string(values[k]));
}

void check_inside(const h5::File& file, const ParticleHeader& header, int64_t start,
                  const std::vector<double>& points) {
  const double slack = 1e-6 * header.dp;  // for coordinates computed as low + k dp
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double low = header.low[k % 3], high = header.high[k % 3];
    if (points[k] < low - slack || points[k] > high + slack)
      refuse(file, "/VTKHDF/Points",
             "particle " + std::to_string(start + int64_t(k / 3)) + " lies outside the domain, " + "xyz"[k % 3] +
                 " = " + std::to_string(points[k]) + " is not from " + std::to_string(low) + " to " +
                 std::to_string(high));
  }
}

/// Velocities of water and soil; empty where all are at rest.
std::vector<float> read_velocities(const h5::File& file, Phase phase, int64_t start, int64_t n) {
  std::vector<float> velocity = read_finite_rows<float>(file, velocity_name, start, n, 3);
  const auto moving = std::find_if(velocity.begin(), velocity.end(), [](float v) { return v != 0; });
  if (moving == velocity.end()) return {};
  if (phase == Phase::wall)
    refuse(file, velocity_name, "wall particle " + std::to_string((moving - velocity.begin()) / 3) + " has one");
  return velocity;
}

/// Which bodies wall particles move with: exactly those of kind 2 with one.
std::vector<uint8_t> read_bodies(const h5::File& file, const std::vector<uint8_t>& kind, std::size_t bodies) {
  std::vector<uint8_t> body = read_finite_rows<uint8_t>(file, "/lgiw/wall/Body", 0, int64_t(kind.size()), 1);
  for (std::size_t k = 0; k < body.size(); ++k) {
    const std::string which = "that of wall particle " + std::to_string(k) + " is " + std::to_string(body[k]);
    if (body[k] > bodies)
      refuse(file, "/lgiw/wall/Body", which + " where /lgiw/bodies holds " + std::to_string(bodies));
    if ((body[k] > 0) != (kind[k] == 2))
      refuse(file, "/lgiw/wall/Body", which + " where its Kind is " + std::to_string(kind[k]));
  }
  return body;
}

ParticleBlock read_block(const h5::File& file, const ParticleHeader& header, Phase phase, int64_t start, int64_t n) {
  ParticleBlock block;
  block.phase = phase;
  if (n == 0) return block;
  check_phases(file, phase, start, n);
  block.points = read_finite_rows<double>(file, "/VTKHDF/Points", start, n, 3);
  if (phase != Phase::wall) check_inside(file, header, start, block.points);
  block.volume = read_finite_rows<float>(file, "/VTKHDF/PointData/Volume", start, n, 1);
  check_positive(file, "/VTKHDF/PointData/Volume", start, block.volume);
  block.density = read_finite_rows<float>(file, "/VTKHDF/PointData/Density", start, n, 1);
  check_positive(file, "/VTKHDF/PointData/Density", start, block.density);
  block.pressure = read_finite_rows<float>(file, "/VTKHDF/PointData/Pressure", start, n, 1);
  if (header.initial_velocity) block.velocity = read_velocities(file, phase, start, n);
  if (phase == Phase::soil) block.stress = read_finite_rows<float>(file, "/lgiw/soil/Stress", 0, n, 6);
  if (phase == Phase::wall) {
    block.normal = read_finite_rows<float>(file, "/lgiw/wall/Normal", 0, n, 3);
    for (int64_t k = 0; k < n; ++k) {
      const float* v = &block.normal[std::size_t(3 * k)];
      if (std::abs(std::hypot(v[0], v[1], v[2]) - 1) > 1e-3)
        refuse(file, "/lgiw/wall/Normal", "that of wall particle " + std::to_string(k) + " is not a unit vector");
    }
    block.kind = read_finite_rows<uint8_t>(file, "/lgiw/wall/Kind", 0, n, 1);
    for (int64_t k = 0; k < n; ++k)
      if (block.kind[std::size_t(k)] > (header.bodies.empty() ? 1 : 2))
        refuse(file, "/lgiw/wall/Kind",
               "that of wall particle " + std::to_string(k) +
                   (header.bodies.empty() ? " is neither 0 (bed) nor 1 (side)" : " is not 0 (bed), 1 (side) or 2 (body)"));
    if (!header.bodies.empty()) block.body = read_bodies(file, block.kind, header.bodies.size());
  }
  return block;
}

}  // namespace

ParticleWriter::ParticleWriter(const std::string& path, const ParticleHeader& header)
    : file_((check_particle_header(header, path), h5::File::create(path))), header_(header) {
  const ParticleCounts& counts = header_.counts;
  const hsize_t n = hsize_t(counts.total());
  write_vtkhdf_frame(file_, counts.total());
  file_.create_dataset<double>("/VTKHDF/Points", {n, 3});
  file_.create_dataset<uint8_t>("/VTKHDF/PointData/Phase", {n});
  for (const char* name : {"Volume", "Density", "Pressure"})
    file_.create_dataset<float>(std::string("/VTKHDF/PointData/") + name, {n});
  if (header_.initial_velocity) file_.create_dataset<float>(velocity_name, {n, 3});
  write_particle_header(file_, header_, format);
  file_.set_attribute("/lgiw", "LeftOut", "{\"wall_particles\": " + std::to_string(counts.wall_left_out) + "}");
  if (counts.soil > 0) file_.create_dataset<float>("/lgiw/soil/Stress", {hsize_t(counts.soil), 6});
  if (counts.wall > 0) {
    file_.create_dataset<float>("/lgiw/wall/Normal", {hsize_t(counts.wall), 3});
    file_.create_dataset<uint8_t>("/lgiw/wall/Kind", {hsize_t(counts.wall)});
    if (!header_.bodies.empty()) file_.create_dataset<uint8_t>("/lgiw/wall/Body", {hsize_t(counts.wall)});
  }
}

void ParticleWriter::append(const ParticleBlock& block) {
  const std::size_t n = block.size();
  const int p = int(block.phase);
  const auto disagree = [&](const std::string& why) {
    throw WorkError(
        "cannot add " + std::to_string(n) + " particles of " + phase_names[p] + " to '" + file_.path() + "'", why,
        "report this as a fault of the program");
  };
  if (block.points.size() != 3 * n || block.density.size() != n || block.pressure.size() != n ||
      block.stress.size() != (block.phase == Phase::soil ? 6 * n : 0) ||
      block.normal.size() != (block.phase == Phase::wall ? 3 * n : 0) ||
      block.kind.size() != (block.phase == Phase::wall ? n : 0))
    disagree("their arrays differ in length");
  const bool wall = block.phase == Phase::wall, moving = !block.velocity.empty(), bodies = !block.body.empty();
  if ((moving && block.velocity.size() != 3 * n) || (bodies && block.body.size() != n))
    disagree("their arrays differ in length");
  if (moving && (wall || !header_.initial_velocity)) disagree("they move, and the header says that they do not");
  if (bodies && (!wall || header_.bodies.empty())) disagree("they belong to bodies, and the header has none");
  const std::array<int64_t, 3> counts = by_phase(header_.counts);
  int64_t& written = written_[std::size_t(p)];
  if (written + int64_t(n) > counts[std::size_t(p)])
    disagree(std::to_string(counts[std::size_t(p)]) + " were announced and " + std::to_string(written) +
             " are written");
  hsize_t start = hsize_t(written);
  if (block.phase == Phase::soil) file_.write_slab("/lgiw/soil/Stress", block.stress.data(), {start, 0}, {n, 6});
  if (block.phase == Phase::wall) {
    file_.write_slab("/lgiw/wall/Normal", block.normal.data(), {start, 0}, {n, 3});
    file_.write_slab("/lgiw/wall/Kind", block.kind.data(), {start}, {n});
    if (bodies) file_.write_slab("/lgiw/wall/Body", block.body.data(), {start}, {n});
  }
  for (int before = 0; before < p; ++before) start += hsize_t(counts[std::size_t(before)]);
  file_.write_slab("/VTKHDF/Points", block.points.data(), {start, 0}, {n, 3});
  file_.write_slab("/VTKHDF/PointData/Phase", std::vector<uint8_t>(n, uint8_t(p)).data(), {start}, {n});
  file_.write_slab("/VTKHDF/PointData/Volume", block.volume.data(), {start}, {n});
  file_.write_slab("/VTKHDF/PointData/Density", block.density.data(), {start}, {n});
  file_.write_slab("/VTKHDF/PointData/Pressure", block.pressure.data(), {start}, {n});
  if (moving) file_.write_slab(velocity_name, block.velocity.data(), {start, 0}, {n, 3});
  written += int64_t(n);
}

void ParticleWriter::finish() {
  const std::array<int64_t, 3> counts = by_phase(header_.counts);
  for (std::size_t p = 0; p < 3; ++p)
    if (written_[p] != counts[p])
      throw WorkError("'" + file_.path() + "' is not complete",
                      std::to_string(written_[p]) + " of " + std::to_string(counts[p]) + " particles of " +
                          phase_names[p] + " are written",
                      "report this as a fault of the program");
  file_.close();
}

ParticleData read_particles(const std::string& path) {
  ParticleData data;
  const h5::File file = open_particles(path, data.header);
  const ParticleCounts& counts = data.header.counts;
  data.water = read_block(file, data.header, Phase::water, 0, counts.water);
  data.soil = read_block(file, data.header, Phase::soil, counts.water, counts.soil);
  data.wall = read_block(file, data.header, Phase::wall, counts.water + counts.soil, counts.wall);
  return data;
}

ParticleHeader read_particle_header(const std::string& path) {
  ParticleHeader header;
  open_particles(path, header);
  return header;
}

}  // namespace lgiw
