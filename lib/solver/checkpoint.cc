#include "solver/checkpoint.hh"

#include <filesystem>
#include <system_error>

#include "base/atomic_file.hh"
#include "base/error.hh"
#include "base/provenance.hh"
#include "files/h5.hh"

namespace lgiw {
namespace {

constexpr const char* format = "lgiw-checkpoint 1";

/// One checksum over everything: names, sizes, contents.
class Digest {
 public:
  template <class T>
  void add(const std::string& name, const T* data, std::size_t n) {
    text_ += name + " " + std::to_string(n) + " " +
             sha256_of_text(std::string(reinterpret_cast<const char*>(data), n * sizeof(T))) + "\n";
  }
  std::string hex() const { return sha256_of_text(text_); }

 private:
  std::string text_;
};

std::string digest(const Checkpoint& c) {
  Digest d;
  d.add("identity", c.identity.data(), c.identity.size());
  const int64_t counts[4] = {c.outputs, c.frames, c.surfaces, c.diagnostics};
  d.add("counts", counts, 4);
  d.add("wall time", &c.wall_time, 1);
  for (const auto& [name, value] : c.extremes) d.add(name, &value, 1);
  for (const auto& [name, raster] : c.maxima) d.add(name, raster.data(), raster.size());
  d.add("initial elevation", c.initial_elevation.data(), c.initial_elevation.size());
  for (const RawArray& a : c.arrays) d.add(a.name, a.bytes.data(), a.bytes.size());
  return d.hex();
}

std::string array_path(std::size_t k) { return "/arrays/" + std::to_string(100000 + k).substr(1); }

}  // namespace

std::string previous_checkpoint(const std::string& path) { return path + ".previous"; }

void write_checkpoint(const std::string& path, const Checkpoint& c) {
  AtomicFile out(path, true);
  h5::File file = h5::File::create(out.temporary());
  file.set_attribute("/", "Format", format);
  file.set_attribute("/", "Identity", c.identity);
  file.set_attribute("/", "Counts", std::vector<int64_t>{c.outputs, c.frames, c.surfaces, c.diagnostics});
  file.set_attribute("/", "WallTime", c.wall_time);
  file.set_attribute("/", "Checksum", digest(c));
  file.make_group("/extremes");
  for (const auto& [name, value] : c.extremes) file.set_attribute("/extremes", name, value);
  std::string names;
  for (const auto& [name, value] : c.extremes) names += name + "\n";
  file.set_attribute("/extremes", "Names", names);
  file.make_group("/maxima");
  for (const auto& [name, raster] : c.maxima) file.write("/maxima/" + name, raster);
  if (!c.initial_elevation.empty()) file.write("/initial_elevation", c.initial_elevation);
  file.make_group("/arrays");
  for (std::size_t k = 0; k < c.arrays.size(); ++k) {
    file.write(array_path(k), c.arrays[k].bytes);
    file.set_attribute(array_path(k), "Name", c.arrays[k].name);
  }
  file.close();
  // The old one stays under the other name until the new one is whole under its own.
  std::error_code ec;
  if (std::filesystem::exists(path)) std::filesystem::rename(path, previous_checkpoint(path), ec);
  out.commit();
}

Checkpoint read_checkpoint(const std::string& path, const std::string& identity) {
  h5::File file = h5::File::open_read(path);
  LGIW_VALIDATE(file.has_attribute("/", "Format") && file.text_attribute("/", "Format") == format,
                path + " is no checkpoint", "it lacks the attribute Format = " + std::string(format),
                "name another file");
  Checkpoint c;
  c.identity = file.text_attribute("/", "Identity");
  LGIW_VALIDATE(c.identity == identity, path + " belongs to another run",
                "particles, case, overrides or precision differ", "resume with those that wrote it");
  const auto counts = file.numbers_attribute("/", "Counts");
  LGIW_VALIDATE(counts.size() == 4, path + " is damaged", "its counts are missing", "it cannot be resumed from");
  c.outputs = int64_t(counts[0]), c.frames = int64_t(counts[1]);
  c.surfaces = int64_t(counts[2]), c.diagnostics = int64_t(counts[3]);
  c.wall_time = file.number_attribute("/", "WallTime");
  const std::string names = file.text_attribute("/extremes", "Names");
  for (std::size_t at = 0; at < names.size();) {
    const std::size_t end = names.find('\n', at);
    if (end == std::string::npos) break;
    const std::string name = names.substr(at, end - at);
    c.extremes[name] = file.number_attribute("/extremes", name);
    at = end + 1;
  }
  for (const std::string& name : file.children("/maxima")) c.maxima[name] = file.read<float>("/maxima/" + name);
  if (file.exists("/initial_elevation")) c.initial_elevation = file.read<float>("/initial_elevation");
  const std::size_t n = file.children("/arrays").size();
  for (std::size_t k = 0; k < n; ++k)
    c.arrays.push_back({file.text_attribute(array_path(k), "Name"), file.read<uint8_t>(array_path(k))});
  LGIW_VALIDATE(file.text_attribute("/", "Checksum") == digest(c), path + " is damaged", "its checksum is wrong",
                "it cannot be resumed from");
  return c;
}

Checkpoint read_newest_checkpoint(const std::string& path, const std::string& identity, std::string* note) {
  std::string why;
  for (const std::string& candidate : {path, previous_checkpoint(path)}) {
    if (!std::filesystem::exists(candidate)) {
      if (candidate == path) why = path + " does not exist";
      continue;
    }
    try {
      Checkpoint c = read_checkpoint(candidate, identity);
      if (note && !why.empty()) *note = "resuming from " + candidate + ": " + why;
      return c;
    } catch (const std::exception& e) {  // damage can also ask for more memory than there is
      why += (why.empty() ? "" : "; ") + std::string(e.what());
    }
  }
  throw InputError("there is nothing to resume", why, "start the run anew");
}

}  // namespace lgiw
