#pragma once
/// Four rigid walls: where they stand, how they move, what they feel.
#include "kernels/box.hpp"

namespace clathra {

inline constexpr int wall_count = 4;
enum WallName : int { left = 0, right = 1, bottom = 2, top = 3 };

/// x of left and right, y of bottom and top. A wall that is absent stands at infinity.
struct Walls {
  Coord position[wall_count] = {-1e9, 1e9, -1e9, 1e9};  ///< [m]
  Real velocity[wall_count] = {0, 0, 0, 0};             ///< [m/s]
  KOKKOS_INLINE_FUNCTION Coord width() const { return position[right] - position[left]; }
  KOKKOS_INLINE_FUNCTION Coord height() const { return position[top] - position[bottom]; }
  KOKKOS_INLINE_FUNCTION Coord middle(WallName a, WallName b) const { return 0.5 * (position[a] + position[b]); }
  KOKKOS_INLINE_FUNCTION Real mean_velocity(WallName a, WallName b) const { return 0.5 * (velocity[a] + velocity[b]); }
  /// The larger speed of two walls [m/s], >= 0.
  KOKKOS_INLINE_FUNCTION Real largest_speed(WallName a, WallName b) const {
    return lane_max(lane_abs(velocity[a]), lane_abs(velocity[b]));
  }
  /// Moves them by their velocities over one step of length dt [s].
  KOKKOS_INLINE_FUNCTION void move(Real dt) {
    for (int wall = 0; wall < wall_count; ++wall) position[wall] += velocity[wall] * dt;
  }
};

KOKKOS_INLINE_FUNCTION Box box_within(Walls const& walls) {
  Box box;
  box.x = walls.middle(left, right);
  box.y = walls.middle(bottom, top);
  box.edges = {walls.width(), 0, walls.height()};
  box.rate = {(walls.velocity[right] - walls.velocity[left]) / walls.width(), 0,
              (walls.velocity[top] - walls.velocity[bottom]) / walls.height()};
  box.drift_x = walls.mean_velocity(left, right);
  box.drift_y = walls.mean_velocity(bottom, top);
  box.largest_speed = walls.largest_speed(left, right) + walls.largest_speed(bottom, top);
  return box;
}

/// A wall as a disc meets it. L is a lane type.
template <class L>
struct WallFace {
  Real nx, ny;  ///< from the disc into the wall
  L distance;   ///< of the disc's centre [m], negative behind the wall
  Real vx, vy;  ///< of the wall [m/s]
};
template <class L>
KOKKOS_FORCEINLINE_FUNCTION WallFace<L> wall_face(Walls const& walls, int wall, L const& x, L const& y) {
  bool const upright = wall == left || wall == right, ahead = wall == right || wall == top;
  Real const outward = ahead ? 1 : -1, speed = walls.velocity[wall];
  L const& at = upright ? x : y;
  Coord const position = walls.position[wall];
  return {upright ? outward : 0, upright ? 0 : outward, ahead ? position - at : at - position, upright ? speed : 0,
          upright ? 0 : speed};
}

/// What the walls feel, summed without regard to order (fixed point).
struct WallReactions {
  Real normal[wall_count] = {0, 0, 0, 0};  ///< force pressing the wall outward [N/m], >= 0
  Real shear[wall_count] = {0, 0, 0, 0};   ///< along +y on left/right, along +x on bottom/top [N/m]
  int contacts[wall_count] = {0, 0, 0, 0};
};

/// Mean wall stresses [Pa]: sigma_x from left and right over the height, sigma_y from bottom and top over the width.
struct WallStress {
  Real x = 0, y = 0;
};
KOKKOS_INLINE_FUNCTION WallStress wall_stress(Walls const& walls, WallReactions const& reactions) {
  return {0.5 * (reactions.normal[left] + reactions.normal[right]) / walls.height(),
          0.5 * (reactions.normal[bottom] + reactions.normal[top]) / walls.width()};
}

}  // namespace clathra
