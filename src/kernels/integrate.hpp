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

/// Where the last update of the time step found the discs.
struct UpdatePlaces {
  Field<Coord> x, y;  ///< [owned] [m]
};

/// v(t+dt/2) = v(t-dt/2) + (F + F_d)/m dt, then x(t+dt) = x(t) + v dt; likewise omega and the angle. Second order for forces of
/// position.
/// The largest displacement of a disc, max (|Delta x| + |Delta y|) at least, goes into the state of the steps, and the move ends
/// there unless the host has a part in it (StepState). On a GPU, steps after which a search or an update of the time step may be
/// due measure each disc's displacement since then as well.
/// @param losses  those to damping are written when its field exists
/// @param steps  whose frame is that of the step; nothing happens while they are stopped
/// @param at_update  where the last update of the time step found the discs, empty without one
/// @param launches  where the kernel goes
void integrate(ParticleSoA const& particles, MotionLaw const& law, StepLengths const& dt, Dissipation const& losses,
               Faults const& faults, DeviceSteps const& steps, UpdatePlaces const& at_update = {},
               StepLaunches const& launches = {});

}  // namespace clathra
