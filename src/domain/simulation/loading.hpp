#pragma once
/// How the walls move: held, driven at a strain rate, or steered to a stress (servo walls).
#include "kernels/walls.hpp"

namespace clathra {

/// One pair of opposite walls. Closing (compression) is positive.
struct AxisDrive {
  enum class Kind { hold, rate, stress };
  Kind kind = Kind::hold;
  Real strain_rate = 0;    ///< `rate`: natural strain rate [1/s], compression positive
  Real target_stress = 0;  ///< `stress` [Pa]
  bool one_sided = false;  ///< only the right or top wall moves
  Real integral = 0;       ///< servo state: closing speed of either wall [m/s] that has held the stress so far
  Real largest_speed = 1;  ///< cap on |closing speed| of either wall [m/s]

  static AxisDrive held() { return {}; }
  static AxisDrive at_rate(Real rate, bool one_sided = false) { return {Kind::rate, rate, 0, one_sided}; }
  static AxisDrive at_stress(Real stress, Real largest_speed) { return {Kind::stress, 0, stress, false, 0, largest_speed}; }
};

/// Constants of the servo: a proportional part limited by the stiffness of the discs that touch the wall, and an integral part
/// that takes over the speed at which the wall must go on moving (a proportional servo alone keeps an error proportional to that
/// speed).
struct ServoLaw {
  Real gain =
      0.4;  ///< alpha_s: share of the stress error that one step would remove against the wall's own contacts; < 1 is stable
  Real integral_time = 1e-4;  ///< [s]; a quarter of the transit time of a compression wave: with 0.1 and a whole transit 15 % of
                              ///< the records of a softening 2,000-disc specimen left 1 % of sigma_3, with these none
  Real contact_stiffness = 3e8;  ///< k_n of wall contacts
};

/// Mean wall stresses [Pa]: sigma_x from left and right over the height, sigma_y from bottom and top over the width.
struct WallStress {
  Real x = 0, y = 0;
};
WallStress wall_stress(Walls const& walls, WallReactions const& reactions);

class Loading {
 public:
  AxisDrive x, y;
  ServoLaw servo;

  /// Moves the walls by their velocities over one step of length dt [s].
  void move(Walls& walls, Real dt) const;
  /// Sets the wall velocities for the next step from the reactions of this one.
  void steer(Walls& walls, WallReactions const& reactions, Real dt);
};

}  // namespace clathra
