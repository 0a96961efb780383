#include "base/thread_waiting.hh"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>

namespace lgiw {

void wait_briefly(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY") || std::getenv("GOMP_SPINCOUNT")) return;
  // Where threads are bound to cores, this one has been by now, and the program that is started anew would be left with
  // its core alone.
  for (const char* binding : {"OMP_PROC_BIND", "OMP_PLACES", "GOMP_CPU_AFFINITY"})
    if (std::getenv(binding)) return;
  // Turns of an empty loop. Measured in docs/performance.md.
  if (setenv("GOMP_SPINCOUNT", "1000", 1) != 0) return;
  // By its own path: started as /proc/self/exe, the process would be called "exe" in top and by killall.
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (!error) execv(program.c_str(), argv);
}

}  // namespace lgiw
