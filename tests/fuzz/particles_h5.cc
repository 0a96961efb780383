// A particles file with the changes that the input orders.
#include "../files/small_scene.hh"
#include "h5_changes.hh"

int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  using namespace lgiw;
  static const fuzz::Folder folder;
  const std::string path = folder / "particles.h5";
  static const std::string sound = [&] {
    write_small_particles(path);
    return fuzz::bytes_of(path);
  }();
  fuzz::write_bytes(path, sound);
  static const std::vector<fuzz::H5Object> objects = fuzz::objects_of(path);
  fuzz::Script script(data, size);
  fuzz::change(path, objects, script);
  fuzz::accepted([&] { read_particles(path); });
  fuzz::accepted([&] { read_particle_header(path); });
  return 0;
}
