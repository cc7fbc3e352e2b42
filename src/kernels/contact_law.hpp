#pragma once
/// What all contact laws speak of: a contact's motion in a step, its forces, its tangent stiffness and its elastic energy.
#include "kernels/lane.hpp"

namespace clathra {

/// How two discs moved against each other during one step, seen from disc a. L is a lane type, all values per contact.
template <class L>
struct ContactMotion {
  L overlap;            ///< u_n = r1 + r2 - d [m]; negative for a gap
  L closing_velocity;   ///< -d(d)/dt, the normal closing velocity [m/s]
  L shear_increment;    ///< Delta u_s [m] during the step, equal on both sides
  L relative_rotation;  ///< Delta theta = (omega_b - omega_a) dt [rad], opposite on the two sides
  L common_radius;      ///< 2 r1 r2 / (r1 + r2) [m]
};

/// Forces of one contact: normal > 0 in compression [N/m], shear along t = (-n_y, n_x) [N/m], moment on disc a [N m/m].
template <class L>
struct ContactForce {
  L normal, shear, moment;
};

/// Tangent stiffness of a contact or bond while nothing slips or breaks: k_n, k_s [N/m per m] and k_m [N m/rad per m].
template <class L>
struct ContactStiffness {
  L normal, shear, rolling;
};

/// Energy of linear springs, F_n^2/2k_n + F_s^2/2k_s + M^2/2k_m [J/m]; one without stiffness carries no force and holds none.
template <class L>
KOKKOS_FORCEINLINE_FUNCTION L spring_energy(ContactForce<L> const& force, ContactStiffness<L> const& stiffness) {
  L const floor(least_divisor<scalar_of<L>>);
  return constant<L>(0.5) * (force.normal * force.normal / lane_max(stiffness.normal, floor) +
                             force.shear * force.shear / lane_max(stiffness.shear, floor) +
                             force.moment * force.moment / lane_max(stiffness.rolling, floor));
}

}  // namespace clathra
