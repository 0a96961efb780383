#pragma once

namespace lgiw {

/// Registers the benchmarks as compiled for vectors of so many floats; each name ends with `/` and that of the set.
template <int lanes>
void register_kernels(const char* instruction_set);
/// Those that are compiled once, for any processor.
void register_sort();

}  // namespace lgiw
