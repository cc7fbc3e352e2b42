#pragma once
/// The contact law of unbonded grains: normal, shear and rolling (Jiang et al. 2017, Eq. 8).
#include "kernels/contact_law.hpp"

namespace clathra {

/// Constants of the unbonded law, in numbers R. Stiffness in N/m per metre thickness.
template <class R>
struct GrainLawOf {
  R normal_stiffness = R(3.0e8);  ///< k_n
  R shear_stiffness = R(2.0e8);   ///< k_s
  R friction = R(0.5);            ///< mu
  R shape_factor = 2;             ///< beta; contact width B_c = beta * common radius; 0 = no rolling resistance
  R damping_ratio = 0;            ///< xi of the optional normal dashpot, fraction of critical

  /// k_m / common_radius^2 = k_n beta^2 / 12 [N/m] (Jiang, Yu, Harris 2005; the bond analogue is Eq. 21).
  KOKKOS_INLINE_FUNCTION R rolling_factor() const { return normal_stiffness * shape_factor * shape_factor / 12; }
};
using GrainLaw = GrainLawOf<Real>;

/// The same law in the numbers of a kernel.
template <class R>
KOKKOS_INLINE_FUNCTION GrainLawOf<R> cast(GrainLaw const& law) {
  return {R(law.normal_stiffness), R(law.shear_stiffness), R(law.friction), R(law.shape_factor), R(law.damping_ratio)};
}

/// Rolling stiffness k_m = k_n B_c^2 / 12 [N m/rad per m] of a contact with the given common radius [m].
template <class R, class L>
KOKKOS_FORCEINLINE_FUNCTION L rolling_stiffness(GrainLawOf<R> const& law, L const& common_radius) {
  return law.rolling_factor() * common_radius * common_radius;
}

/// F_n = k_n u_n of a contact with overlap u_n > 0 [N/m] (Eq. 8); no force where it is not positive.
template <class R, class L>
KOKKOS_FORCEINLINE_FUNCTION L spring_force(GrainLawOf<R> const& law, L const& overlap) {
  return law.normal_stiffness * overlap;
}

/// The tangent of forces and moment, at this overlap > 0 [m] with this common radius [m].
template <class R, class L>
KOKKOS_FORCEINLINE_FUNCTION ContactStiffness<L> grain_stiffness(GrainLawOf<R> const& law, [[maybe_unused]] L const& overlap,
                                                                L const& common_radius) {
  return {L(law.normal_stiffness), L(law.shear_stiffness), rolling_stiffness(law, common_radius)};
}

/// Elastic energy of a contact under these forces, without dashpot part [J/m].
/// @param stiffness  grain_stiffness() of the contact
template <class R, class L>
KOKKOS_FORCEINLINE_FUNCTION L grain_energy([[maybe_unused]] GrainLawOf<R> const& law, ContactForce<L> const& elastic,
                                           ContactStiffness<L> const& stiffness) {
  return spring_energy(elastic, stiffness);
}

/// In place of a dashpot coefficient: contacts are not viscous.
struct Undamped {};

/// The normal force, >= 0 [N/m]; 0 for u_n <= 0.
template <class R, class L>
KOKKOS_FORCEINLINE_FUNCTION L normal_force(GrainLawOf<R> const& law, ContactMotion<L> const& motion, Undamped) {
  return lane_max(spring_force(law, motion.overlap), L(0));
}

/// The same with a dashpot [N s/m per m]; the sum of both is never tensile.
template <class R, class L>
KOKKOS_FORCEINLINE_FUNCTION L normal_force(GrainLawOf<R> const& law, ContactMotion<L> const& motion, L const& dashpot) {
  L const damped = lane_max(L(0), spring_force(law, motion.overlap) + dashpot * motion.closing_velocity);
  return select(motion.overlap > L(0), damped, L(0));
}

/// What the dashpot takes out in a step, from a normal force that it has a part in [J/m].
template <class R, class L>
KOKKOS_FORCEINLINE_FUNCTION L dashpot_loss(GrainLawOf<R> const& law, ContactMotion<L> const& motion, L const& normal, R dt) {
  return (normal - normal_force(law, motion, Undamped())) * (motion.closing_velocity * dt);
}

/// The largest |F_s| under a normal force [N/m] (Eq. 8b).
template <class R, class L>
KOKKOS_FORCEINLINE_FUNCTION L shear_limit(GrainLawOf<R> const& law, L const& normal) {
  return law.friction * normal;
}
/// The largest |M|, F_n B_c / 6 [N m/m] (Eq. 8c).
template <class R, class L>
KOKKOS_FORCEINLINE_FUNCTION L moment_limit(GrainLawOf<R> const& law, L const& common_radius, L const& normal) {
  return (law.shape_factor / 6) * common_radius * normal;
}

/// Eq. 8 with signed limits: F_n = k_n u_n >= 0; |F_s| <= mu F_n; |M| <= F_n B_c / 6. A contact with u_n <= 0 carries nothing.
/// @param trial_shear,trial_moment  F_s + k_s Delta u_s and M + k_m Delta theta before the limits; for a bond that broke in
///                                  this step its own last forces, which are clipped to the limits and not reset
/// @param dashpot                   viscous normal coefficient [N s/m per m] or Undamped
template <bool Rolling, bool Friction = true, class R, class L, class Dashpot>
KOKKOS_FORCEINLINE_FUNCTION ContactForce<L> limit_grain_contact(GrainLawOf<R> const& law, ContactMotion<L> const& motion,
                                                                L const& trial_shear, L const& trial_moment,
                                                                Dashpot const& dashpot) {
  ContactForce<L> force;
  force.normal = normal_force(law, motion, dashpot);
  force.shear = force.moment = L(0);
  if constexpr (Friction) force.shear = clamp_to(trial_shear, shear_limit(law, force.normal));
  if constexpr (Rolling) force.moment = clamp_to(trial_moment, moment_limit(law, motion.common_radius, force.normal));
  return force;
}

/// One step of an unbonded contact, without rolling resistance or friction where the law has none, with history F_s, M (Eq. 8).
template <bool Rolling, bool Friction = true, class R, class L, class Dashpot>
KOKKOS_FORCEINLINE_FUNCTION ContactForce<L> grain_contact(GrainLawOf<R> const& law, ContactMotion<L> const& motion,
                                                          L const& shear, L const& moment, Dashpot const& dashpot) {
  L trial_shear(0), trial_moment(0);
  if constexpr (Friction) trial_shear = shear + law.shear_stiffness * motion.shear_increment;
  if constexpr (Rolling) trial_moment = moment + rolling_stiffness(law, motion.common_radius) * motion.relative_rotation;
  return limit_grain_contact<Rolling, Friction>(law, motion, trial_shear, trial_moment, dashpot);
}

/// Dashpot coefficient 2 xi sqrt(k_n m_eff) for two masses given by their inverses [N s/m per m]; m_eff = m1 m2 / (m1 + m2).
template <class R, class L>
KOKKOS_FORCEINLINE_FUNCTION L dashpot_coefficient(GrainLawOf<R> const& law, L const& inverse_mass_a, L const& inverse_mass_b) {
  return (2 * law.damping_ratio) * lane_sqrt(law.normal_stiffness / (inverse_mass_a + inverse_mass_b));
}

/// Bulk modulus of a dense packing of such grains, from the mean of many [Pa].
inline Real packing_modulus(GrainLaw const& law) { return 0.8 * law.normal_stiffness; }

}  // namespace clathra
