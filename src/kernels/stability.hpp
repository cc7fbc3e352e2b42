#pragma once
/// The stable time step of explicit integration: an estimate from each disc's own springs and the exact limit by power iteration.
#include "kernels/pair_state.hpp"
#include "kernels/walls.hpp"

namespace clathra {

/// sqrt(2) * min over discs of sqrt(m / k), sqrt(I / k_rot) [s], with k the larger diagonal of the disc's translational stiffness
/// and k_rot = sum(k_s r^2 + k_m). Contacts that may still form are counted: at least `least_contacts` a disc, as stiff as its
/// stiffest, and the grain contact of a bonded gap that may close (`parallel`). Multiply by a safety factor. On packings the
/// result is 0.65 of the exact limit (0.71-0.74 without the contacts to come, 0.56 with six); with a safety of 0.7 even a
/// smallest disc that gains two more contacts than it has stays below 0.65 of it.
Real local_time_step(ParticleSoA const& particles, ContactRows const& rows, ContactLaws const& laws, int least_contacts = 4);

/// What the power iteration needs to know of the other ranks and of the periodic boundary.
struct AcrossRanks {
  Real period = 0;   ///< local_time_step() with no contacts to come, the least of all ranks [s]
  SumOverRanks sum;  ///< for exact_sums()
  std::function<void(Field<Real> const&)> refresh_ghosts;  ///< gives every ghost the value of its disc
};

/// Largest angular frequency [1/s] of the present contact network (sticking contacts, intact bonds, walls) by power iteration on
/// M^-1 K from above-random start; leapfrog is stable below dt = 2 / omega. Converges from below; 20 iterations reach about 2 %.
Real largest_frequency(ParticleSoA const& particles, ContactRows const& rows, ContactLaws const& laws, Walls const& walls,
                       WallLaw const& wall_law, AcrossRanks const& across, int iterations);

}  // namespace clathra
