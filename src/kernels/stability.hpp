#pragma once
/// The stable time step of explicit integration: an estimate from each disc's own springs, the exact limit from below by power
/// iteration, and a bound on it that a step may be chosen by.
#include "kernels/exact_sum.hpp"
#include "kernels/springs.hpp"

namespace clathra {

/// sqrt(2) * min over discs of sqrt(m / k), sqrt(I / k_rot) [s], with k the larger diagonal of the disc's translational stiffness
/// and k_rot = sum(k_s r^2 + k_m), over the springs to come, all bonded gaps closed. Contacts that may still form are counted: at
/// least `least_contacts` a disc, as stiff as its stiffest. Multiply by a safety factor. On packings the result is 0.65 of the
/// exact limit without damping (0.71-0.74 without the contacts to come, 0.56 with six); with a safety of 0.7 even a smallest disc
/// that gains two more contacts than it has stays below 0.65 of it.
Real local_time_step(SpringNetwork const& network, int least_contacts = 4);

/// What products with the stiffness of the network need to know of the other ranks and of the periodic boundary.
struct AcrossRanks {
  Summation sums;
  std::function<double(double)> max;                       ///< over all ranks
  std::function<void(Field<Real> const&)> refresh_ghosts;  ///< gives every ghost the value of its disc
};

/// Largest angular frequency [1/s] of the present contact network (sticking contacts, intact bonds, walls; no dashpots) by power
/// iteration on M^-1 K from an above-random start; leapfrog is stable below dt = 2 / omega. A Rayleigh quotient: converges from
/// below, 20 iterations reach about 2 %.
Real largest_frequency(SpringNetwork const& network, AcrossRanks const& across, int iterations);

/// A time step [s] below which leapfrog is stable: local damping kicks with (1 + alpha) times the force at worst, a dashpot with
/// the velocity of half a step before, so the condition is (1 + alpha) lambda_max(M^-1 (dt^2 K + 2 dt C)) <= 4. The eigenvalue is
/// bounded from above for any positive vector u by max_i (|M^-1 (K + 2 C / dt)| u)_i / u_i (Collatz, Wielandt); u comes out of
/// ten products from M^-1/2, dt grows towards the bound from below. Over the springs to come, gaps below 0.03 mean diameters
/// closed.
/// On packings 0.94 to 1 of the exact limit of the present network, on lattices 0.86 to 1; never above it.
/// @param alpha  of local damping, 0 = none;  @return 1e300 where no disc has a spring
Real stable_limit(SpringNetwork const& network, Real alpha, AcrossRanks const& across);

}  // namespace clathra
