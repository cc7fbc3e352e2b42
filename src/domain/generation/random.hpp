#pragma once
/// Counter-based random numbers: a value depends on its key only, so no order of drawing can change it.
#include <cstdint>
#include <utility>
#include <vector>

namespace clathra {

/// Uniform in [0, 1), keyed by (seed, stream, counter).
inline double uniform_random(std::uint64_t seed, std::uint64_t stream, std::uint64_t counter) {
  std::uint64_t z =
      seed * 0x9e3779b97f4a7c15ULL + stream * 0xd1b54a32d192ed03ULL + counter * 0x8cb92ba72f3d8dd7ULL + 0x2545f4914f6cdd1dULL;
  for (int round = 0; round < 2; ++round) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    z ^= z >> 31;
  }
  return static_cast<double>(z >> 11) * 0x1p-53;
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
