// A run file with the changes that the input orders, read in every way, and taken up again as --resume does.
#include "../files/small_run.hh"
#include "h5_changes.hh"

int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  using namespace lgiw;
  static const fuzz::Folder folder;
  const std::string path = folder / "run.h5";
  static const std::string sound = [&] {
    write_small_run(path, 7);
    return fuzz::bytes_of(path);
  }();
  fuzz::write_bytes(path, sound);
  static const std::vector<fuzz::H5Object> objects = fuzz::objects_of(path);
  fuzz::Script script(data, size);
  fuzz::change(path, objects, script);
  fuzz::accepted([&] {
    const RunReader run(path);
    for (std::size_t k = 0; k < run.frame_count(); ++k) fuzz::accepted([&] { run.frame(k); });
    const SurfaceMap& map = run.header().map;
    for (std::size_t k = 0; k < run.surface_times().size(); ++k)
      fuzz::accepted([&] {
        if (run.has_water_surface()) run.water_surface(k);
        if (run.has_soil_surface()) run.soil_surface(k);
      });
    fuzz::accepted([&] {
      if (run.has_water_surface()) run.water_surface_at(map.nx - 1, map.ny - 1);
      if (run.has_soil_surface()) run.soil_surface_at(0, 0);
    });
    for (std::size_t k = 0; k < run.header().pressure_gauges.size(); ++k) fuzz::accepted([&] { run.pressure(k); });
    for (const char* name : {"elevation", "depth", "speed", "arrival", "soil_speed"})
      fuzz::accepted([&] { run.maximum(name); });
    fuzz::accepted([&] { run.diagnostics(); });
    fuzz::accepted([&] { run.summary(); });
  });
  fuzz::accepted([&] { write_xdmf(path, folder / "run.xmf", true); });
  fuzz::accepted([&] { RunWriter::reopen(path, 1, 3, 4).close(); });
  return 0;
}
