#pragma once
/// How the walls move: held, driven at a strain rate, or steered to a stress (servo walls).
#include "kernels/walls.hpp"

namespace clathra {

/// Constants of the servo: a proportional part limited by the stiffness of the discs that touch the wall, and an integral part
/// that takes over the speed at which the wall must go on moving (a proportional servo alone keeps an error proportional to that
/// speed).
struct ServoLaw {
  Real gain = 0.8;  ///< alpha_s: share of the stress error that one step would remove against the wall's own contacts; from 2 on
                    ///< it is unstable
  Real integral_time = 1e-4;     ///< [s], far below the transit time of a compression wave (prepare_servo()); counts as
                                 ///< least_integral_steps steps where it is shorter
  Real contact_stiffness = 3e8;  ///< k_n of wall contacts

  static constexpr Real least_integral_steps = 4;  ///< gain (1 + 1/4) stays below 2, however few discs a wave has to pass
  /// What the integral gains in a step, as a share of the proportional part.
  KOKKOS_INLINE_FUNCTION Real integral_share(Real dt) const { return dt / lane_max(integral_time, least_integral_steps * dt); }
};

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

  /// Closing speed of either wall [m/s] for the next step.
  /// @param stress  of this step [Pa];  @param wall_length,span  of a wall, and between the two [m]
  KOKKOS_INLINE_FUNCTION Real closing_speed(ServoLaw const& servo, Real stress, Real wall_length, Real span, int contacts,
                                            Real dt) {
    if (kind == Kind::hold) return 0;
    if (kind == Kind::rate) return strain_rate * span * (one_sided ? 1.0 : 0.5);
    Real const error = target_stress - stress;
    Real const proportional = servo.gain * wall_length / (servo.contact_stiffness * (contacts > 4 ? contacts : 4) * dt);
    Real const wanted = integral + proportional * error;
    // The integral rests while the wall already moves at its cap in that direction.
    if ((wanted < largest_speed || error < 0) && (wanted > -largest_speed || error > 0)) {
      integral = capped(integral + proportional * error * servo.integral_share(dt));
    }
    return capped(integral + proportional * error);
  }

 private:
  KOKKOS_INLINE_FUNCTION Real capped(Real speed) const {
    return speed < -largest_speed ? -largest_speed : largest_speed < speed ? largest_speed : speed;
  }
};

struct Loading {
  AxisDrive x, y;
  ServoLaw servo;

  /// Sets the wall velocities for the next step from the stress and the reactions of this one.
  KOKKOS_INLINE_FUNCTION void steer(Walls& walls, WallStress const& stress, WallReactions const& reactions, Real dt) {
    int const contacts_x = (reactions.contacts[left] + reactions.contacts[right]) / 2;
    int const contacts_y = (reactions.contacts[bottom] + reactions.contacts[top]) / 2;
    Real const speed_x = x.closing_speed(servo, stress.x, walls.height(), walls.width(), contacts_x, dt);
    Real const speed_y = y.closing_speed(servo, stress.y, walls.width(), walls.height(), contacts_y, dt);
    walls.velocity[left] = x.one_sided ? 0 : speed_x;
    walls.velocity[right] = -speed_x;
    walls.velocity[bottom] = y.one_sided ? 0 : speed_y;
    walls.velocity[top] = -speed_y;
  }
};

}  // namespace clathra
