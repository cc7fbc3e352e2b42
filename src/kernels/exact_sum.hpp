#pragma once
/// Sums that do not depend on their order: fixed-point integers in two words.
#include <Kokkos_Core.hpp>
#include <cmath>
#include <cstdint>
#include <functional>

#include "kernels/real.hpp"

namespace clathra {

/// A real number as high * 2^-20 + low * 2^-56: resolution 1.4e-17, magnitude up to 8e12, up to 1e8 terms. Covers every sum in SI
/// units that a specimen makes (forces, moments, energies, stress times area).
struct FixedPoint {
  std::int64_t high = 0, low = 0;
  static constexpr Real high_scale = 1048576.0;     // 2^20
  static constexpr Real low_scale = 68719476736.0;  // 2^36, of the remainder

  KOKKOS_INLINE_FUNCTION static FixedPoint from(Real value) {
    Real const scaled = value * high_scale;
    auto const whole = static_cast<std::int64_t>(scaled);
    return {whole, static_cast<std::int64_t>((scaled - static_cast<Real>(whole)) * low_scale)};
  }
  KOKKOS_INLINE_FUNCTION Real value() const {
    return (static_cast<Real>(high) + static_cast<Real>(low) / low_scale) / high_scale;
  }
};

/// Sums `Count` quantities over i in [0, n): the functor fills `out[0 .. Count)` for index i. Same bits for any order and thread
/// count.
template <int Count, class Terms>
struct ExactSumKernel {
  using value_type = std::int64_t[];
  unsigned value_count = 2 * Count;
  Terms terms;
  KOKKOS_FUNCTION void operator()(int i, std::int64_t* sums) const {
    Real out[Count] = {};
    terms(i, out);
    for (int c = 0; c < Count; ++c) {
      if (out[c] == 0) continue;  // nearly all terms of the walls
      FixedPoint const term = FixedPoint::from(out[c]);
      sums[2 * c] += term.high;
      sums[2 * c + 1] += term.low;
    }
  }
  KOKKOS_FUNCTION void init(std::int64_t* sums) const {
    for (unsigned c = 0; c < value_count; ++c) sums[c] = 0;
  }
  KOKKOS_FUNCTION void join(std::int64_t* into, std::int64_t const* from) const {
    for (unsigned c = 0; c < value_count; ++c) into[c] += from[c];
  }
  // Kokkos before 4 calls join with volatile pointers.
  KOKKOS_FUNCTION void join(std::int64_t volatile* into, std::int64_t const volatile* from) const {
    for (unsigned c = 0; c < value_count; ++c) into[c] = into[c] + from[c];
  }
};

/// Adds integers to those of the other ranks that hold parts of the specimen; empty where there are none.
using SumOverRanks = std::function<void(std::int64_t*, int)>;

/// A sum of numbers on the host, in any order and over all ranks.
class ExactSum {
 public:
  /// @param scale  a power of two that brings the terms to about 1
  explicit ExactSum(Real scale = 1) : scale_(scale) {}
  void add(Real value) {
    FixedPoint const term = FixedPoint::from(value * scale_);
    words_[0] += term.high;
    words_[1] += term.low;
  }
  Real over(SumOverRanks const& ranks) {
    if (ranks) ranks(words_, 2);
    return FixedPoint{words_[0], words_[1]}.value() / scale_;
  }

 private:
  Real scale_;
  std::int64_t words_[2] = {0, 0};
};

/// @return the sums in `result[0 .. Count)`
template <int Count, class Terms>
void exact_sums(char const* label, int n, Terms const& terms, Real* result, SumOverRanks const& over_ranks = {}) {
  std::int64_t sums[2 * Count];
  ExactSumKernel<Count, Terms> kernel{2 * Count, terms};
  Kokkos::View<std::int64_t*, Kokkos::HostSpace, Kokkos::MemoryTraits<Kokkos::Unmanaged>> const into(&sums[0], 2 * Count);
  Kokkos::parallel_reduce(label, Kokkos::RangePolicy<ExecutionSpace>(0, n), kernel, into);
  if (over_ranks) over_ranks(&sums[0], 2 * Count);
  for (int c = 0; c < Count; ++c) result[c] = FixedPoint{sums[2 * c], sums[2 * c + 1]}.value();
}

}  // namespace clathra
