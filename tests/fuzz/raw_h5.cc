// The bytes of an HDF5 file, as a damaged disk or a stranger would hand them over.
#include "files/run_file.hh"
#include "fuzzing.hh"

int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  using namespace lgiw;
  static const fuzz::Folder folder;
  const std::string path = folder / "raw.h5";
  fuzz::write_bytes(path, std::string(reinterpret_cast<const char*>(data), size));
  fuzz::accepted([&] { read_particles(path); });
  fuzz::accepted([&] {
    const RunReader run(path);
    for (std::size_t k = 0; k < run.frame_count(); ++k) fuzz::accepted([&] { run.frame(k); });
    fuzz::accepted([&] { run.diagnostics(); });
  });
  return 0;
}
