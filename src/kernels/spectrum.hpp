#pragma once
/// The largest angular frequency of the present network, from below.
#include <vector>

#include "kernels/motion.hpp"

namespace clathra {

/// Largest angular frequency [1/s] of the present contact network (sticking contacts, intact bonds, walls; no dashpots) by
/// Lanczos' method on M^-1 K from a random start; leapfrog is stable below dt = 2 / omega. Converges from below: on packings 40
/// iterations reach better than 0.1 %.
/// @param springs  those that are there, or all to come
/// @return 0 where no disc has a spring
Real largest_frequency(SpringNetwork const& network, AcrossRanks const& across, int iterations, SpringSet const& springs = {});

/// The largest eigenvalue of a symmetric tridiagonal matrix.
/// @param diagonal  [n], n >= 1;  @param beside  the diagonal beside it, [n - 1] or more
Real largest_eigenvalue(std::vector<Real> const& diagonal, std::vector<Real> const& beside);

}  // namespace clathra
