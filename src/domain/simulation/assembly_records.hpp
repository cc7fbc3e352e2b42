#pragma once
/// Taking an assembly apart for a checkpoint, and putting it together again.
#include <string>

#include "domain/simulation/assembly.hpp"
#include "domain/simulation/simulation_state.hpp"

namespace clathra {

template <class Visit>
void visit_numbers(std::string const& name, AxisDrive& drive, Visit&& visit) {
  visit(name + "_kind", drive.kind);
  visit(name + "_strain_rate", drive.strain_rate);
  visit(name + "_target_stress", drive.target_stress);
  visit(name + "_one_sided", drive.one_sided);
  visit(name + "_integral", drive.integral);
  visit(name + "_largest_speed", drive.largest_speed);
  visit(name + "_held_area", drive.held_area);
  visit(name + "_fluid_stiffness", drive.fluid_stiffness);
  visit(name + "_held_stress", drive.held_stress);
  visit(name + "_slow_stress", drive.slow_stress);
  visit(name + "_filter_time", drive.filter_time);
}

template <class Visit>
void visit_numbers(std::string const& name, MovingWalls& walls, Visit&& visit) {
  constexpr char const* names[] = {"left", "right", "bottom", "top"};
  for (int wall = 0; wall < wall_count; ++wall) {
    std::string const one = name + "_" + names[wall];
    visit(one, walls.place.position[wall]);
    visit(one + "_velocity", walls.place.velocity[wall]);
    visit(one + "_force", walls.reactions.normal[wall]);
    visit(one + "_shear", walls.reactions.shear[wall]);
    visit(one + "_contacts", walls.reactions.contacts[wall]);
  }
  visit(name + "_work", walls.work);
  visit(name + "_largest_deviator", walls.largest.q);
  visit(name + "_largest_deviator_height", walls.largest.height);
  visit_numbers("drive_x", walls.loading.x, visit);
  visit_numbers("drive_y", walls.loading.y, visit);
  ServoLaw& servo = walls.loading.servo;
  visit("servo_gain", servo.gain);
  visit("servo_integral_time", servo.integral_time);
  visit("servo_contact_stiffness", servo.contact_stiffness);
}

/// Of a reference state: how it moved then does not matter any more.
template <class Visit>
void visit_numbers(std::string const& name, Box& box, Visit&& visit) {
  visit(name + "_x", box.x);
  visit(name + "_y", box.y);
  visit(name + "_xx", box.edges.xx);
  visit(name + "_xy", box.edges.xy);
  visit(name + "_yy", box.edges.yy);
}

/// Visits the numbers of an assembly between walls that are the same on all ranks: (name, double, integer, bool or enumeration).
template <class Visit>
void for_each_number(Assembly& a, Visit&& visit) {
  StepState& now = a.now;
  visit("step", now.step);
  visit("time", now.time);
  visit("ledger", a.laws.contact.ledger);
  visit_numbers("wall", now.walls, visit);
  visit_numbers("at_search", now.at_search.box, visit);
  visit_numbers("at_update", now.at_update.box, visit);
  a.facts.for_each_number(visit);
  a.upkeep.for_each_number(visit);
  visit("keeps_break_events", a.broken.keeps_events);
  visit("break_details_from_height", a.broken.details_from_height);
}

/// This rank's discs with their rows, and the breaks that it has seen, into a state.
/// @param beside  what goes with the discs besides what the assembly holds
void pack_assembly(Assembly& a, AuxiliaryFields const& beside, SimulationState& state);

/// Fills an assembly that has its numbers and laws with its discs, on any number of ranks.
/// @param state  loses its discs and events;  @param beside  as in pack_assembly(), made as long as there are discs
/// @throws std::runtime_error where its discs have other numbers than the laws ask for
void unpack_assembly(Assembly& a, AuxiliaryFields const& beside, SimulationState& state);

}  // namespace clathra
