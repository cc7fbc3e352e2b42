#pragma once
/// Strength that differs from bond to bond, as of a brittle solid with flaws (Weibull): one number a bond, of its two ids and a
/// seed alone, so that it is kept nowhere and is the same on any ranks.
#include "kernels/elementary.hpp"
#include "kernels/lane.hpp"
#include "kernels/mix64.hpp"

namespace clathra {

/// Share w of the strength of the law that a bond has, P(w < x) = 1 - exp(-(x / scale)^m), mean 1. The weakest thousandth have
/// the strength of the strongest of them: then nearly every bond is seen to hold without its own number.
struct StrengthScatter {
  Real inverse_modulus = 0;  ///< 1 / m; 0 = all bonds alike
  Real scale = 1;            ///< 1 / Gamma(1 + 1 / m)
  Real least = 1;            ///< no bond has less
  std::uint64_t seed = 0;

  static constexpr Real weakest = 1e-3;  ///< share of all bonds
  static constexpr int mark_count = 5;
  Real mark[mark_count] = {0.01, 0.05, 0.15, 0.35, 0.65};  ///< parts of all bonds
  Real at_mark[mark_count] = {1, 1, 1, 1, 1};              ///< quantile() there

  KOKKOS_INLINE_FUNCTION bool is_on() const { return inverse_modulus > 0; }
  /// The share that a part of all bonds, 0 < part < 1, is below.
  KOKKOS_INLINE_FUNCTION Real quantile(Real part) const { return scale * power(-natural_log(1 - part), inverse_modulus); }
  /// Not more than quantile(part), without its logarithms.
  KOKKOS_INLINE_FUNCTION Real lower_bound(Real part) const {
    Real bound = least;
    for (int k = 0; k < mark_count; ++k) bound = part > mark[k] ? at_mark[k] : bound;
    return bound;
  }
  /// The part of all bonds that are weaker than the one between two discs, in whichever order.
  KOKKOS_INLINE_FUNCTION Real part_below(int id_a, int id_b) const {
    auto const low = static_cast<std::uint64_t>(id_a < id_b ? id_a : id_b),
               high = static_cast<std::uint64_t>(id_a < id_b ? id_b : id_a);
    std::uint64_t const word = mix64(mix64(mix64(seed + golden_gamma) + golden_gamma * (low + 1)) + golden_gamma * (high + 1));
    return lane_max(Real(unit_interval(word)), Real(weakest));
  }
  KOKKOS_INLINE_FUNCTION Real share(int id_a, int id_b) const { return lane_max(least, quantile(part_below(id_a, id_b))); }
};

}  // namespace clathra
