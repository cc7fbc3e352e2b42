#pragma once
/// Shape of the hydrate between two discs (Jiang et al. 2017, section 2, Eqs. 2, 5 and 17), and which way it lies.
#include <cmath>

#include "kernels/lane.hpp"

namespace clathra {

/// Rbar = 2 r1 r2 / (r1 + r2) [m], the harmonic mean of two radii [m] (0 for two radii of zero, the padding discs).
template <class L>
KOKKOS_FORCEINLINE_FUNCTION L common_radius(L const& r1, L const& r2) {
  return L(2) * r1 * r2 / lane_max(r1 + r2, L(least_divisor<scalar_of<L>>));
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
KOKKOS_FORCEINLINE_FUNCTION L effective_thickness(L const& thickness, L const& critical_thickness) {
  return (thickness + critical_thickness) * constant<L>(0.5);
}

/// asin(y) - y for 0 <= y <= 1/2 by its series, without the cancellation and without libm.
KOKKOS_INLINE_FUNCTION Real arc_sine_excess(Real y) {
  Real const q = y * y;
  Real term = y, sum = 0;
  for (int n = 1; n <= 26; ++n) {
    term *= q * ((2 * n - 1) * (2 * n - 1)) / (2 * n * (2 * n + 1));
    sum += term;
  }
  return sum;
}

/// Area of one bond in the plane (Eq. 5): S_i = (h_max + h) B / 2 + B r - 2 r^2 arctan(B / sqrt(4 r^2 - B^2)).
/// With y = B / 2r the arctan is asin(y) and B r = 2 r^2 y; they nearly cancel, so their difference is taken as a whole.
/// @return [m^2]
KOKKOS_INLINE_FUNCTION Real bond_area(Real radius, Real width, Real thickness, Real critical_thickness) {
  Real const y = width < 2 * radius ? width / (2 * radius) : 1, half = 0.5 * (1 - y);
  // asin(y) = pi / 2 - 2 asin(sqrt((1 - y) / 2)) keeps the argument of the series below 1/2.
  Real const excess = y <= 0.5 ? arc_sine_excess(y) : 0.5 * pi - 2 * (std::sqrt(half) + arc_sine_excess(std::sqrt(half))) - y;
  return 0.5 * (critical_thickness + thickness) * width - 2 * radius * radius * excess;
}

/// Angle [deg] of a branch along (dx, dy) from the horizontal, anticlockwise, 0 <= .. < 180.
KOKKOS_INLINE_FUNCTION Real angle_of_line(Real dx, Real dy) {
  Real angle = std::atan2(dy, dx) * (180 / pi);
  if (angle < 0) angle += 180;
  return angle < 180 ? angle : angle - 180;
}

}  // namespace clathra
