#include "domain/simulation/rigid_walls.hpp"

namespace clathra {

BoundaryHistory RigidWalls::history_of_discs(ParticleSoA const& particles, Scratch& scratch) const {
  if (!contacts_.rough) return {};
  WallShear const shear = wall_shear_of_discs(particles, contacts_, scratch);
  return {{"shear_left", shear.of[left]},
          {"shear_right", shear.of[right]},
          {"shear_bottom", shear.of[bottom]},
          {"shear_top", shear.of[top]}};
}

void RigidWalls::list_near(ParticleSoA const& particles, StepState const& now, Field<std::int64_t> const& number,
                           Scratch& scratch) {
  near_ = list_near_walls(particles, now.walls.place, number, scratch);
}

void RigidWalls::make_contacts(int size, SimulationLaws const& laws, BoundaryHistory const& history, Scratch& scratch) {
  WallShear shear;
  for (std::size_t wall = 0; wall < history.size(); ++wall) shear.of[wall] = history[wall].second;
  contacts_ = make_wall_contacts(near_, size, laws.wall.friction > 0, shear, scratch);
  near_ = {};
}

void RigidWalls::enqueue_forces(StepForces const& by) const {
  add_wall_forces(by.particles, contacts_, by.laws.wall, by.dt, by.losses, by.faults, by.unit, by.steps, by.ends_step,
                  by.launches);
}

void RigidWalls::read_reactions(StepState& now, DeviceSteps const& steps, Summation const& sums) const {
  now.walls.reactions = wall_reactions(steps, sums);
}

void RigidWalls::end_step(StepState& now, DeviceSteps const& steps, Summation const& sums) const {
  now.walls.after_forces(wall_reactions(steps, sums), now.orders.dt);
}

}  // namespace clathra
