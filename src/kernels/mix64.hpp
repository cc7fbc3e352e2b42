#pragma once
/// Scrambled 64-bit words, for hashes and counter-based random numbers.
#include <Kokkos_Core.hpp>
#include <cstdint>

namespace clathra {

/// The finaliser of SplitMix64 (Steele, Lea, Flood 2014): one to one, each bit of z changes about half of the result's.
KOKKOS_INLINE_FUNCTION std::uint64_t mix64(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}
/// The odd step between the counters of neighbouring words.
inline constexpr std::uint64_t golden_gamma = 0x9e3779b97f4a7c15ULL;

/// Uniform in [0, 1), of the upper 53 bits.
KOKKOS_INLINE_FUNCTION double unit_interval(std::uint64_t z) { return static_cast<double>(z >> 11) * 0x1p-53; }

}  // namespace clathra
