#pragma once
/// Tests that spare nearly every bond its exact envelope, which takes logarithms: two lower bounds of the strength, a coarse one
/// for every step of every bond and a closer one for those that it leaves in doubt.
#include "kernels/bond_law.hpp"

namespace clathra {

/// Lower bounds of the strengths of every bond that a law can form, whatever its thickness from 0 to h_max; B is the bond width
/// [m].
struct LeastStrength {
  Real tension, tension_per_width;          ///< R_t > tension + tension_per_width B [N/m, N/m^2]
  Real compression, compression_per_width;  ///< R_c > compression + compression_per_width B
  Real shear_slope;                         ///< f_s K_s > shear_slope
  Real moment, moment_per_width;            ///< f_r K_r L_r > moment + moment_per_width B [m, 1]
};

KOKKOS_INLINE_FUNCTION LeastStrength least_strength(BondLaw const& law) {
  // Less by a thousand millionth: strictly below what bond_strength() computes, however that is rounded.
  constexpr Real less = 1 - 1e-9, more = 1 + 1e-9;
  auto const less_than = [](Real strength) { return strength - 1e-9 * lane_abs(strength); };
  Real const least_thickness = rod_thickness(law.strength, law.plate_thickness),
             largest_thickness = rod_thickness(law.strength, law.thickness_weight * law.critical_thickness + law.plate_thickness);
  Real const of_tension = tension_addend(least_thickness), of_compression = compression_addend(largest_thickness);
  Real const tension = law.strength.rod_share * of_tension, compression = law.strength.rod_share * of_compression;
  Real const rolling = less * law.least_shape_of_rolling * rolling_slope(more * largest_thickness);
  LeastStrength least;
  least.tension = less_than(tension);
  least.tension_per_width = less_than(law.strength.tensile_stress + law.strength.rod_share_per_width * of_tension);
  least.compression = less_than(compression);
  least.compression_per_width = less_than(law.strength.compressive_stress + law.strength.rod_share_per_width * of_compression);
  least.shear_slope = less * law.least_shape_of_shear * shear_slope(more * largest_thickness);
  least.moment = rolling * law.strength.moment_length;
  least.moment_per_width = rolling * law.strength.moment_width_ratio;
  return least;
}

/// True for most bonds that hold (Eq. 9): the envelope is replaced by a trapezoid inside it, 1.28 (F_n + R_t), 0.28 (R_c + R_t)
/// and 2.02 (R_c - F_n), and the strengths by their least values. Where false, is_surely_intact() may still know.
template <class L>
KOKKOS_FORCEINLINE_FUNCTION auto is_far_from_breaking(LeastStrength const& least, BondForce<L> const& bond) {
  L const tension = least.tension_per_width * bond.width + least.tension;
  L const compression = least.compression_per_width * bond.width + least.compression;
  L const moment_slope = least.moment_per_width * bond.width + least.moment;
  Real const rising = 1.28 * least.shear_slope, flat = 0.28 * least.shear_slope, falling = 2.02 * least.shear_slope;
  L const size = lane_min(lane_min(rising * (bond.force.normal + tension), flat * (compression + tension)),
                          falling * (compression - bond.force.normal));
  L const of_shear = bond.force.shear * moment_slope, of_moment = bond.force.moment * least.shear_slope;
  L const limit = moment_slope * lane_max(size, L(0));
  return of_shear * of_shear + of_moment * of_moment < limit * limit;
}

/// True where a bond is certainly within its strength: a close lower bound of its envelope already holds. Where false, the exact
/// test decides.
template <class L>
KOKKOS_FORCEINLINE_FUNCTION auto is_surely_intact(BondLaw const& law, BondForce<L> const& bond) {
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
