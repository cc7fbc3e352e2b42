#pragma once
/// Shape of the hydrate between two discs (seed paper, section 2, Eqs. 2, 5 and 17).
#include <cmath>

#include "kernels/lane.hpp"

namespace clathra {

/// Rbar = 2 r1 r2 / (r1 + r2) [m], the harmonic mean of two radii [m] (0 for two radii of zero, the padding discs).
template <class L>
KOKKOS_FORCEINLINE_FUNCTION L common_radius(L const& r1, L const& r2) {
  return L(2) * r1 * r2 / lane_max(r1 + r2, L(1e-300));
}

/// Bond width B = sqrt(4 r^2 - (2 r - g)^2) with g = h_max - h_cr (Eq. 2), in the form sqrt(g (4 r - g)), which does not cancel.
/// @param radius  common radius r [m]
/// @param room    g [m]; below 0 the pair is not bondable (B = 0), above 2 r the bond is as wide as the disc (capped)
/// @return B [m], 0 <= B <= 2 r
template <class L>
KOKKOS_FORCEINLINE_FUNCTION L bond_width(L const& radius, L const& room) {
  L const g = lane_max(lane_min(room, radius + radius), L(0));
  return lane_sqrt(g * (L(4) * radius - g));
}

/// Effective bond thickness h_0 = (h_cr + h_max) / 2 [m] (below Eq. 17); the plate model passes its own thickness twice.
template <class L>
KOKKOS_FORCEINLINE_FUNCTION L effective_thickness(L const& gap, L const& critical_thickness) {
  return (gap + critical_thickness) * L(0.5);
}

/// Area of one bond in the plane (Eq. 5): S_i = (h_max + h) B / 2 + B r - 2 r^2 arctan(B / sqrt(4 r^2 - B^2)).
/// The last two terms nearly cancel for narrow bonds; there their series -B^3/(24 r) - 3 B^5/(640 r^3) - 5 B^7/(7168 r^5) stands in.
/// @return [m^2]
KOKKOS_INLINE_FUNCTION Real bond_area(Real radius, Real width, Real gap, Real critical_thickness) {
  Real const plate = 0.5 * (critical_thickness + gap) * width;
  Real const ratio = width / radius;
  if (ratio < 0.25) {
    Real const q = ratio * ratio;
    return plate - width * radius * q * (1.0 / 24 + q * (3.0 / 640 + q * (5.0 / 7168 + q * (35.0 / 294912 + q * (63.0 / 2883584)))));
  }
  Real const sine = width < 2 * radius ? width / (2 * radius) : 1.0;
  return plate + width * radius - 2 * radius * radius * std::asin(sine);
}

}  // namespace clathra
