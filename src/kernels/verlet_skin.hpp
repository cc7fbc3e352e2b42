#pragma once
/// A Verlet skin for each disc: how far it may move beside the homogeneous motion of its box (its non-affine displacement) before
/// the neighbour rows are outdated.
#include "kernels/integrate.hpp"

namespace clathra {

/// Speed of a disc against the homogeneous motion [m/s].
KOKKOS_INLINE_FUNCTION Real wandering_speed(ParticleSoA const& p, AffineFrame const& frame, int i) {
  Real const vx = p.vx(i) - frame.velocity_x(p.x(i), p.y(i)), vy = p.vy(i) - frame.velocity_y(p.y(i));
  return lane_sqrt(vx * vx + vy * vy);
}

/// The skin of discs at rest, and the most that a flying one may get [m].
struct SkinRange {
  Real least, most;
  /// The skin of a disc that wanders at this speed, not below that of a slower one: h_i = min(h (1 + v_i / 5 v_mean), h_most).
  KOKKOS_INLINE_FUNCTION Real skin(Real speed, Real mean_speed) const {
    constexpr Real share = 0.2;  // of h, for a disc at the mean speed: rows grow by that much of the skin on the average
    return lane_min(least * (1 + share * speed / mean_speed), most);
  }
};

/// Resets the displacements of the owned discs: gives each its skin and remembers its present centre as that of a neighbour
/// search. The few discs that no contact holds fly far while all others hardly move, and would call for a search of all. Rows
/// that hold every pair nearer than h_i + h_j are complete until the non-affine displacement of some disc is its h_i. Does not
/// depend on the discs' order.
/// @param mean_speed  of all discs of all ranks (rebuild_inputs.hpp) [m/s]
void assign_verlet_skins(ParticleSoA const& particles, AffineFrame const& frame, SkinRange const& range, Real mean_speed);

/// The largest (d / skin)^2 of a group of owned discs since they were at (x, y), as below.
KOKKOS_FORCEINLINE_FUNCTION Real nonaffine_displacement2(ParticleSoA const& p, Field<Coord> const& x, Field<Coord> const& y,
                                                         AffineFrame const& frame, int group) {
  auto const i = static_cast<std::size_t>(group) * lane_count;
  Lanes const x_then = load(&x(i)), y_then = load(&y(i));
  Lanes const dx = load(&p.x(i)) - frame.mapped_x(x_then, y_then), dy = load(&p.y(i)) - frame.mapped_y(y_then);
  Lanes const skin = load(&p.verlet_skin(i));
  Lanes share2 = (dx * dx + dy * dy) / (skin * skin);
  for (auto l = p.owned - static_cast<int>(i); l < lane_count; ++l) set_lane(share2, l, 0);  // ghosts share the last group
  return largest(select(share2 > Lanes(0), share2, Lanes(0)));
}

/// Non-affine displacements since discs were at (x, y).
/// @param frame  the homogeneous motion since then
/// @return the largest (d / skin)^2 of this rank's discs, d the distance from where the homogeneous motion would have brought
/// one
Real largest_nonaffine_displacement2(ParticleSoA const& particles, Field<Coord> const& x, Field<Coord> const& y,
                                     AffineFrame const& frame);

}  // namespace clathra
