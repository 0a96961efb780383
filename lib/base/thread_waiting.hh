// How OpenMP's threads wait for each other.
#pragma once

namespace lgiw {

/// To be called before anything else in main. Makes threads that wait for the others stay awake for some microseconds
/// and then sleep, unless the environment says how (OMP_WAIT_POLICY, GOMP_SPINCOUNT). By itself GCC's OpenMP keeps them
/// awake for milliseconds, which on shared cores takes the time of those that they wait for; "passive" lets them sleep
/// at once, which in small scenes takes as long as the steps. It reads the environment when it is loaded: the program
/// is therefore started anew, once, in the same process. Where that is not possible, or the environment binds threads to
/// cores (OMP_PROC_BIND, OMP_PLACES, GOMP_CPU_AFFINITY), all stays as it was.
void wait_briefly(char** argv);

}  // namespace lgiw
