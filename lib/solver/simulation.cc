#include "solver/simulation.hh"

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hh"
#include "solver/cpu_simulation.hh"

namespace lgiw {
namespace {

constexpr int built_lanes[] = {LGIW_CPU_LANES};

struct InstructionSet {
  const char* name;
  int lanes;  // floats in a vector
};
constexpr InstructionSet instruction_sets[] = {{"baseline", 4}, {"avx2", 8}, {"avx512", 16}};

/// Both the build and the processor have the instructions.
bool possible(int lanes) {
  bool able = lanes == 4;
#if defined(__x86_64__) && !defined(__clang__)  // clang has no #pragma GCC target: there is the baseline alone
  if (lanes == 16) able = __builtin_cpu_supports("x86-64-v4");
  if (lanes == 8) able = __builtin_cpu_supports("x86-64-v3");
#endif
  return able && std::find(std::begin(built_lanes), std::end(built_lanes), lanes) != std::end(built_lanes);
}

/// Lanes of the widest possible instructions, or of those that the environment asks for.
int lanes_to_use() {
  const char* wish = std::getenv("LGIW_INSTRUCTIONS");
  const std::string name = wish ? wish : "";
  int lanes = 0;
  for (const InstructionSet& set : instruction_sets)
    if (possible(set.lanes) && (name.empty() || name == set.name)) lanes = set.lanes;
  if (lanes > 0) return lanes;
  std::string names;
  for (const std::string& each : cpu_instruction_sets()) names += (names.empty() ? "" : " or ") + each;
  if (names.empty())
    throw BackendError(
        "--backend cpu is not possible (this processor lacks the instructions that the build was made for) build "
        "without -DLGIW_CPU_LANES, for all of them");
  throw InputError("LGIW_INSTRUCTIONS=" + name + " is not possible",
                   "it is unknown, or this build or this processor lacks it",
                   "set it to " + names + ", or leave it out for the widest");
}

template <class P, class T, int D, int... each>
std::unique_ptr<Simulation> make_of(std::integer_sequence<int, each...>, int lanes, const ModelParameters& p,
                                    const InitialParticles& particles, NumberType type) {
  std::unique_ptr<Simulation> made;
  ((lanes == each ? void(made = make_cpu<P, T, D, each>(p, particles, type)) : void()), ...);
  return made;
}

template <class P, class T, int D>
std::unique_ptr<Simulation> make_with(const ModelParameters& p, const InitialParticles& particles, NumberType type) {
  return make_of<P, T, D>(std::integer_sequence<int, LGIW_CPU_LANES>{}, lanes_to_use(), p, particles, type);
}

}  // namespace

std::vector<std::string> cpu_instruction_sets() {
  std::vector<std::string> out;
  for (const InstructionSet& set : instruction_sets)
    if (possible(set.lanes)) out.push_back(set.name);
  return out;
}

std::unique_ptr<Simulation> make_cpu_simulation(const ModelParameters& p, const InitialParticles& particles,
                                                NumberType type) {
  const bool plane = p.dimension == 2;
  switch (type) {
    case NumberType::single_:
      return plane ? make_with<float, float, 2>(p, particles, type) : make_with<float, float, 3>(p, particles, type);
    case NumberType::double_:
      return plane ? make_with<double, double, 2>(p, particles, type)
                   : make_with<double, double, 3>(p, particles, type);
    default:
      return plane ? make_with<double, float, 2>(p, particles, type) : make_with<double, float, 3>(p, particles, type);
  }
}

}  // namespace lgiw
