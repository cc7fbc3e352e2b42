#pragma once
/// Counter-based random numbers: a value depends on its key only, so no order of drawing can change it.
#include <cstdint>
#include <utility>
#include <vector>

#include "kernels/mix64.hpp"

namespace clathra {

/// Uniform in [0, 1), keyed by (seed, stream, counter).
inline double uniform_random(std::uint64_t seed, std::uint64_t stream, std::uint64_t counter) {
  std::uint64_t const key =
      seed * golden_gamma + stream * 0xd1b54a32d192ed03ULL + counter * 0x8cb92ba72f3d8dd7ULL + 0x2545f4914f6cdd1dULL;
  return unit_interval(mix64(mix64(key)));
}

/// Fisher-Yates shuffle keyed by (seed, stream).
template <class T>
void shuffle(std::vector<T>& values, std::uint64_t seed, std::uint64_t stream) {
  for (std::size_t i = values.size(); i > 1; --i) {
    auto const j = static_cast<std::size_t>(uniform_random(seed, stream, i) * static_cast<double>(i));
    std::swap(values[i - 1], values[j]);
  }
}

}  // namespace clathra
