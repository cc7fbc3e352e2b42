#pragma once
/// Tests that spare nearly every bond its exact envelope, which takes logarithms: two lower bounds of the strength, a coarse one
/// for every step of every bond and a closer one for those that it leaves in doubt.
#include "kernels/bond_law.hpp"

namespace clathra {

/// Lower bounds of the strengths of every bond that a law can form, whatever its thickness from 0 to h_max; B is the bond width
/// [m].
template <class R>
struct LeastStrengthOf {
  R tension, tension_per_width;          ///< R_t > tension + tension_per_width B [N/m, N/m^2]
  R compression, compression_per_width;  ///< R_c > compression + compression_per_width B
  R shear_slope;                         ///< f_s K_s > shear_slope
  R moment, moment_per_width;            ///< f_r K_r L_r > moment + moment_per_width B [m, 1]
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
  Real const of_tension = tension_addend(least_thickness), of_compression = compression_addend(largest_thickness);
  Real const tension = law.strength.rod_share * of_tension, compression = law.strength.rod_share * of_compression;
  Real const rolling = less * law.least_shape_of_rolling * rolling_slope(more * largest_thickness);
  LeastStrengthOf<R> least;
  least.tension = R(less_than(tension));
  least.tension_per_width = R(less_than(law.strength.tensile_stress + law.strength.rod_share_per_width * of_tension));
  least.compression = R(less_than(compression));
  least.compression_per_width = R(less_than(law.strength.compressive_stress + law.strength.rod_share_per_width * of_compression));
  least.shear_slope = R(less * law.least_shape_of_shear * shear_slope(more * largest_thickness));
  least.moment = R(rolling * law.strength.moment_length);
  least.moment_per_width = R(rolling * law.strength.moment_width_ratio);
  return least;
}

/// True for most bonds that hold (Eq. 9): the envelope is replaced by a trapezoid inside it, 1.28 (F_n + R_t), 0.28 (R_c + R_t)
/// and 2.02 (R_c - F_n), and the strengths by their least values. Where false, is_surely_intact() may still know.
template <class R, class L>
KOKKOS_FORCEINLINE_FUNCTION auto is_far_from_breaking(LeastStrengthOf<R> const& least, BondForce<L> const& bond) {
  L const tension = least.tension_per_width * bond.width + least.tension;
  L const compression = least.compression_per_width * bond.width + least.compression;
  L const moment_slope = least.moment_per_width * bond.width + least.moment;
  R const rising = R(1.28) * least.shear_slope, flat = R(0.28) * least.shear_slope, falling = R(2.02) * least.shear_slope;
  L const size = lane_min(lane_min(rising * (bond.force.normal + tension), flat * (compression + tension)),
                          falling * (compression - bond.force.normal));
  L const of_shear = bond.force.shear * moment_slope, of_moment = bond.force.moment * least.shear_slope;
  L const limit = moment_slope * lane_max(size, L(0));
  return of_shear * of_shear + of_moment * of_moment < limit * limit;
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
