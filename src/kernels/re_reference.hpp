#pragma once
/// What the contact kernel does in mixed precision where pairs get a new reference configuration.
#include "kernels/contacts.hpp"
#include "kernels/reference_configuration.hpp"

namespace clathra {

/// Pairs of a block in the step under way. It is put together where it is needed: a block whose values had an address would spend
/// its time storing and loading them.
struct PairsToReReference {
  std::size_t entry;
  MaskOf<FloatLanes> where;  ///< what becomes another one whatever the rotations of the discs are: begins, ends, or is broken
  MaskOf<FloatLanes> touching, intact;  ///< and bonded
  IntLanes ticks_x, ticks_y;            ///< branches
  FloatLanes dx, dy;                    ///< the same, rounded
  FloatLanes inverse2, arm, other_arm, rotation_increment, other_rotation_increment, sine2;
};

/// @tparam Shears,Moments  which histories grain contacts (or bonds in their place) have;  @tparam Separate  bonds have their own
template <bool Shears, bool Moments, bool Separate>
struct ReReference {
  ContactRows const& rows;

  /// Gives pairs that begin, or have rotated far, their present branch as the reference, and discs that have rotated far a new
  /// angle zero, and sets their histories so that the forces are those of now.
  /// @tparam Forces  of the contact kernel
  template <class Forces>
  CLATHRA_COLD_FUNCTION void apply(PairsToReReference const& at, Forces const& now) const {
    auto const where = at.where || at.sine2 > FloatLanes(largest_rotation * largest_rotation) ||
                       has_rotated_far(at.rotation_increment) || has_rotated_far(at.other_rotation_increment);
    FloatLanes const own = rotation_from_now_on(at.rotation_increment), other = rotation_from_now_on(at.other_rotation_increment),
                     relative = other - own;
    FloatLanes slip(0);
    if constexpr (Shears || Separate) {
      std::int32_t* const references = rows.reference_branch.data<std::int32_t>() + at.entry;
      IntLanes const reference = select_ints(where, packed_branch(at.dx, at.dy), load_ints(references));
      store_ints(references, reference);
      auto const branch = branch_since(reference, at.ticks_x, at.ticks_y, at.dx, at.dy, at.inverse2);
      slip = motion_since(branch, at.arm, at.other_arm, own, other).slip;
    }
    auto const of_grains = Separate ? at.touching : at.touching || at.intact;
    auto const set = [&](RealField const& field, auto const& force, FloatLanes const& way, MaskOf<FloatLanes> const& carries) {
      float* const to = field.data<float>() + at.entry;
      FloatLanes const at_reference =
          select(carries, negative_multiply_add(force.stiffness, way, force.now), FloatLanes(no_bond_single));
      store(to, select(where, at_reference, load(to)));
    };
    if constexpr (Shears) set(rows.shear, now.shear, slip, of_grains);
    if constexpr (Moments) set(rows.moment, now.moment, relative, of_grains);
    if constexpr (Separate) {
      set(rows.bond_shear, now.bond_shear, slip, at.intact);
      set(rows.bond_moment, now.bond_moment, relative, at.intact);
    }
  }
};

}  // namespace clathra
