#pragma once
/// How the discs of a pair stand and move against each other, as the contact kernel computes it.
#include "kernels/disc_reader.hpp"

namespace clathra {

/// 1 / distance, its square, and 1 / reach.
template <class V>
struct Inverses {
  V of_distance, of_distance2, of_reach;
};
/// In mixed precision by one quotient, which need not wait for the root.
/// @tparam Reach  whether 1 / reach is needed, in mixed precision
template <bool Mixed, bool Reach, class V>
KOKKOS_FORCEINLINE_FUNCTION Inverses<V> inverses(V const& distance, [[maybe_unused]] V const& distance2,
                                                 [[maybe_unused]] V const& reach) {
  if constexpr (!Mixed) return {V(1) / distance, V(0), V(0)};
  if constexpr (Reach) {
    V const both = V(1) / (distance2 * reach), of_distance2 = reach * both;
    return {distance * of_distance2, of_distance2, distance2 * both};
  }
  V const of_distance2 = V(1) / distance2;
  return {distance * of_distance2, of_distance2, V(0)};
}

/// The slip [m] and relative rotation [rad] of a step.
template <class V>
struct IncrementOfStep {
  V slip, rotation;
};
/// By the velocities: Delta u_s = (dv . t - omega_i a_i - omega_j a_j) dt.
template <class Motion, class V>
KOKKOS_FORCEINLINE_FUNCTION IncrementOfStep<V> increment_of_step(scalar_of<V> dt, Motion const& disc, Motion const& other,
                                                                 V const& nx, V const& ny, V const& arm, V const& other_arm) {
  V const dvx = other.vx - disc.vx, dvy = other.vy - disc.vy;
  return {((dvy * nx - dvx * ny) - (disc.omega * arm + other.omega * other_arm)) * dt, (other.omega - disc.omega) * dt};
}

/// Pairs of which some begin to touch, whose motion has not been read.
template <class V>
struct BeginningPairs {
  scalar_of<V> dt;
  std::size_t first;  ///< disc
  int const* other;   ///< discs
  V nx, ny, arm, other_arm;
};
/// @tparam Discs  DiscReader
template <class Discs>
CLATHRA_COLD_FUNCTION inline IncrementOfStep<typename Discs::V> first_increment(ParticleSoA const& p,
                                                                                BeginningPairs<typename Discs::V> const& at) {
  return increment_of_step(at.dt, Discs::own_motion(p, at.first), Discs::other_motion(p, at.other), at.nx, at.ny, at.arm,
                           at.other_arm);
}

}  // namespace clathra
