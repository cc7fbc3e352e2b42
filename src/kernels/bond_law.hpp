#pragma once
/// The law of an intact bond: forces (Jiang et al. 2017, Eq. 7) and the variants that a scene can choose.
#include "kernels/bond_geometry.hpp"
#include "kernels/bond_kind.hpp"
#include "kernels/bond_stiffness.hpp"
#include "kernels/bond_strength.hpp"
#include "kernels/grain_contact.hpp"
#include "kernels/strength_scatter.hpp"

namespace clathra {

/// The mark of no bond, in numbers R.
template <class R>
inline constexpr R no_bond_of = static_cast<R>(sizeof(R) == sizeof(double) ? no_bond : no_bond_single);

template <class L>
KOKKOS_FORCEINLINE_FUNCTION auto is_bonded(L const& formation_overlap) {
  using R = scalar_of<L>;
  return formation_overlap < L(R(0.5) * no_bond_of<R>);
}

/// Everything one bond needs besides its pair: numbers of the hydrate and of the variant, the same for all bonds of a specimen.
template <class R>
struct BondLawOf {
  BondStrengthLawOf<R> strength;
  R modulus = R(2.89e8);            ///< E_m [Pa]
  R particle_stiffness = R(3.0e8);  ///< k_n of one grain in Eq. 16
  R critical_thickness = 0;         ///< h_max [m]
  R thickness_partner = 0;          ///< h_0 = (h_cr + partner) / 2 [m]: h_max, or the plate thickness t_0
  R thickness_weight = 1;  ///< h_cr = thickness_weight * max(0, -u_0) + plate_thickness; 1 and 0 for the thickness-dependent law,
  R plate_thickness = 0;   ///< 0 and t_0 for the earlier constant-thickness law
  R preload_stiffness = 0;           ///< `memory`: k_n, which keeps the force of a contact that was loaded when the bond formed
  R least_shape_of_shear = R(1.16);  ///< lower bounds of f_s and f_r over the gaps 0 .. h_max, for the quick test
  R least_shape_of_rolling = R(1.13);
  // Of hydrate that has receded from both ends of each bond, B = width_share * (B of formation - width_lost). Rows keep B: the
  // kernels of a step have no use for these.
  R width_lost = 0;  ///< 2 v t [m]
  R width_share = 1;
  StrengthScatter scatter = {};  ///< of the strength; lanes know that of the weakest bond

  /// Thickness h_cr [m] of a bond that formed at overlap u_0 [m]; a gap is u_0 < 0, an overlap counts as gap 0.
  template <class L>
  KOKKOS_FORCEINLINE_FUNCTION L bond_thickness(L const& formation_overlap) const {
    return negative_multiply_add(L(thickness_weight), lane_min(formation_overlap, L(0)), L(plate_thickness));
  }
  /// B [m] of a bond with the given common radius and h_cr [m], where hydrate has not receded.
  template <class L>
  KOKKOS_FORCEINLINE_FUNCTION L width(L const& common_radius, L const& thickness) const {
    return bond_width(common_radius, critical_thickness - thickness);
  }
  /// B [m] of today of a bond that formed at overlap u_0 [m]. In a step it does not change, so the rows keep it.
  template <class L>
  KOKKOS_FORCEINLINE_FUNCTION L width_formed_at(L const& common_radius, L const& formation_overlap) const {
    return L(width_share) * lane_max(width(common_radius, bond_thickness(formation_overlap)) - L(width_lost), L(0));
  }
  template <class L>
  KOKKOS_FORCEINLINE_FUNCTION ContactStiffness<L> stiffness(L const& width, L const& thickness) const {
    return bond_stiffness(particle_stiffness, modulus, width, effective_thickness(thickness, L(thickness_partner)));
  }
};
using BondLaw = BondLawOf<Real>;

/// The same law in the numbers of a kernel.
template <class R>
KOKKOS_INLINE_FUNCTION BondLawOf<R> cast(BondLaw const& law) {
  return {cast<R>(law.strength),        R(law.modulus),           R(law.particle_stiffness),
          R(law.critical_thickness),    R(law.thickness_partner), R(law.thickness_weight),
          R(law.plate_thickness),       R(law.preload_stiffness), R(law.least_shape_of_shear),
          R(law.least_shape_of_rolling)};
}

/// The law of the weakest bond.
inline BondLaw weakest(BondLaw law) {
  if (law.scatter.is_on()) law.strength = part_of(law.strength, law.scatter.least);
  return law;
}

/// Forces of an intact bond and what they follow from.
template <class L>
struct BondForce {
  ContactForce<L> force;
  ContactStiffness<L> stiffness;
  L width, thickness;
};

/// F_n = k_bn (u_n - u_0) (Eq. 7) and the stiffness that the others grow by; they are zero here. With `memory` F_n keeps k_n u_0
/// of a loaded contact.
/// @param formation_overlap  u_0 [m];  @param width  B [m]
template <class R, class L>
KOKKOS_FORCEINLINE_FUNCTION BondForce<L> bond_springs(BondLawOf<R> const& law, ContactMotion<L> const& motion,
                                                      L const& formation_overlap, L const& width) {
  BondForce<L> bond;
  bond.thickness = law.bond_thickness(formation_overlap);
  bond.width = width;
  bond.stiffness = law.stiffness(bond.width, bond.thickness);
  bond.force.normal = multiply_add(bond.stiffness.normal, motion.overlap - formation_overlap,
                                   law.preload_stiffness * lane_max(formation_overlap, L(0)));
  bond.force.shear = bond.force.moment = L(0);
  return bond;
}

/// The forces after a step: F_s += k_bs Delta u_s, M += k_bm Delta theta.
/// @param shear,moment  bond F_s [N/m] and M [N m/m] of the last step
template <class R, class L>
KOKKOS_FORCEINLINE_FUNCTION BondForce<L> bond_contact(BondLawOf<R> const& law, ContactMotion<L> const& motion,
                                                      L const& formation_overlap, L const& width, L const& shear,
                                                      L const& moment) {
  BondForce<L> bond = bond_springs(law, motion, formation_overlap, width);
  bond.force.shear = shear + bond.stiffness.shear * motion.shear_increment;
  bond.force.moment = moment + bond.stiffness.rolling * motion.relative_rotation;
  return bond;
}

}  // namespace clathra
