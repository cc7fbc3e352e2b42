#pragma once
/// Tests that spare nearly every bond its exact envelope, which takes logarithms: two lower bounds of the strength, a coarse one
/// for every step of every bond and a closer one for those that it leaves in doubt.
#include "kernels/bond_law.hpp"

namespace clathra {

/// What is a line in B, the width of a bond [m].
template <class R>
struct OfWidth {
  R at_zero, per_width;
  template <class L>
  KOKKOS_FORCEINLINE_FUNCTION L of(L const& width) const {
    return multiply_add(L(per_width), width, L(at_zero));
  }
};

/// A trapezoid inside the envelope (Eq. 9) of every bond that a law can form, whatever its thickness from 0 to h_max:
/// |F_s| / S, S the smallest of `rising_per_normal` F_n + rising, flat and falling - `falling_per_normal` F_n [N/m], with the
/// strengths by their least values.
template <class R>
struct LeastStrengthOf {
  R rising_per_normal, falling_per_normal;
  OfWidth<R> rising, flat, falling;  ///< [N/m, N/m^2]
  R shear_slope;                     ///< f_s K_s > shear_slope
  OfWidth<R> moment;                 ///< f_r K_r L_r > moment [m, 1]
};
using LeastStrength = LeastStrengthOf<Real>;

/// @tparam R  the numbers of the kernel that tests
template <class R = Real>
LeastStrengthOf<R> least_strength(BondLaw const& law) {
  // Less by a thousand millionth, in single precision by some hundred ulps: strictly below what bond_strength() computes, however
  // that and the test itself are rounded. Of the test's sums the worst is F_n + R_t near -R_t, off by an ulp of either.
  constexpr Real share = sizeof(R) == sizeof(double) ? 1e-9 : 1e-5, less = 1 - share, more = 1 + share;
  auto const less_than = [](Real strength) { return strength - share * lane_abs(strength); };
  Real const least_thickness = rod_thickness(law.strength, law.plate_thickness),
             largest_thickness = rod_thickness(law.strength, law.thickness_weight * law.critical_thickness + law.plate_thickness);
  auto const strength = [&](Real stress, Real addend) {
    return OfWidth<Real>{less_than(law.strength.rod_share * addend),
                         less_than(stress + law.strength.rod_share_per_width * addend)};
  };
  OfWidth<Real> const tension = strength(law.strength.tensile_stress, tension_addend(least_thickness)),
                      compression = strength(law.strength.compressive_stress, compression_addend(largest_thickness));
  Real const slope = less * law.least_shape_of_shear * shear_slope(more * largest_thickness),
             rolling = less * law.least_shape_of_rolling * rolling_slope(more * largest_thickness);
  auto const times = [](Real factor, OfWidth<Real> const& a, OfWidth<Real> const& b = {0, 0}) {
    return OfWidth<R>{R(factor * (a.at_zero + b.at_zero)), R(factor * (a.per_width + b.per_width))};
  };
  Real const rising = 1.28 * slope, falling = 2.02 * slope;
  return {R(rising),
          R(falling),
          times(rising, tension),
          times(0.28 * slope, compression, tension),
          times(falling, compression),
          R(slope),
          times(rolling, {law.strength.moment_length, law.strength.moment_width_ratio})};
}

/// True for most bonds that hold: within the trapezoid of LeastStrengthOf. Where false, is_surely_intact() may still know.
template <class R, class L>
KOKKOS_FORCEINLINE_FUNCTION auto is_far_from_breaking(LeastStrengthOf<R> const& least, BondForce<L> const& bond) {
  ContactForce<L> const& force = bond.force;
  L const rising = multiply_add(L(least.rising_per_normal), force.normal, least.rising.of(bond.width)),
          falling = negative_multiply_add(L(least.falling_per_normal), force.normal, least.falling.of(bond.width)),
          moment_slope = least.moment.of(bond.width);
  L const size = lane_min(lane_min(rising, least.flat.of(bond.width)), falling);
  L const of_shear = force.shear * moment_slope, of_moment = force.moment * least.shear_slope;
  L const limit = moment_slope * lane_max(size, L(0));
  return multiply_add(of_shear, of_shear, of_moment * of_moment) < limit * limit;
}

/// True where a bond is certainly within its strength: a close lower bound of its envelope already holds. Where false, the exact
/// test decides.
template <class R, class L>
KOKKOS_FORCEINLINE_FUNCTION auto is_surely_intact(BondLawOf<R> const& law, BondForce<L> const& bond) {
  L const rod = rod_thickness(law.strength, bond.thickness);
  L const tension = tensile_strength(law.strength, bond.width, rod);
  L const compression = compressive_strength(law.strength, bond.width, rod);
  L const a = law.least_shape_of_shear * shear_slope(rod);
  L const b = law.least_shape_of_rolling * rolling_slope(rod) * moment_length(law.strength, bond.width);
  L const size = lane_max(envelope_lower_bound(bond.force.normal + tension, compression + tension), L(0));
  L const of_shear = bond.force.shear * b, of_moment = bond.force.moment * a, limit = a * b * size;
  return of_shear * of_shear + of_moment * of_moment < limit * limit;
}

}  // namespace clathra
