#pragma once
/// What a step changes of the walls, in the memory of the device.
#include "kernels/loading.hpp"

namespace clathra {

/// The largest sigma_y - sigma_x after any step since somebody asked [Pa], and the height of the box then [m].
struct LargestDeviator {
  Real q = -1e300, height = 0;
};

/// Walls in the course of a test: moved, pushed by the discs, steered.
struct MovingWalls {
  Walls place;
  WallReactions reactions;
  Loading loading;
  Real work = 0;  ///< of the walls on the discs since the ledger was opened [J/m]
  LargestDeviator largest;

  /// After the forces of a step of length dt: adds up their work, keeps the largest deviator stress and steers the walls.
  KOKKOS_INLINE_FUNCTION void after_forces(WallReactions const& now, Real dt) {
    // The mean force over the step times the way: what leapfrog's kinetic energy sees to the digit.
    for (int wall = 0; wall < wall_count; ++wall) {
      Real const outward = wall == right || wall == top ? 1 : -1;
      work -= 0.5 * (reactions.normal[wall] + now.normal[wall]) * outward * place.velocity[wall] * dt;
    }
    reactions = now;
    WallStress const stress = wall_stress(place, reactions);
    if (stress.y - stress.x > largest.q) largest = {stress.y - stress.x, place.height()};
    loading.steer(place, stress, reactions, dt);
  }
};

}  // namespace clathra
