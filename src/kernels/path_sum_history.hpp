#pragma once
/// The histories of double precision: the rows hold the shear forces and moments themselves, F += k Delta u_s and M += k_m Delta
/// theta in each step, from the discs' velocities. It is the law as the papers write it, and what the histories of mixed
/// precision (reference_history.hpp) are measured against, so it shares none of their code.
#include "kernels/kernel_variant.hpp"

namespace clathra {

/// A history that has ended is zero, which is what a new one begins with: no pair needs a mark, and all masks here are false.
/// @tparam Variant  KernelVariant
template <class Variant>
struct PathSumHistory {
  using V = typename Variant::V;
  using VMask = typename Variant::VMask;
  using Discs = typename Variant::Discs;
  using History = typename Variant::History;
  using Force = typename Variant::Force;
  using Forces = typename Variant::Forces;
  using Pairs = typename Variant::Pairs;
  using StepIncrement = typename Variant::StepIncrement;

  /// Of the step under way, for all of its pairs.
  struct Motion {
    ContactMotion<V> of_pair;
  };

  KOKKOS_FORCEINLINE_FUNCTION static bool rotated_far(typename Discs::Own const&) { return false; }
  KOKKOS_FORCEINLINE_FUNCTION static VMask is_none(History const&) { return VMask(false); }

  KOKKOS_FORCEINLINE_FUNCTION static void measure(ContactRows const&, std::size_t, typename Variant::Constants const&,
                                                  typename Discs::Own const& disc, typename Discs::Other const& other,
                                                  Pairs const&, StepIncrement const& in_step, VMask const&, History const&,
                                                  Motion& motion) {
    motion.of_pair.shear_increment = in_step.slip;
    motion.of_pair.relative_rotation = in_step.rotation;
    motion.of_pair.common_radius = common_radius(disc.radius, other.radius);
  }

  /// The motion of the grain contacts: that of the pairs.
  KOKKOS_FORCEINLINE_FUNCTION static ContactMotion<V> const& of_grains(ParticleSoA const&, typename Variant::Constants const&,
                                                                       std::size_t, int const*, Pairs const&,
                                                                       Motion const& motion, VMask const&, History&) {
    return motion.of_pair;
  }

  /// The force if nothing slips. @param way  during the step
  template <class Stiffness>
  KOKKOS_FORCEINLINE_FUNCTION static V trial(V const& kept, Stiffness const& stiffness, V const& way, VMask const&) {
    return kept + stiffness * way;
  }
  template <class Stiffness>
  KOKKOS_FORCEINLINE_FUNCTION static V trial(V const& kept, Stiffness const& stiffness, V const& way) {
    return kept + stiffness * way;
  }

  /// The forces at the beginning of the step.
  KOKKOS_FORCEINLINE_FUNCTION static ContactForce<V> before(History const& h, Forces const&, StepIncrement const&) {
    return {V(0), h.shear, h.moment};
  }

  KOKKOS_FORCEINLINE_FUNCTION static void write(ContactRows const& rows, std::size_t e, History const&, Forces const& now) {
    auto const keep = [e](RealField const& field, Force const& force) {
      store(field.data<typename Variant::R>() + e, force.now);
    };
    if constexpr (Variant::shears) keep(rows.shear, now.shear);
    if constexpr (Variant::rolls) keep(rows.moment, now.moment);
    if constexpr (Variant::separate) {
      keep(rows.bond_shear, now.bond_shear);
      keep(rows.bond_moment, now.bond_moment);
    }
  }

  KOKKOS_FORCEINLINE_FUNCTION static void end_step(ContactRows const&, std::size_t, typename Variant::Constants const&, bool,
                                                   typename Discs::Own const&, typename Discs::Other const&, Pairs const&,
                                                   Motion const&, typename Variant::Outcome const&, Forces&) {}
};

}  // namespace clathra
