#pragma once
/// Motions of a specimen as vectors, for products with its stiffness.
#include "kernels/exact_sum.hpp"
#include "kernels/springs.hpp"

namespace clathra {

/// A motion of all discs, ghosts included: two displacements and a rotation each; zero for the padding.
struct Motion {
  Field<Real> x, y, rotation;
};
Motion make_motion(ParticleSoA const& particles);

/// What products with the stiffness of the network need to know of the other ranks and of the periodic boundary.
struct AcrossRanks {
  Summation sums;
  std::function<double(double)> max;                       ///< over all ranks
  std::function<void(Field<Real> const&)> refresh_ghosts;  ///< gives every ghost the value of its disc
};

/// to = factor from, of the owned discs.
void scale_motion(int owned, Motion const& from, Real factor, Motion const& to);

/// Gives every ghost the motion of its disc.
void refresh(Motion const& motion, AcrossRanks const& across);

}  // namespace clathra
