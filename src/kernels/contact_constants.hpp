#pragma once
/// The laws as the contact kernel takes them.
#include "kernels/bond_quick_test.hpp"
#include "kernels/forces.hpp"
#include "kernels/history.hpp"

namespace clathra {

/// Numbers of the laws. The kernel works on a copy on its stack, which no store can change, so that what follows from them is
/// computed once a group. In mixed precision forces and moments count in the units of their histories, powers of two.
template <class R>
struct ContactConstants {
  GrainLawOf<R> grain;       ///< with forces in their unit, moments in that times metres
  BondLawOf<R> bond;         ///< likewise, but for the strength, which is in SI units
  LeastStrengthOf<R> least;  ///< likewise
  R dt;
  HistoryScale<R> forces, moments;
  R force_unit;   ///< [N/m]; 1 in double precision
  R moment_unit;  ///< in units of force times metres; 1 in double precision
  // Of grain contacts, as histories take them:
  R shear_of_step;    ///< k_s
  R rolling_of_step;  ///< k_m over the common radius squared
  R limit_of_moment;  ///< |M| over the common radius and the normal force
  // In mixed precision:
  R tick, per_tick;  ///< what differences of places count in [m], and one over it
};

/// The laws as the kernel takes them, in numbers R.
template <class R>
ContactConstants<R> constants_in(ContactLaws const& laws, HistoryFormat const& format, Real dt, Real tick) {
  bool const mixed = format.precision == Precision::mixed;
  Real const unit = format.force_unit,
             unit_of_moments = format.moment_unit / unit;  // in the kernel's units of force times metres
  GrainLaw const grain = in_force_units(laws.grain, unit);
  ContactConstants<R> c;
  c.grain = in_numbers<R>(grain);
  c.bond = in_numbers<R>(in_force_units(laws.bond, unit));
  c.least = least_strength<R>(laws.bond, unit, unit_of_moments);
  c.dt = R(dt);
  c.forces = {R(mixed ? dt : 1), 0};
  c.moments = {R(mixed ? dt / unit_of_moments : 1), 0};
  c.force_unit = R(unit);
  c.moment_unit = R(unit_of_moments);
  c.shear_of_step = R(grain.shear_stiffness * (mixed ? dt : 1));
  c.rolling_of_step = R(grain.rolling_factor() * (mixed ? dt / unit_of_moments : 1));
  c.limit_of_moment = R(grain.shape_factor / 6 / unit_of_moments);
  c.tick = R(tick);
  c.per_tick = R(1 / tick);
  return c;
}

}  // namespace clathra
