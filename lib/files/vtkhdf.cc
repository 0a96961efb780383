#include "files/vtkhdf.hh"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.hh"

namespace lgiw {

namespace {

const std::string suggestion = "make the file again";

void write_height_field(h5::File& file, const std::string& name, const HeightField& field) {
  if (field.empty()) return;
  file.write(name, field.z.data(), {field.ny, field.nx});
  file.set_attribute(name, "x0", field.x0);
  file.set_attribute(name, "y0", field.y0);
  file.set_attribute(name, "dx", field.dx);
}

HeightField read_height_field(const h5::File& file, const std::string& name) {
  HeightField field;
  if (!file.exists(name)) return field;
  h5::Shape shape;
  field.z = file.read<double>(name, &shape);
  if (shape.size() != 2) refuse(file, name, "it has " + std::to_string(shape.size()) + " dimensions instead of 2");
  field.ny = shape[0];
  field.nx = shape[1];
  field.x0 = file.number_attribute(name, "x0");
  field.y0 = file.number_attribute(name, "y0");
  field.dx = file.number_attribute(name, "dx");
  return field;
}

void check_height_field(const HeightField& field, const std::string& name, const std::string& path) {
  if (field.empty()) return;
  const std::string problem = "/lgiw/" + name + " of '" + path + "' is unsound";
  LGIW_VALIDATE(field.nx >= 2 && field.ny >= 1 && field.z.size() == field.nx * field.ny, problem,
                std::to_string(field.ny) + " by " + std::to_string(field.nx) + " nodes", suggestion);
  LGIW_VALIDATE(std::isfinite(field.x0) && std::isfinite(field.y0) && std::isfinite(field.dx) && field.dx > 0, problem,
                "x0, y0 and dx must be finite and dx above 0", suggestion);
  for (double z : field.z) LGIW_VALIDATE(!std::isinf(z), problem, "a height is infinite", suggestion);
}

std::array<double, 3> read_vector(const h5::File& file, const std::string& name) {
  const std::vector<double> values = file.numbers_attribute("/lgiw", name);
  if (values.size() != 3)
    refuse(file, "/lgiw@" + name, "it has " + std::to_string(values.size()) + " values instead of 3");
  return {values[0], values[1], values[2]};
}

constexpr std::size_t most_bodies = 255;  // their numbers are uint8

void write_bodies(h5::File& file, const std::vector<BodyMotion>& bodies) {
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const BodyMotion& body = bodies[k];
    const std::string group = "/lgiw/bodies/" + std::to_string(k + 1);
    const hsize_t rows = body.time.size();
    file.make_group(group);
    file.set_attribute(group, "Name", body.name);
    file.set_attribute(group, "Pivot", std::vector<double>(body.pivot.begin(), body.pivot.end()));
    file.set_attribute(group, "Heading", body.heading);
    file.write(group + "/Time", body.time);
    file.write(group + "/Pitch", body.pitch);
    file.write(group + "/Displacement", body.displacement.data()->data(), {rows, 3});
  }
}

std::vector<BodyMotion> read_bodies(const h5::File& file) {
  std::vector<BodyMotion> bodies;
  if (!file.exists("/lgiw/bodies")) return bodies;
  const std::size_t count = file.children("/lgiw/bodies").size();
  if (count > most_bodies) refuse(file, "/lgiw/bodies", "it holds more than 255");
  for (std::size_t k = 1; k <= count; ++k) {
    const std::string group = "/lgiw/bodies/" + std::to_string(k);
    if (!file.exists(group)) refuse(file, "/lgiw/bodies", "its groups are not numbered from 1");
    BodyMotion body;
    body.name = file.text_attribute(group, "Name");
    const std::vector<double> pivot = file.numbers_attribute(group, "Pivot");
    if (pivot.size() != 3) refuse(file, group + "@Pivot", "it has " + std::to_string(pivot.size()) + " values");
    std::copy(pivot.begin(), pivot.end(), body.pivot.begin());
    body.heading = file.number_attribute(group, "Heading");
    body.time = file.read<double>(group + "/Time");
    body.pitch = file.read<double>(group + "/Pitch");
    h5::Shape shape;
    const std::vector<double> places = file.read<double>(group + "/Displacement", &shape);
    if (shape.size() != 2 || shape[1] != 3) refuse(file, group + "/Displacement", "it does not hold 3 numbers a row");
    for (std::size_t row = 0; row < shape[0]; ++row)
      body.displacement.push_back({places[3 * row], places[3 * row + 1], places[3 * row + 2]});
    bodies.push_back(std::move(body));
  }
  return bodies;
}

/// A whole number from 0 to the largest count that a file could hold.
int64_t count_of(const h5::File& file, const std::string& name, double value) {
  if (!(value >= 0 && value <= 1e12 && value == std::floor(value)))
    refuse(file, "/lgiw@" + name, std::to_string(value) + " is not a count");
  return int64_t(value);
}

std::string vector_text(const std::array<double, 3>& v) {
  return "(" + std::to_string(v[0]) + ", " + std::to_string(v[1]) + ", " + std::to_string(v[2]) + ")";
}

}  // namespace

void refuse(const h5::File& file, const std::string& problem, const std::string& why) {
  throw InputError(problem + " of '" + file.path() + "' is unsound", why, suggestion);
}

void write_vtkhdf_frame(h5::File& file, int64_t n_points) {
  const int64_t slab = 131072;  // one chunk of 1 MiB
  const hsize_t n = hsize_t(n_points);
  file.make_group("/VTKHDF");
  file.set_attribute("/VTKHDF", "Version", std::vector<int64_t>{2, 0});
  file.set_attribute("/VTKHDF", "Type", "PolyData");
  file.write("/VTKHDF/NumberOfPoints", std::vector<int64_t>{n_points});
  file.write("/VTKHDF/Vertices/NumberOfCells", std::vector<int64_t>{n_points});
  file.write("/VTKHDF/Vertices/NumberOfConnectivityIds", std::vector<int64_t>{n_points});
  file.create_dataset<int64_t>("/VTKHDF/Vertices/Connectivity", {n}, false, true);
  file.create_dataset<int64_t>("/VTKHDF/Vertices/Offsets", {n + 1}, false, true);
  std::vector<int64_t> ids(std::size_t(std::min(slab, n_points + 1)));
  for (int64_t start = 0; start <= n_points; start += slab) {
    const int64_t offsets = std::min(slab, n_points + 1 - start);
    std::iota(ids.begin(), ids.begin() + offsets, start);
    file.write_slab("/VTKHDF/Vertices/Offsets", ids.data(), {hsize_t(start)}, {hsize_t(offsets)});
    file.write_slab("/VTKHDF/Vertices/Connectivity", ids.data(), {hsize_t(start)},
                    {hsize_t(std::min(offsets, n_points - start))});
  }
  for (const std::string kind : {"Lines", "Polygons", "Strips"}) {
    file.write("/VTKHDF/" + kind + "/NumberOfCells", std::vector<int64_t>{0});
    file.write("/VTKHDF/" + kind + "/NumberOfConnectivityIds", std::vector<int64_t>{0});
    file.write("/VTKHDF/" + kind + "/Connectivity", std::vector<int64_t>{});
    file.write("/VTKHDF/" + kind + "/Offsets", std::vector<int64_t>{0});
  }
}

void check_particle_header(const ParticleHeader& header, const std::string& path) {
  const std::string problem = "the header of '" + path + "' is unsound";
  LGIW_VALIDATE(header.dimension == 2 || header.dimension == 3, problem,
                "Dimension is " + std::to_string(header.dimension) + " instead of 2 or 3", suggestion);
  LGIW_VALIDATE(std::isfinite(header.dp) && header.dp > 0, problem,
                "ParticleSpacing " + std::to_string(header.dp) + " m is not above 0", suggestion);
  LGIW_VALIDATE(std::isfinite(header.absorbing_width) && header.absorbing_width >= 0, problem,
                "AbsorbingWidth " + std::to_string(header.absorbing_width) + " m is negative", suggestion);
  LGIW_VALIDATE(std::isfinite(header.sound_speed) && header.sound_speed >= 0, problem,
                "SoundSpeed " + std::to_string(header.sound_speed) + " m/s is negative", suggestion);
  for (int k = 0; k < 3; ++k) {
    const bool flat = header.dimension == 2 && k == 1;
    const bool ordered = flat ? header.low[k] <= header.high[k] : header.low[k] < header.high[k];
    LGIW_VALIDATE(std::isfinite(header.low[k]) && std::isfinite(header.high[k]) && ordered, problem,
                  "DomainLow " + vector_text(header.low) + " is not below DomainHigh " + vector_text(header.high),
                  suggestion);
    LGIW_VALIDATE(std::isfinite(header.origin[k]), problem, "Origin is not finite", suggestion);
  }
  const ParticleCounts& counts = header.counts;
  LGIW_VALIDATE(
      counts.water >= 0 && counts.soil >= 0 && counts.wall >= 0 && counts.wall_left_out >= 0 && counts.total() > 0,
      problem, "a count of particles is negative or all are 0", suggestion);
  LGIW_VALIDATE(counts.water == 0 || std::isfinite(header.still_water_level), problem,
                "there is water but no StillWaterLevel", suggestion);
  LGIW_VALIDATE(header.bodies.size() <= most_bodies, problem, "more than 255 bodies move", suggestion);
  for (const BodyMotion& body : header.bodies) {
    const std::string fault = fault_of(body);
    LGIW_VALIDATE(fault.empty(), problem, "the motion of a body is unsound: " + fault, suggestion);
  }
  check_height_field(header.bed, "bed", path);
  check_height_field(header.ground, "ground", path);
}

void write_particle_header(h5::File& file, const ParticleHeader& header, const std::string& format) {
  const ParticleCounts& counts = header.counts;
  const auto list = [](const std::array<double, 3>& v) { return std::vector<double>(v.begin(), v.end()); };
  file.make_group("/lgiw");
  file.set_attribute("/lgiw", "Format", format);
  file.set_attribute("/lgiw", "Dimension", int64_t(header.dimension));
  file.set_attribute("/lgiw", "ParticleSpacing", header.dp);
  file.set_attribute("/lgiw", "Origin", list(header.origin));
  file.set_attribute("/lgiw", "CRS", header.crs_wkt);
  file.set_attribute("/lgiw", "VerticalDatum", header.vertical_datum);
  file.set_attribute("/lgiw", "Attribution", header.attribution);
  file.set_attribute("/lgiw", "StillWaterLevel", header.still_water_level);
  file.set_attribute("/lgiw", "DomainLow", list(header.low));
  file.set_attribute("/lgiw", "DomainHigh", list(header.high));
  std::vector<int64_t> sides;
  for (Side side : header.sides) sides.push_back(int64_t(side));
  file.set_attribute("/lgiw", "Sides", sides);
  file.set_attribute("/lgiw", "AbsorbingWidth", header.absorbing_width);
  file.set_attribute("/lgiw", "SoundSpeed", header.sound_speed);
  file.set_attribute("/lgiw", "Counts", std::vector<int64_t>{counts.water, counts.soil, counts.wall});
  file.set_attribute("/lgiw", "WallLeftOut", counts.wall_left_out);
  file.set_attribute("/lgiw", "Case", header.case_text);
  file.set_attribute("/lgiw", "Provenance", header.provenance);
  write_bodies(file, header.bodies);
  write_height_field(file, "/lgiw/bed", header.bed);
  write_height_field(file, "/lgiw/ground", header.ground);
}

ParticleHeader read_header(const h5::File& file, const std::string& format, const std::string& what,
                           const std::string& maker) {
  const std::string problem = "'" + file.path() + "' is not " + what;
  LGIW_VALIDATE(file.has_attribute("/lgiw", "Format"), problem, "it has no attribute Format in /lgiw",
                "make one with " + maker);
  const std::string found = file.text_attribute("/lgiw", "Format");
  LGIW_VALIDATE(found == format, problem, "its Format is '" + found + "' instead of '" + format + "'",
                "make one with " + maker);
  const std::string type = file.text_attribute("/VTKHDF", "Type");
  LGIW_VALIDATE(type == "PolyData", problem, "its VTKHDF Type is '" + type + "' instead of 'PolyData'",
                "make one with " + maker);

  ParticleHeader header;
  const double dimension = file.number_attribute("/lgiw", "Dimension");
  header.dimension = dimension == 2 ? 2 : dimension == 3 ? 3 : 0;
  header.dp = file.number_attribute("/lgiw", "ParticleSpacing");
  header.origin = read_vector(file, "Origin");
  header.crs_wkt = file.text_attribute("/lgiw", "CRS");
  header.vertical_datum = file.text_attribute("/lgiw", "VerticalDatum");
  if (file.has_attribute("/lgiw", "Attribution")) header.attribution = file.text_attribute("/lgiw", "Attribution");
  header.still_water_level = file.number_attribute("/lgiw", "StillWaterLevel");
  header.low = read_vector(file, "DomainLow");
  header.high = read_vector(file, "DomainHigh");
  const std::vector<double> sides = file.numbers_attribute("/lgiw", "Sides");
  if (sides.size() != 4) refuse(file, "/lgiw@Sides", "it has " + std::to_string(sides.size()) + " values instead of 4");
  for (int k = 0; k < 4; ++k) {
    if (sides[k] != 0 && sides[k] != 1 && sides[k] != 2)
      refuse(file, "/lgiw@Sides", std::to_string(sides[k]) + " is not 0 (wall), 1 (absorbing) or 2 (open)");
    header.sides[k] = Side(int(sides[k]));
  }
  header.absorbing_width = file.number_attribute("/lgiw", "AbsorbingWidth");
  header.sound_speed = file.number_attribute("/lgiw", "SoundSpeed");
  const std::array<double, 3> counts = read_vector(file, "Counts");
  header.counts.water = count_of(file, "Counts", counts[0]);
  header.counts.soil = count_of(file, "Counts", counts[1]);
  header.counts.wall = count_of(file, "Counts", counts[2]);
  header.counts.wall_left_out = count_of(file, "WallLeftOut", file.number_attribute("/lgiw", "WallLeftOut"));
  header.case_text = file.text_attribute("/lgiw", "Case");
  header.provenance = file.text_attribute("/lgiw", "Provenance");
  header.bodies = read_bodies(file);
  header.bed = read_height_field(file, "/lgiw/bed");
  header.ground = read_height_field(file, "/lgiw/ground");
  check_particle_header(header, file.path());
  return header;
}

template <class T>
std::vector<T> read_finite_rows(const h5::File& file, const std::string& name, int64_t start, int64_t n, int width) {
  if (n == 0) return {};
  const h5::Shape shape = file.shape(name);
  const bool flat = width == 1 && shape.size() == 1;
  if (!flat && !(width > 1 && shape.size() == 2 && shape[1] == hsize_t(width)))
    refuse(file, name, "it does not hold " + std::to_string(width) + " numbers a particle");
  if (shape[0] < hsize_t(start + n))
    refuse(file, name, "it has " + std::to_string(shape[0]) + " rows instead of " + std::to_string(start + n));
  std::vector<T> values(std::size_t(n) * std::size_t(width));
  if (flat)
    file.read_slab(name, values.data(), {hsize_t(start)}, {hsize_t(n)});
  else
    file.read_slab(name, values.data(), {hsize_t(start), 0}, {hsize_t(n), hsize_t(width)});
  for (std::size_t k = 0; k < values.size(); ++k)
    if (!std::isfinite(double(values[k])))
      refuse(file, name, "the value of row " + std::to_string(start + int64_t(k) / width) + " is not finite");
  return values;
}

template std::vector<float> read_finite_rows(const h5::File&, const std::string&, int64_t, int64_t, int);
template std::vector<double> read_finite_rows(const h5::File&, const std::string&, int64_t, int64_t, int);
template std::vector<uint8_t> read_finite_rows(const h5::File&, const std::string&, int64_t, int64_t, int);

}  // namespace lgiw
