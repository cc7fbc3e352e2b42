#pragma once
/// Leapfrog integration of the discs' motion.
#include "kernels/particles.hpp"
#include "kernels/reports.hpp"
#include "kernels/step_graph.hpp"
#include "kernels/step_state.hpp"

namespace clathra {

/// How discs answer their forces.
struct MotionLaw {
  Real damping = 0.3;  ///< alpha of local damping, F_d = -alpha |F| sign(v - v_frame), for forces and torque; 0 = none
  Real gravity_x = 0;  ///< [m/s^2]
  Real gravity_y = 0;
  bool in_frame = true;  ///< v_frame is that of the walls' homogeneous motion; else 0, for walls that move for themselves
};

/// The two parts of a step [s]. Velocities lie half a step behind: where its length changes, the kick is the mean of both.
struct StepLengths {
  Real kick, drift;
};

/// Where the last choice of the time step found the discs.
struct PlacesOfChoice {
  Field<Coord> x, y;  ///< [owned] [m]
};

/// v(t+dt/2) = v(t-dt/2) + (F + F_d)/m dt, then x(t+dt) = x(t) + v dt; likewise omega and the angle. Second order for forces of
/// position.
/// The longest way of a disc, max (|Delta x| + |Delta y|) at least, goes into the state of the steps, and the move ends there
/// unless the host goes along (StepState). On a GPU steps that may leave a doubt measure the discs' own ways as well.
/// @param losses  the damping account is written when its field exists
/// @param steps  whose frame is that of the step; nothing happens while they are stopped
/// @param choice  where the last choice of dt found the discs, empty without one
/// @param launches  where the kernel goes
void integrate(ParticleSoA const& particles, MotionLaw const& law, StepLengths const& dt, EnergyLosses const& losses,
               Faults const& faults, DeviceSteps const& steps, PlacesOfChoice const& choice = {},
               StepLaunches const& launches = {});

}  // namespace clathra
