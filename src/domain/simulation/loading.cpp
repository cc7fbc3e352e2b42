#include "domain/simulation/loading.hpp"

#include <algorithm>

namespace clathra {

WallStress wall_stress(Walls const& walls, WallReactions const& reactions) {
  return {0.5 * (reactions.normal[left] + reactions.normal[right]) / walls.height(),
          0.5 * (reactions.normal[bottom] + reactions.normal[top]) / walls.width()};
}

namespace {

/// Closing speed of either wall of a pair [m/s] for the next step.
Real closing_speed(AxisDrive& drive, ServoLaw const& servo, Real stress, Real wall_length, Real span, int contacts, Real dt) {
  switch (drive.kind) {
    case AxisDrive::Kind::hold:
      return 0;
    case AxisDrive::Kind::rate:
      return drive.strain_rate * span * (drive.one_sided ? 1.0 : 0.5);
    case AxisDrive::Kind::stress:
      break;
  }
  Real const error = drive.target_stress - stress;
  Real const proportional = servo.gain * wall_length / (servo.contact_stiffness * std::max(contacts, 4) * dt);
  Real const cap = drive.largest_speed;
  Real const wanted = drive.integral + proportional * error;
  // The integral rests while the wall already moves at its cap in that direction.
  if ((wanted < cap || error < 0) && (wanted > -cap || error > 0)) {
    drive.integral = std::clamp(drive.integral + proportional * error * dt / servo.integral_time, -cap, cap);
  }
  return std::clamp(drive.integral + proportional * error, -cap, cap);
}

}  // namespace

void Loading::move(Walls& walls, Real dt) const {
  for (int wall = 0; wall < wall_count; ++wall) walls.position[wall] += walls.velocity[wall] * dt;
}

void Loading::steer(Walls& walls, WallReactions const& reactions, Real dt) {
  WallStress const stress = wall_stress(walls, reactions);
  int const contacts_x = (reactions.contacts[left] + reactions.contacts[right]) / 2;
  int const contacts_y = (reactions.contacts[bottom] + reactions.contacts[top]) / 2;
  Real const speed_x = closing_speed(x, servo, stress.x, walls.height(), walls.width(), contacts_x, dt);
  Real const speed_y = closing_speed(y, servo, stress.y, walls.width(), walls.height(), contacts_y, dt);
  walls.velocity[left] = x.one_sided ? 0 : speed_x;
  walls.velocity[right] = -speed_x;
  walls.velocity[bottom] = y.one_sided ? 0 : speed_y;
  walls.velocity[top] = -speed_y;
}

}  // namespace clathra
