#pragma once
/// How a pair has moved since its anchor: what the histories of mixed precision are made of.
///
/// A sum of a step's parts in single precision stands still where they fall below half its ulp, at an inertial number of 1e-5,
/// and wanders where they do not. So in mixed precision shear forces and moments are no sums. A contact keeps its anchor, the
/// branch that it had when it was anchored (to 4096 ticks, which is near enough), and for each history the force there:
///   F = F_0 + k s,   s = d alpha - a_i phi_i - a_j phi_j,   M = M_0 + k_m (phi_j - phi_i),
/// with the angle alpha that the branch has turned by and the angles phi that the discs have. As long as nothing slips, F_0 stays
/// as it is to the bit and F is a function of where the discs are, however many steps they have taken; what slips sets F_0 anew.
/// A pair is anchored anew where it begins to touch, and when its branch or a disc has turned by 1/64 since (`furthest_turn`);
/// discs then count their angle from zero. Each pair and each disc tells by its own numbers, so bits do not depend on when
/// neighbours are searched for.
#include "kernels/int_lanes.hpp"

namespace clathra {

/// By how much a branch [1] or a disc [rad] may have turned since the anchor.
inline constexpr float furthest_turn = 0x1p-6F;
template <class L>
KOKKOS_FORCEINLINE_FUNCTION auto has_turned_far(L const& turn) {
  return turn * turn > L(furthest_turn * furthest_turn);
}
/// The angle that a disc counts on from once its pairs have been anchored anew.
template <class L>
KOKKOS_FORCEINLINE_FUNCTION L counted_on(L const& turn) {
  return select(has_turned_far(turn), L(0), turn);
}

/// An anchor: both components of a branch in units of 2^16 ticks, each in 16 bits.
/// @param dx,dy  branch in ticks, rounded; below 2^31. Odd, so that both sides get opposite anchors
template <class L>
KOKKOS_FORCEINLINE_FUNCTION auto anchor_at(L const& dx, L const& dy) {
  constexpr float per_tick = 0x1p-16F;
  return shifted_up(rounded(dy * L(per_tick)), 16) | (rounded(dx * L(per_tick)) & 0xffff);
}
/// Back in ticks.
template <class Ints>
KOKKOS_FORCEINLINE_FUNCTION Ints anchor_x(Ints const& anchor) {
  return shifted_up(anchor, 16);
}
template <class Ints>
KOKKOS_FORCEINLINE_FUNCTION Ints anchor_y(Ints const& anchor) {
  return anchor & ~0xffff;
}

template <class L>
struct WaySinceAnchor {
  L slip;      ///< s [m], equal on both sides
  L rotation;  ///< phi_j - phi_i [rad], opposite on the two sides
  L turned2;   ///< sin^2 alpha
};

/// @param ticks_x,ticks_y,dx,dy  branch in ticks, as it is and rounded;  @param inverse2  1 / distance^2 in ticks
/// @param arm,other_arm  lever arms [m], and the angles phi of the discs [rad]
/// With B, the way of the branch D since the anchor, D x B / d = d_0 sin alpha exactly and D . B / d = d - d_0 + d sin^2 alpha
/// / 2. d and the arms count with their means between anchor and now, as for a straight way; alpha is sin alpha + sin^3 alpha /
/// 6, which leaves 1e-10.
template <class L, class Ints>
KOKKOS_FORCEINLINE_FUNCTION WaySinceAnchor<L> way_since(Ints const& anchor, Ints const& ticks_x, Ints const& ticks_y, L const& dx,
                                                        L const& dy, L const& inverse2, L const& arm, L const& other_arm,
                                                        L const& turn, L const& other_turn) {
  L const bx = to_float(difference(ticks_x, anchor_x(anchor))), by = to_float(difference(ticks_y, anchor_y(anchor)));
  L const sine = minus_times(bx, dy, by * dx) * inverse2, sine2 = sine * sine, along = times_plus(bx, dx, by * dy) * inverse2;
  L const longer = minus_times(L(0.5F), sine2, along);  // (d - d_0) / d
  L const share = times_plus(L(0.5F), along, minus_times(L(1.0F / 12), sine2, L(1)));
  // Both sides of a pair get the same bits: a fused product must not be that of one disc. A quarter is exact.
  L const rolled = turn * arm + other_turn * other_arm, quarter = times_plus(L(0.25F), other_turn, L(0.25F) * turn);
  return {times_plus(times_plus(quarter, longer, sine * share), arm + other_arm, -rolled), other_turn - turn, sine2};
}

}  // namespace clathra
