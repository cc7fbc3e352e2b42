#pragma once
/// How the walls move: held, driven at a strain rate, steered to a stress (servo walls), or following the other pair.
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
  enum class Kind { hold, rate, stress, constant_area, constant_mean_stress, soft_fluid };
  Kind kind = Kind::hold;
  Real strain_rate = 0;      ///< `rate`: natural strain rate [1/s], compression positive
  Real target_stress = 0;    ///< `stress`, and what `constant_mean_stress` comes to now [Pa]
  bool one_sided = false;    ///< only the right or top wall moves
  Real integral = 0;         ///< servo state: closing speed of either wall [m/s] that has held the stress so far
  Real largest_speed = 1;    ///< cap on |closing speed| of either wall [m/s]
  Real held_area = 0;        ///< `constant_area` and `soft_fluid`, of the box [m^2]
  Real fluid_stiffness = 0;  ///< of the fluid that keeps it, K_w over the porosity [Pa]; 0 = infinite
  Real held_stress = 0;      ///< `constant_mean_stress`: p; with a fluid the stress on this pair where its pressure is 0 [Pa]
  Real slow_stress = 0;      ///< on the other pair, with a fluid on this one, without what is faster than filter_time [Pa]
  Real filter_time = 0;      ///< [s]

  static AxisDrive held() { return {}; }
  static AxisDrive at_rate(Real rate, bool one_sided = false) { return {Kind::rate, rate, 0, one_sided}; }
  static AxisDrive at_stress(Real stress, Real largest_speed) { return {Kind::stress, 0, stress, false, 0, largest_speed}; }
  /// Width times height stays `area` [m^2] to rounding.
  static AxisDrive at_constant_area(Real area) {
    AxisDrive drive;
    drive.kind = Kind::constant_area;
    drive.held_area = area;
    return drive;
  }
  /// Width times height is what a fluid of a stiffness leaves of `area`, whose pressure is what the stress on this pair has lost.
  /// @param stiffness  K_w over the porosity [Pa];  @param own  the stress on this pair now [Pa];  @param filter_time  as below
  static AxisDrive at_area_of_fluid(Real area, Real stiffness, Real own, Real filter_time) {
    AxisDrive drive = at_constant_area(area);
    drive.fluid_stiffness = stiffness;
    drive.held_stress = drive.slow_stress = own;
    drive.filter_time = filter_time;
    return drive;
  }
  /// The same for a fluid that is softer than the specimen: the walls are steered to the stress that it leaves.
  static AxisDrive at_stress_of_fluid(Real area, Real stiffness, Real own, Real largest_speed) {
    AxisDrive drive = at_stress(own, largest_speed);
    drive.kind = Kind::soft_fluid;
    drive.held_area = area;
    drive.fluid_stiffness = stiffness;
    drive.held_stress = own;
    return drive;
  }
  /// (sigma_1 + sigma_3) / 2 stays `mean` [Pa]. @param other  the stress on the other pair now [Pa];  @param filter_time  of its
  /// low-pass filter [s], for a pair of walls cannot answer faster than a wave goes through the specimen
  static AxisDrive at_constant_mean(Real mean, Real other, Real filter_time, Real largest_speed) {
    AxisDrive drive = at_stress(2 * mean - other, largest_speed);
    drive.kind = Kind::constant_mean_stress;
    drive.held_stress = mean;
    drive.slow_stress = other;
    drive.filter_time = filter_time;
    return drive;
  }
  KOKKOS_INLINE_FUNCTION bool follows_area() const { return kind == Kind::constant_area; }

  /// Closing speed of either wall [m/s] for the next step.
  /// @param stress  of this step [Pa];  @param wall_length,span  of a wall, and between the two [m]
  KOKKOS_INLINE_FUNCTION Real closing_speed(ServoLaw const& servo, Real stress, Real wall_length, Real span, int contacts,
                                            Real dt) {
    if (kind == Kind::hold) return 0;
    if (kind == Kind::rate) return strain_rate * span * (one_sided ? 1.0 : 0.5);
    if (kind == Kind::constant_area) return 0;  // Loading::steer() knows the other pair
    Real const error = target_stress - stress;
    Real const proportional = servo.gain * wall_length / (servo.contact_stiffness * (contacts > 4 ? contacts : 4) * dt);
    Real const wanted = integral + proportional * error;
    // The integral rests while the wall already moves at its cap in that direction.
    if ((wanted < largest_speed || error < 0) && (wanted > -largest_speed || error > 0)) {
      integral = capped(integral + proportional * error * servo.integral_share(dt));
    }
    return capped(integral + proportional * error);
  }

  /// What the walls feel decides what this pair is steered to, or which area is left to a fluid.
  KOKKOS_INLINE_FUNCTION void follow(Real own, Real on_other, Real area, Real dt) {
    if (kind == Kind::soft_fluid) {
      target_stress = lane_max(Real(0), held_stress - fluid_stiffness * (1 - area / held_area));
      return;
    }
    bool const keeps_mean = kind == Kind::constant_mean_stress;
    if (!keeps_mean && fluid_stiffness == 0) return;
    slow_stress += ((keeps_mean ? on_other : own) - slow_stress) * lane_min(Real(1), dt / filter_time);
    if (keeps_mean) target_stress = 2 * held_stress - slow_stress;
  }
  /// `constant_area`: a fluid under u = held_stress - slow_stress is smaller by u / fluid_stiffness.
  KOKKOS_INLINE_FUNCTION Real wanted_area() const {
    return fluid_stiffness == 0 ? held_area : held_area * (1 - (held_stress - slow_stress) / fluid_stiffness);
  }

 private:
  KOKKOS_INLINE_FUNCTION Real capped(Real speed) const {
    return speed < -largest_speed ? -largest_speed : largest_speed < speed ? largest_speed : speed;
  }
};

struct Loading {
  AxisDrive x, y;  ///< one of them at most follows the other
  ServoLaw servo;

  /// Sets the wall velocities for the next step from the stress and the reactions of this one.
  KOKKOS_INLINE_FUNCTION void steer(Walls& walls, WallStress const& stress, WallReactions const& reactions, Real dt) {
    int const contacts_x = (reactions.contacts[left] + reactions.contacts[right]) / 2;
    int const contacts_y = (reactions.contacts[bottom] + reactions.contacts[top]) / 2;
    Real const area = walls.width() * walls.height();
    x.follow(stress.x, stress.y, area, dt);
    y.follow(stress.y, stress.x, area, dt);
    Real const speed_x = x.closing_speed(servo, stress.x, walls.height(), walls.width(), contacts_x, dt);
    Real const speed_y = y.closing_speed(servo, stress.y, walls.width(), walls.height(), contacts_y, dt);
    walls.velocity[left] = x.one_sided ? 0 : speed_x;
    walls.velocity[right] = -speed_x;
    walls.velocity[bottom] = y.one_sided ? 0 : speed_y;
    walls.velocity[top] = -speed_y;
    if (x.follows_area()) keep_area(walls, left, right, x.wanted_area(), dt);
    if (y.follows_area()) keep_area(walls, bottom, top, y.wanted_area(), dt);
  }

  /// Lets two walls move such that the box has an area after the next step, whatever the other two do in it.
  KOKKOS_INLINE_FUNCTION static void keep_area(Walls& walls, WallName low, WallName high, Real area, Real dt) {
    bool const lateral = low == left;
    WallName const other_low = lateral ? bottom : left, other_high = lateral ? top : right;
    Real const span = walls.position[high] - walls.position[low],
               other = walls.position[other_high] - walls.position[other_low] +
                       (walls.velocity[other_high] - walls.velocity[other_low]) * dt;
    walls.velocity[low] = 0.5 * (span - area / other) / dt;
    walls.velocity[high] = -walls.velocity[low];
  }
};

}  // namespace clathra
