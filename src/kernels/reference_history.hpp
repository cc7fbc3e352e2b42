#pragma once
/// The histories of mixed precision: the rows hold the shear force and moment at the pair's reference configuration, and a mark,
/// no_bond, where a pair has none because it does not touch. The force of now follows from how the pair has moved since
/// (reference_configuration.hpp), so that no step's rounding is added to another's.
#include "kernels/kernel_variant.hpp"
#include "kernels/re_reference.hpp"

namespace clathra {

/// @tparam Variant  KernelVariant
template <class Variant>
struct ReferenceHistory {
  using V = typename Variant::V;
  using VMask = typename Variant::VMask;
  using Discs = typename Variant::Discs;
  using History = typename Variant::History;
  using Force = typename Variant::Force;
  using Forces = typename Variant::Forces;
  using Pairs = typename Variant::Pairs;
  using StepIncrement = typename Variant::StepIncrement;
  using Constants = typename Variant::Constants;
  static constexpr bool shears = Variant::shears, slips = Variant::slips, rolls = Variant::rolls, separate = Variant::separate;

  /// Since the references, of all pairs of a block.
  struct Motion {
    ContactMotion<V> of_pair;
    V sine2;  ///< BranchSinceReference
  };

  KOKKOS_FORCEINLINE_FUNCTION static bool rotated_far(typename Discs::Own const& disc) {
    return any(has_rotated_far(disc.rotation_increment));
  }

  /// Pairs without a history of the grain contact (or of the bond in its place).
  KOKKOS_FORCEINLINE_FUNCTION static VMask is_none(History const& h) {
    if constexpr (shears) return h.shear == V(no_bond_single);
    if constexpr (rolls) return h.moment == V(no_bond_single);
    return VMask(false);
  }

  KOKKOS_FORCEINLINE_FUNCTION static void measure(ContactRows const& rows, std::size_t e, Constants const& law,
                                                  typename Discs::Own const& disc, typename Discs::Other const& other,
                                                  Pairs const& at, StepIncrement const& in_step, VMask const& none,
                                                  History const& h, Motion& motion) {
    motion.of_pair.common_radius = V(2) * disc.radius * other.radius * at.inverse_reach;  // of radii that are not zero
    motion.of_pair.shear_increment = in_step.slip;
    motion.of_pair.relative_rotation = other.rotation_increment - disc.rotation_increment;
    motion.sine2 = V(0);
    if constexpr (slips) {
      IntLanes const reference = load_ints(rows.reference_branch.data<std::int32_t>() + e);
      auto const branch = branch_since(reference, other.ticks_x, other.ticks_y, at.dx, at.dy, at.inverse_distance2);
      motion.of_pair.shear_increment =
          motion_since(branch, at.arm, at.other_arm, disc.rotation_increment, other.rotation_increment).slip;
      motion.sine2 = branch.sine2;
      motion.of_pair.overlap = overlap_since(reference, branch, at.distance, at.inverse_distance2, at.reach, law.tick,
                                             separate ? none && !is_bonded(h.formation_overlap) : none);
    }
  }

  /// The motion of the grain contacts: that of the pairs, but where they begin to touch, with the slip of this step.
  KOKKOS_FORCEINLINE_FUNCTION static ContactMotion<V> of_grains(ParticleSoA const& p, Constants const& law, std::size_t first,
                                                                int const* j, Pairs const& at, Motion const& motion,
                                                                VMask const& begins, History& h) {
    ContactMotion<V> grains = motion.of_pair;
    if constexpr (shears || rolls) {
      if (any(begins)) {
        StepIncrement const way = first_increment<Discs>(p, {law.dt, first, j, at.nx, at.ny, at.arm, at.other_arm});
        grains.shear_increment = select(begins, way.slip, grains.shear_increment);
        grains.relative_rotation = select(begins, way.rotation, grains.relative_rotation);
        if constexpr (shears) h.shear = select(begins, V(0), h.shear);
        if constexpr (rolls) h.moment = select(begins, V(0), h.moment);
      }
    }
    return grains;
  }

  /// The force if nothing slips. @param way  since the reference;  @param none  pairs that remember nothing
  template <class Stiffness>
  KOKKOS_FORCEINLINE_FUNCTION static V trial(V const& kept, Stiffness const& stiffness, V const& way, VMask const& none) {
    return multiply_add_where(!none, V(stiffness), way, kept);
  }
  template <class Stiffness>
  KOKKOS_FORCEINLINE_FUNCTION static V trial(V const& kept, Stiffness const& stiffness, V const& way) {
    return multiply_add(V(stiffness), way, kept);
  }

  /// The forces at the beginning of the step.
  KOKKOS_FORCEINLINE_FUNCTION static ContactForce<V> before(History const&, Forces const& now, StepIncrement const& in_step) {
    ContactForce<V> force{V(0), V(0), V(0)};
    if constexpr (shears) force.shear = negative_multiply_add(now.shear.stiffness, in_step.slip, now.shear.trial);
    if constexpr (Variant::moments)
      force.moment = negative_multiply_add(now.moment.stiffness, in_step.rotation, now.moment.trial);
    return force;
  }

  /// What is kept is less by what has slipped. Separate bonds keep what they have: they do not slip.
  KOKKOS_FORCEINLINE_FUNCTION static void write(ContactRows const& rows, std::size_t e, History const& h, Forces const& now) {
    auto const keep = [e](RealField const& field, V const& kept, Force const& force) {
      store(field.data<float>() + e, kept - (force.trial - force.now));
    };
    if constexpr (shears) keep(rows.shear, h.shear, now.shear);
    if constexpr (rolls) keep(rows.moment, h.moment, now.moment);
  }

  /// Gives pairs a new reference whose history begins or ends, whose bond is broken, or that have rotated far.
  KOKKOS_FORCEINLINE_FUNCTION static void end_step(ContactRows const& rows, std::size_t e, Constants const& law, bool rotated_far,
                                                   typename Discs::Own const& disc, typename Discs::Other const& other,
                                                   Pairs const& at, Motion const& motion, typename Variant::Outcome const& masks,
                                                   Forces& now) {
    if constexpr (slips || rolls) {
      auto const far = masks.carrying && lane_max(other.rotation_increment * other.rotation_increment, motion.sine2) >
                                             V(largest_rotation * largest_rotation);
      auto changes = masks.broken;
      if constexpr (shears || rolls) changes = changes || masks.none == (separate ? masks.touching : masks.carrying);
      if (any(far || changes) || rotated_far) {
        if constexpr (Variant::Bond == BondKind::replace) {
          now.shear.stiffness = select(masks.broken, V(law.grain.shear_stiffness), now.shear.stiffness);
          if constexpr (Variant::Rolling)
            now.moment.stiffness =
                select(masks.broken, rolling_stiffness(law.grain, motion.of_pair.common_radius), now.moment.stiffness);
        }
        ReReference<shears, rolls, separate>{rows}.apply(
            {e, changes, masks.touching, masks.intact, other.ticks_x, other.ticks_y, at.dx, at.dy, at.inverse_distance2, at.arm,
             at.other_arm, disc.rotation_increment, other.rotation_increment, motion.sine2},
            Forces(now));
      }
    }
  }
};

}  // namespace clathra
