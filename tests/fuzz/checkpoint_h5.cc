// A checkpoint with the changes that the input orders; with its digest right, so that it is read at all, unless the
// first byte says otherwise.
#include "solver/checkpoint.hh"

#include <cstdlib>

#include "h5_changes.hh"

int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  using namespace lgiw;
  static const fuzz::Folder folder;
  const std::string path = folder / "checkpoint";
  static const std::string sound = [&] {
    Checkpoint c;
    c.identity = "a run";
    c.outputs = 7, c.frames = 2, c.surfaces = 7, c.diagnostics = 7, c.wall_time = 12.5;
    c.extremes = {{"max_water_speed", 0.1}, {"last_below_bed", 3}};
    c.maxima = {{"elevation", {1.f, 2.f, 2.5f}}, {"speed", {0.f, 0.25f, 4.f}}};
    c.initial_elevation = {0.5f, 0.25f, 0.5f};
    c.arrays = {{"state", {1, 2, 3, 4}}, {"water velocity", std::vector<unsigned char>(300, 77)}, {"soil empty", {}}};
    write_checkpoint(path, c);
    return fuzz::bytes_of(path);
  }();
  fuzz::write_bytes(path, sound);
  static const std::vector<fuzz::H5Object> objects = fuzz::objects_of(path);
  fuzz::Script script(data, size);
  const uint8_t sealed = script.byte();
  fuzz::change(path, objects, script);
  if (sealed < 250) seal_checkpoint(path);
  const bool read = fuzz::accepted([&] { read_checkpoint(path, "a run"); });
  if (read && sealed >= 250 && fuzz::bytes_of(path) != sound) std::abort();
  return 0;
}
