#include "base/thread_waiting.hh"

#include <unistd.h>

#include <cstdlib>

namespace lgiw {

void wait_briefly(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY") || std::getenv("GOMP_SPINCOUNT")) return;
  // Turns of an empty loop. Measured in docs/performance.md.
  if (setenv("GOMP_SPINCOUNT", "1000", 1) == 0) execv("/proc/self/exe", argv);
}

}  // namespace lgiw
