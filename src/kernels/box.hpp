#pragma once
/// The box of a specimen and its homogeneous motion.
#include "kernels/lane.hpp"

namespace clathra {

inline constexpr int wall_count = 4;
enum WallName : int { left = 0, right = 1, bottom = 2, top = 3 };

/// Where the walls stand and how they move: x of left and right, y of bottom and top. A wall that is absent stands at infinity.
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

/// A rectangular periodic cell. Its stretching is homogeneous: discs and images move with it.
struct PeriodicCell {
  Coord left = 0, bottom = 0;
  Real width = 0, height = 0;  ///< [m]; 0 = not periodic
  KOKKOS_INLINE_FUNCTION bool exists() const { return width > 0; }
};

/// Walls, or a periodic cell in their place.
struct Box {
  Walls walls;
  PeriodicCell cell;
  KOKKOS_INLINE_FUNCTION bool periodic() const { return cell.exists(); }
  KOKKOS_INLINE_FUNCTION Coord width() const { return periodic() ? cell.width : walls.width(); }
  KOKKOS_INLINE_FUNCTION Coord height() const { return periodic() ? cell.height : walls.height(); }
};

/// The homogeneous motion of the box. Neighbour lists may ignore it: x maps to centre + stretch (x_ref - reference_centre). Local
/// damping is taken against the motion relative to it, v_frame = gradient * (x - centre) + drift: against the absolute velocity
/// it would drag every disc of a specimen under compression the same way and hold up a share of the platens' stress that no
/// contact carries.
struct AffineFrame {
  Coord centre_x = 0, centre_y = 0;
  Coord reference_centre_x = 0, reference_centre_y = 0;
  Real stretch_x = 1, stretch_y = 1;
  Real gradient_x = 0, gradient_y = 0;  ///< d v_x / d x and d v_y / d y [1/s]
  Real drift_x = 0, drift_y = 0;        ///< velocity of the centre [m/s]

  /// Velocity of the homogeneous motion at a place [m/s].
  template <class L>
  KOKKOS_INLINE_FUNCTION L velocity_x(L const& x) const {
    return gradient_x * (x - centre_x) + drift_x;
  }
  template <class L>
  KOKKOS_INLINE_FUNCTION L velocity_y(L const& y) const {
    return gradient_y * (y - centre_y) + drift_y;
  }
};

/// The homogeneous motion since the box was another: that of the walls, or of the periodic cell.
KOKKOS_INLINE_FUNCTION AffineFrame frame_since(Box const& now, Box const& then) {
  AffineFrame f;
  if (now.periodic()) {
    f.centre_x = f.reference_centre_x = now.cell.left;
    f.centre_y = f.reference_centre_y = now.cell.bottom;
    f.stretch_x = now.cell.width / then.cell.width;
    f.stretch_y = now.cell.height / then.cell.height;
    return f;
  }
  Walls const &walls = now.walls, &before = then.walls;
  f.centre_x = walls.middle(left, right);
  f.centre_y = walls.middle(bottom, top);
  f.reference_centre_x = before.middle(left, right);
  f.reference_centre_y = before.middle(bottom, top);
  f.stretch_x = walls.width() / before.width();
  f.stretch_y = walls.height() / before.height();
  f.gradient_x = (walls.velocity[right] - walls.velocity[left]) / walls.width();
  f.gradient_y = (walls.velocity[top] - walls.velocity[bottom]) / walls.height();
  f.drift_x = walls.mean_velocity(left, right);
  f.drift_y = walls.mean_velocity(bottom, top);
  return f;
}

}  // namespace clathra
