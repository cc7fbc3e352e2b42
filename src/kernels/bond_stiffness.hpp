#pragma once
/// Stiffness of a hydrate bond between two grains (Jiang et al. 2017, Eqs. 16 to 21).
#include "kernels/contact_law.hpp"

namespace clathra {

/// Stands for a thickness of zero [m]: its square times a stiffness is a number still.
template <class R>
inline constexpr R least_thickness = static_cast<R>(sizeof(R) == sizeof(double) ? 1e-100 : 1e-15);

/// k_bn = k_n B E_m / (k_n h_0 + 2 B E_m) (Eq. 19; stays bounded where k_mh = B E_m / h_0 of Eq. 17 blows up),
/// k_bs = 2/3 k_bn (Eq. 20), k_bm = E_m B^3 / (12 h_0) (Eq. 21). All zero for B = 0.
/// @param particle_stiffness  k_n of one grain, two of them in series with the hydrate [N/m per m]
/// @param modulus             E_m [Pa];  @param width  B [m];  @param thickness  h_0 [m], > 0
template <class L>
KOKKOS_FORCEINLINE_FUNCTION ContactStiffness<L> bond_stiffness(scalar_of<L> particle_stiffness, scalar_of<L> modulus,
                                                               L const& width, L const& thickness) {
  L const hydrate = modulus * width;
  L const safe_thickness = lane_max(thickness, L(least_thickness<scalar_of<L>>));
  L const series = multiply_add(L(particle_stiffness), safe_thickness, hydrate + hydrate);
  L const shared = L(1) / (series * safe_thickness);  // one division serves both quotients
  ContactStiffness<L> stiffness;
  stiffness.normal = particle_stiffness * hydrate * (safe_thickness * shared);
  stiffness.shear = constant<L>(2.0 / 3.0) * stiffness.normal;
  stiffness.rolling = hydrate * width * width * constant<L>(1.0 / 12.0) * (series * shared);
  return stiffness;
}

}  // namespace clathra
