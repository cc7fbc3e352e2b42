#pragma once
/// How a pair has moved since its reference configuration: what the histories of mixed precision are made of.
///
/// A sum of a step's parts in single precision stands still where they fall below half its ulp, at an inertial number of 1e-5,
/// and wanders where they do not. So in mixed precision shear forces and moments are no sums. A contact keeps its reference, the
/// branch that it had when it was last re-referenced (to 4096 ticks, which is near enough), and for each history the force there:
///   F = F_0 + k s,   s = d alpha - a_i phi_i - a_j phi_j,   M = M_0 + k_m (phi_j - phi_i),
/// with the angle alpha that the branch has turned by and the angles phi that the discs have. As long as nothing slips, F_0 stays
/// as it is to the bit and F is a function of where the discs are, however many steps they have taken; what slips gives another
/// F_0. A pair is re-referenced where it begins to touch, and when its branch or a disc has turned by 1/64 since
/// (`largest_rotation`); discs then count their angle from zero. Each pair and each disc tells by its own numbers, so bits do not
/// depend on when neighbours are searched for.
#include "kernels/int_lanes.hpp"

namespace clathra {

/// By how much a branch [1] or a disc [rad] may have rotated since the reference.
inline constexpr float largest_rotation = 0x1p-6F;
template <class L>
KOKKOS_FORCEINLINE_FUNCTION auto has_rotated_far(L const& rotation) {
  return rotation * rotation > L(largest_rotation * largest_rotation);
}
/// The angle that a disc counts on from once its pairs have been re-referenced.
template <class L>
KOKKOS_FORCEINLINE_FUNCTION L rotation_from_now_on(L const& rotation) {
  return select(has_rotated_far(rotation), L(0), rotation);
}

/// A branch as a reference keeps it: both components in units of 2^16 ticks, each in 16 bits.
/// @param dx,dy  branch in ticks, rounded; below 2^31. Odd, so that both sides get opposite ones
template <class L>
KOKKOS_FORCEINLINE_FUNCTION auto packed_branch(L const& dx, L const& dy) {
  constexpr float per_tick = 0x1p-16F;
  return shifted_up(rounded(dy * L(per_tick)), 16) | (rounded(dx * L(per_tick)) & 0xffff);
}
/// Back in ticks.
template <class Ints>
KOKKOS_FORCEINLINE_FUNCTION Ints unpacked_x(Ints const& reference) {
  return shifted_up(reference, 16);
}
template <class Ints>
KOKKOS_FORCEINLINE_FUNCTION Ints unpacked_y(Ints const& reference) {
  return reference & ~0xffff;
}

/// How a branch has moved since its reference.
template <class L>
struct BranchSinceReference {
  L sine;   ///< d_0 / d sin alpha
  L sine2;  ///< its square
  L along;  ///< the part of the way along the branch, over d
};
/// @param ticks_x,ticks_y,dx,dy  branch in ticks, as it is and rounded;  @param inverse2  1 / distance^2 in ticks
/// With B, by which the branch D has moved since the reference, D x B / d = d_0 sin alpha and D . B / d = d - d_0 cos alpha
/// exactly.
template <class L, class Ints>
KOKKOS_FORCEINLINE_FUNCTION BranchSinceReference<L> branch_since(Ints const& reference, Ints const& ticks_x, Ints const& ticks_y,
                                                                 L const& dx, L const& dy, L const& inverse2) {
  L const bx = to_float(difference(ticks_x, unpacked_x(reference))), by = to_float(difference(ticks_y, unpacked_y(reference)));
  L const sine = negative_multiply_add(bx, dy, by * dx) * inverse2;
  return {sine, sine * sine, multiply_add(bx, dx, by * dy) * inverse2};
}

template <class L>
struct MotionSinceReference {
  L slip;      ///< s [m], equal on both sides
  L rotation;  ///< phi_j - phi_i [rad], opposite on the two sides
};
/// @param arm,other_arm  lever arms [m], and the angles phi of the discs [rad]
/// d and the arms count with their means between reference and now, as for a straight way; alpha is sin alpha + sin^3 alpha / 6,
/// which leaves 1e-10.
template <class L>
KOKKOS_FORCEINLINE_FUNCTION MotionSinceReference<L> motion_since(BranchSinceReference<L> const& branch, L const& arm,
                                                                 L const& other_arm, L const& rotation, L const& other_rotation) {
  L const share = multiply_add(L(0.5F), branch.along, negative_multiply_add(L(1.0F / 12), branch.sine2, L(1)));
  L const longer = negative_multiply_add(L(0.5F), branch.sine2, branch.along);  // (d - d_0) / d
  // Both sides of a pair get the same bits: a fused product must not be that of one disc. A quarter is exact.
  L const rolled = rotation * arm + other_rotation * other_arm,
          quarter = multiply_add(L(0.25F), other_rotation, L(0.25F) * rotation);
  return {multiply_add(multiply_add(quarter, longer, branch.sine * share), arm + other_arm, -rolled), other_rotation - rotation};
}

/// The overlap [m] of a pair that has a reference. A distance of 2^28 ticks is known to 16 of them in single precision, and a
/// pair at rest would tremble by as many. What its square is short of, e = d_0^2 + B . (2 D - B) - d^2, tells single ticks apart:
/// only d_0^2 is rounded, and that once for all steps.
/// @param distance  in ticks;  @param inverse2  1 / distance^2;  @param reach,tick  [m]
/// @param none  pairs without a reference
template <class L, class Ints>
KOKKOS_FORCEINLINE_FUNCTION L overlap_since(Ints const& reference, BranchSinceReference<L> const& branch, L const& distance,
                                            L const& inverse2, L const& reach, float tick, MaskOf<L> const& none) {
  L const first2 = to_float(squares_of_halves(reference)) * L(0x1p32F),
          square = negative_multiply_add(branch.along, branch.along, branch.along + branch.along) - branch.sine2;
  L const lacking = select(none, L(0), multiply_add(negative_multiply_add(distance, distance, first2), inverse2, square));
  return negative_multiply_add(distance * L(0.5F * tick), lacking, negative_multiply_add(distance, L(tick), reach));
}

}  // namespace clathra
