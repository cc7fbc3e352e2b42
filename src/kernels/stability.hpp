#pragma once
/// The stable time step of explicit integration: an estimate from each disc's own springs and the exact limit by power iteration.
#include "kernels/pair_state.hpp"
#include "kernels/walls.hpp"

namespace clathra {

/// sqrt(2) * min over discs of sqrt(m / k), sqrt(I / k_rot) [s], with k the larger diagonal of the disc's translational stiffness and
/// k_rot = sum(k_s arm^2 + k_m). Contacts that may still form are counted: at least `least_contacts` a disc, as stiff as the pair's common
/// radius makes them. Multiply by a safety factor.
/// @param bonds_may_close  `parallel`: a bonded gap that closes adds its grain contact to the bond
Real local_time_step(ParticleSoA const& particles, ContactRows const& rows, ContactLaws const& laws, int least_contacts = 6);

/// Largest angular frequency [1/s] of the present contact network (sticking contacts, intact bonds, walls) by power iteration on M^-1 K from
/// above-random start; leapfrog is stable below dt = 2 / omega. Converges from below; 20 iterations reach about 2 %.
Real largest_frequency(ParticleSoA const& particles, ContactRows const& rows, ContactLaws const& laws, WallContacts const& wall_contacts,
                       Walls const& walls, WallLaw const& wall_law, int iterations = 20);

}  // namespace clathra
