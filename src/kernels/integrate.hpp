#pragma once
/// Leapfrog integration of the discs' motion.
#include "kernels/particles.hpp"
#include "kernels/reports.hpp"

namespace clathra {

/// How discs answer their forces.
struct MotionLaw {
  Real damping = 0.3;  ///< alpha of local damping, F_d = -alpha |F| sign(v - v_frame), for forces and torque; 0 = none
  Real gravity_x = 0;  ///< [m/s^2]
  Real gravity_y = 0;
};

/// The homogeneous motion of the box. Neighbour lists may ignore it: x maps to centre + stretch (x_ref - reference_centre). Local
/// damping is taken against the motion relative to it, v_frame = gradient * (x - centre) + drift: against the absolute velocity
/// it would drag every disc of a specimen under compression the same way and hold up a share of the platens' stress that no
/// contact carries.
struct AffineFrame {
  Coord centre_x = 0, centre_y = 0;
  Coord reference_centre_x = 0, reference_centre_y = 0;
  Real stretch_x = 1, stretch_y = 1;
  Real gradient_x = 0, gradient_y = 0;  ///< d v_x / d x and d v_y / d y [1/s]
  Real drift_x = 0, drift_y = 0;        ///< velocity of the centre [m/s]

  /// Velocity of the homogeneous motion at a place [m/s].
  template <class L>
  KOKKOS_INLINE_FUNCTION L velocity_x(L const& x) const {
    return gradient_x * (x - centre_x) + drift_x;
  }
  template <class L>
  KOKKOS_INLINE_FUNCTION L velocity_y(L const& y) const {
    return gradient_y * (y - centre_y) + drift_y;
  }
};

/// The two parts of a step [s]. Velocities lie half a step behind: where its length changes, the kick is the mean of both.
struct StepLengths {
  Real kick, drift;
};

/// v(t+dt/2) = v(t-dt/2) + (F + F_d)/m dt, then x(t+dt) = x(t) + v dt; likewise omega and the angle. Second order for forces of
/// position.
/// @param losses  the damping account is written when its field exists
/// @return at least the longest way of a disc in this step, max (|Delta x| + |Delta y|) [m]
Real integrate(ParticleSoA const& particles, MotionLaw const& law, StepLengths const& dt, AffineFrame const& frame,
               EnergyLosses const& losses, Faults const& faults);

}  // namespace clathra
