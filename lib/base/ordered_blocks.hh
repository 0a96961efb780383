// Loops over many values by all OpenMP threads, whose result does not depend on how many there are.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace lgiw {

/// A loop of no more steps than this is done before other threads have begun.
constexpr std::size_t too_few_to_share = 20000;

/// each(begin, end) for blocks of [0, n), what it returns added up in the order of the blocks: Result has add(const
/// Result&), and what Result() holds adds nothing.
template <class Result, class Each>
Result over_blocks(std::size_t n, const Each& each) {
  constexpr std::size_t block = 8192;
  const std::size_t blocks = (n + block - 1) / block;
  std::vector<Result> results(blocks);
#pragma omp parallel for schedule(dynamic, 1) if (blocks > 1)
  for (std::size_t b = 0; b < blocks; ++b) results[b] = each(b * block, std::min(n, (b + 1) * block));
  Result sum{};
  for (const Result& r : results) sum.add(r);
  return sum;
}

}  // namespace lgiw
