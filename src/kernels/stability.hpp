#pragma once
/// The stable time step of explicit integration: an estimate from each disc's own springs, and a bound from below on the exact
/// limit, which a step may be chosen by.
#include "kernels/motion.hpp"

namespace clathra {

/// sqrt(2) * min over discs of sqrt(m / k), sqrt(I / k_rot) [s], with k the larger diagonal of the disc's translational stiffness
/// and k_rot = sum(k_s r^2 + k_m), over the springs to come, all bonded gaps closed. Contacts that may still form are counted: at
/// least `least_contacts` a disc, as stiff as its stiffest. Multiply by a safety factor. On packings the result is 0.65 of the
/// exact limit without damping (0.71-0.74 without the contacts to come, 0.56 with six); with a safety of 0.7 even a smallest disc
/// that gains two more contacts than it has stays below 0.65 of it.
Real local_time_step(SpringNetwork const& network, int least_contacts = 4);

/// A time step [s] below which leapfrog is stable: local damping kicks with (1 + alpha) times the force at worst, a dashpot with
/// the velocity of half a step before, so the condition is (1 + alpha) lambda_max(M^-1 (dt^2 K + 2 dt C)) <= 4. The eigenvalue is
/// bounded from above for any positive vector u by max_i (|M^-1 (K + 2 C / dt)| u)_i / u_i (Collatz, Wielandt); u comes out of
/// up to twelve products from M^-1/2, dt grows towards the bound from below. Over the springs to come. Sliding contacts count
/// only above a friction of 2, where they may vibrate faster than sticking ones, and below 1000, where none slides. A function of
/// the state alone, the same for any number of threads and ranks.
/// @param alpha  of local damping, 0 = none
/// @param skin_fraction  gaps below this share of both discs' Verlet skins count as closed: the bound holds until a disc is
/// displaced by that share of its own
/// @return 1e300 where no disc has a spring
Real stable_limit(SpringNetwork const& network, Real alpha, Real skin_fraction, AcrossRanks const& across);

}  // namespace clathra
