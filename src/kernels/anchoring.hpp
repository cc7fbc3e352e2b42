#pragma once
/// What the contact kernel does in mixed precision where pairs are anchored anew.
#include "kernels/contacts.hpp"
#include "kernels/history.hpp"

namespace clathra {

/// Pairs of a block in the step under way. It is put together where it is needed: a block whose values had an address would spend
/// its time storing and loading them.
struct PairsToAnchor {
  std::size_t entry;
  MaskOf<FloatLanes> where;             ///< what becomes another one whatever the discs' turns are: begins, ends, or is broken
  MaskOf<FloatLanes> touching, intact;  ///< and bonded
  IntLanes ticks_x, ticks_y;            ///< branches
  FloatLanes dx, dy;                    ///< the same, rounded
  FloatLanes inverse2, arm, other_arm, turn, other_turn, turned2;
};

/// @tparam Shears,Moments  which histories grain contacts (or bonds in their place) have;  @tparam Separate  bonds have their own
template <bool Shears, bool Moments, bool Separate>
struct Anchoring {
  using Kept = HistoryOf<MixedPrecision>;
  ContactRows const& rows;

  /// Gives pairs that begin, or have turned far, their present branch as the anchor, and discs that have turned far a new angle
  /// zero, and sets their histories so that the forces are those of now.
  /// @tparam Forces  of the contact kernel
  template <class Forces>
  CLATHRA_COLD_FUNCTION void anchor(PairsToAnchor const& at, Forces const& now) const {
    auto const where = at.where || at.turned2 > FloatLanes(furthest_turn * furthest_turn) || has_turned_far(at.turn) ||
                       has_turned_far(at.other_turn);
    FloatLanes const turn = counted_on(at.turn), other_turn = counted_on(at.other_turn), rotation = other_turn - turn;
    FloatLanes slip(0);
    if constexpr (Shears || Separate) {
      std::int32_t* const anchors = rows.anchor.data<std::int32_t>() + at.entry;
      IntLanes const anchor = select_ints(where, anchor_at(at.dx, at.dy), load_ints(anchors));
      store_ints(anchors, anchor);
      auto const branch = branch_since(anchor, at.ticks_x, at.ticks_y, at.dx, at.dy, at.inverse2);
      slip = way_since(branch, at.arm, at.other_arm, turn, other_turn).slip;
    }
    auto const of_grains = Separate ? at.touching : at.touching || at.intact;
    auto const set = [&](RealField const& field, auto const& force, FloatLanes const& way, MaskOf<FloatLanes> const& carries) {
      float* const to = field.data<float>() + at.entry;
      FloatLanes const anew = select(carries, negative_multiply_add(force.stiffness, way, force.now), FloatLanes(Kept::none));
      store(to, select(where, anew, load(to)));
    };
    if constexpr (Shears) set(rows.shear, now.shear, slip, of_grains);
    if constexpr (Moments) set(rows.moment, now.moment, rotation, of_grains);
    if constexpr (Separate) {
      set(rows.bond_shear, now.bond_shear, slip, at.intact);
      set(rows.bond_moment, now.bond_moment, rotation, at.intact);
    }
  }
};

}  // namespace clathra
