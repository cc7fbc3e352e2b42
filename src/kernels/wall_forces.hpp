#pragma once
/// The forces of four rigid walls, with or without friction.
#include "kernels/contacts.hpp"
#include "kernels/grain_contact.hpp"
#include "kernels/reports.hpp"
#include "kernels/step_graph.hpp"
#include "kernels/step_state.hpp"

namespace clathra {

struct WallLaw {
  Real normal_stiffness = 3.0e8;  ///< k_n of a wall contact; also used with a dashpot ratio
  Real shear_stiffness = 2.0e8;
  Real friction = 0;       ///< mu_w; 0 = smooth: no shear history exists
  Real damping_ratio = 0;  ///< xi of the normal dashpot

  /// A wall contact follows the law of grains, without rolling.
  KOKKOS_INLINE_FUNCTION GrainLaw as_grain() const { return {normal_stiffness, shear_stiffness, friction, 0, damping_ratio}; }
};

/// The discs near a wall, in no particular order, with the shear history of their four possible wall contacts.
struct WallContacts {
  int size = 0;
  bool rough = false;
  Field<int> disc;                                      ///< [size]
  Kokkos::View<Real* [wall_count], MemorySpace> shear;  ///< [size][4] F_s [N/m], empty for smooth walls
  Field<Real> history;                                  ///< where it stands
};

/// The shear of rough walls by disc, while discs change their places: [owned] each, empty for smooth walls.
struct WallShear {
  Field<Real> of[wall_count];
};
WallShear wall_shear_of_discs(ParticleSoA const& particles, WallContacts const& contacts, Scratch& scratch);

/// Lists the discs whose surface is within twice their skin of a wall (found again after a restart, discs may have moved away
/// from it by one and may come back by two).
/// @param number  [1] on the device: how many; the list is not whole until the host has read it
Field<int> list_near_walls(ParticleSoA const& particles, Walls const& walls, Field<std::int64_t> const& number, Scratch& scratch);

/// The contacts of the listed discs; those of a rough wall have the shear history `shear`.
WallContacts make_wall_contacts(Field<int> const& near, int size, bool friction, WallShear const& shear, Scratch& scratch);

/// Adds the forces of the walls, where the state of the steps has them, to the discs near them, and steers the walls unless the
/// host has a part in the step (StepState). A wall is a disc of infinite radius without rolling. A disc whose centre lies behind
/// a wall (overlap above its radius) is a fault, as between discs.
/// @param losses  sliding and dashpot are written when their fields exist;  @param steps  nothing happens while they are stopped
/// @param ends_step  whether they are the last forces of the step, which then ends there;  @param launches  where the kernel goes
void add_wall_forces(ParticleSoA const& particles, WallContacts const& contacts, WallLaw const& law, Real dt,
                     Dissipation const& losses, Faults const& faults, SumUnits const& unit, DeviceSteps const& steps,
                     bool ends_step, StepLaunches const& launches = {});

/// What the walls have felt of the discs of all ranks.
/// @throws SumOutOfRange where a reaction is not finite
WallReactions wall_reactions(DeviceSteps const& steps, Summation const& sums);
/// The same of a step that found so many terms out of range: throws where there are any.
void require_reactions_in_range(std::int64_t out_of_range);

}  // namespace clathra
