#include "solver/checkpoint.hh"

#include <filesystem>
#include <fstream>
#include <new>

#include "base/atomic_file.hh"
#include "base/error.hh"
#include "base/provenance.hh"
#include "files/h5.hh"

namespace lgiw {
namespace {

constexpr const char* format = "lgiw-checkpoint 3";

// Behind HDF5's own end, which passes over it: a digest of all bytes before. HDF5 itself checks few of them.
const std::string seal_name = "\nlgiw sha256 ";
constexpr std::size_t seal_length = 13 + 64;

std::string array_path(std::size_t k) { return "/arrays/" + std::to_string(100000 + k).substr(1); }

struct OtherRun : InputError {
  using InputError::InputError;
};

[[noreturn]] void damaged(const std::string& path, const std::string& why) {
  throw InputError(path + " is damaged", why, "it cannot be resumed from");
}

/// Each ends with a line feed.
std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0, end; (end = text.find('\n', at)) != std::string::npos; at = end + 1)
    lines.push_back(text.substr(at, end - at));
  return lines;
}

void check_seal(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = file.tellg();
  std::string seal(seal_length, '\0');
  const bool read = file && size >= std::streamoff(seal_length) && file.seekg(size - std::streamoff(seal_length)) &&
                    file.read(seal.data(), std::streamsize(seal_length));
  if (!read || seal.compare(0, seal_name.size(), seal_name) != 0) damaged(path, "its end is missing");
  if (sha256_of_start(path, uint64_t(size) - seal_length) != seal.substr(seal_name.size()))
    damaged(path, "its checksum is wrong");
}

}  // namespace

void seal_checkpoint(const std::string& path) {
  const std::string seal = seal_name + sha256_of_file(path);
  std::ofstream file(path, std::ios::binary | std::ios::app);
  file << seal << std::flush;
  if (!file) throw WorkError(path + " was not written", "the disk took no more", "make room, then go on with --resume");
}

std::string previous_checkpoint(const std::string& path) { return path + ".previous"; }

void write_checkpoint(const std::string& path, const Checkpoint& c) {
  AtomicFile out(path, true);
  h5::File file = h5::File::create(out.temporary());
  file.set_attribute("/", "Format", format);
  file.set_attribute("/", "Identity", c.identity);
  file.set_attribute("/", "Counts", std::vector<int64_t>{c.outputs, c.frames, c.surfaces, c.diagnostics});
  file.set_attribute("/", "WallTime", c.wall_time);
  std::string lines;
  for (const std::string& line : c.retakes) lines += line + "\n";
  file.set_attribute("/", "Retakes", lines);
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
  seal_checkpoint(out.temporary());
  out.commit_keeping(previous_checkpoint(path));
}

Checkpoint read_checkpoint(const std::string& path, const std::string& identity) {
  check_seal(path);
  h5::File file = h5::File::open_read(path);
  LGIW_VALIDATE(file.has_attribute("/", "Format") && file.text_attribute("/", "Format") == format,
                path + " is no checkpoint", "it lacks the attribute Format = " + std::string(format),
                "name another file");
  Checkpoint c;
  c.identity = file.text_attribute("/", "Identity");
  if (c.identity != identity)
    throw OtherRun(path + " belongs to another run", "particles, case, overrides or precision differ",
                   "resume with the same particles, --case, --set and --backend; -O instead discards it");
  const auto counts = file.numbers_attribute("/", "Counts");
  if (counts.size() != 4) damaged(path, "its counts are missing");
  for (const double count : counts)
    if (!(count >= 0 && count <= 1e12)) damaged(path, "its counts are not those of a run");
  c.outputs = int64_t(counts[0]), c.frames = int64_t(counts[1]);
  c.surfaces = int64_t(counts[2]), c.diagnostics = int64_t(counts[3]);
  c.wall_time = file.number_attribute("/", "WallTime");
  c.retakes = lines_of(file.text_attribute("/", "Retakes"));
  for (const std::string& name : lines_of(file.text_attribute("/extremes", "Names")))
    c.extremes[name] = file.number_attribute("/extremes", name);
  for (const std::string& name : file.children("/maxima")) c.maxima[name] = file.read<float>("/maxima/" + name);
  if (file.exists("/initial_elevation")) c.initial_elevation = file.read<float>("/initial_elevation");
  const std::size_t n = file.children("/arrays").size();
  for (std::size_t k = 0; k < n; ++k)
    c.arrays.push_back({file.text_attribute(array_path(k), "Name"), file.read<uint8_t>(array_path(k))});
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
    } catch (const std::bad_alloc&) {
      throw;  // it is sound, as its digest was right: an older one would lose steps for nothing
    } catch (const OtherRun&) {
      throw;  // sound, too, and all that there is of a run that whoever called did not mean
    } catch (const std::exception& e) {
      why += (why.empty() ? "" : "; ") + std::string(e.what());
    }
  }
  throw InputError("there is nothing to resume", why, "start the run anew");
}

}  // namespace lgiw
