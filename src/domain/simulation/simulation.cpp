#include "domain/simulation/simulation.hpp"

#include <type_traits>
#include <utility>

#include "domain/simulation/assembly_records.hpp"
#include "domain/simulation/neighbour_search.hpp"
#include "domain/simulation/specimen_transfer.hpp"
#include "kernels/history_forces.hpp"
#include "kernels/hydrate_change.hpp"

namespace clathra {

namespace {

/// Visits the numbers that a checkpoint keeps.
template <class Visit>
void for_each_kept_number(Assembly& assembly, TimeStepControl& time_steps, Real& time_step, Visit&& visit) {
  for_each_number(assembly, visit);
  time_steps.for_each_number(visit);
  visit("time_step", time_step);
}

/// Where the last update of the time step found the discs.
AuxiliaryFields places_at_update(TimeStepControl& time_steps) {
  UpdatePlaces& places = time_steps.places();
  if (!time_steps.follows()) return {};
  return {{"x_at_update", &places.x}, {"y_at_update", &places.y}};
}

}  // namespace

Simulation::Simulation(Specimen const& specimen, SimulationLaws const& laws, Real skin, Ranks among)
    : assembly_(laws, skin, std::move(among), specimen.periodic) {
  take_over(assembly_, specimen);
  evaluate_forces();
}

Simulation::Simulation(SimulationState state, SimulationLaws const& laws, Ranks among)
    : assembly_(laws, 0, std::move(among), /*periodic=*/false) {
  for_each_kept_number(assembly_, time_steps_, time_step, [&](std::string const& name, auto& value) {
    value = static_cast<std::decay_t<decltype(value)>>(state.numbers.at(name));
  });
  time_steps_.go_on_with(laws);
  unpack_assembly(assembly_, places_at_update(time_steps_), state);
}

SimulationState Simulation::state() {
  if (assembly_.periodic()) throw std::logic_error("a periodic cell has no checkpoint");
  // Rows as the next step would find them.
  if (assembly_.upkeep.is_asked()) rebuild(rebuild_inputs_of_all(assembly_), force_fields(assembly_));
  SimulationState s;
  for_each_kept_number(assembly_, time_steps_, time_step,
                       [&](std::string const& name, auto const& value) { s.numbers[name] = static_cast<double>(value); });
  pack_assembly(assembly_, places_at_update(time_steps_), s);
  return s;
}

Specimen Simulation::specimen() const { return specimen_of(assembly_); }

std::size_t Simulation::bytes() const {
  UpdatePlaces const& places = time_steps_.places();
  return assembly_.bytes() + (places.x.span() + places.y.span()) * sizeof(Coord);
}

void Simulation::set_laws(SimulationLaws const& laws) {
  Assembly& a = assembly_;
  bool const ledger = a.laws.contact.ledger;
  if (laws.precision != a.laws.precision) throw std::invalid_argument("a simulation keeps its precision");
  graph_.drop();
  ContactLaws const before = a.laws.contact;
  a.laws = laws;
  a.laws.contact.ledger = ledger;
  ContactLaws const& now = a.laws.contact;
  ContactFeatures const features = a.laws.features_of_rows();
  bool const same_history = features == a.rows.features, re_references = !same_history || !same_stiffness(before, now);
  if (re_references) a.rows = with_forces(a.particles, a.rows, before);
  if (!same_history) change_features(a.rows, features);
  if (!same_history || a.rows.features.bonds) prepare_rows(a.particles, a.rows, now.bond);
  if (re_references)
    re_reference_rows(a.particles, a.rows, now);
  else if (before.grain.shape_factor != now.grain.shape_factor)
    keep_moments(a.particles, a.rows, before, now);
  if (ledger) allocate_dissipation(a.dissipation, a.laws.losses(), a.particles.x.extent(0));
  time_steps_.after_laws(a.laws);
}

void Simulation::form_bonds(Specimen const& bonded, SimulationLaws const& laws) {
  set_laws(laws);
  take_bonds(assembly_, bonded);
  time_steps_.after_search();
  time_steps_.ask();
  evaluate_forces();
}

void Simulation::change_hydrate(BondLaw const& next) {
  Assembly& a = assembly_;
  if (!a.rows.features.bonds) throw std::invalid_argument("there are no bonds whose hydrate could change");
  graph_.drop();
  upload_state(/*host_synchronous=*/true);  // the log of breaks reads the box
  a.rows = with_forces(a.particles, a.rows, a.laws.contact);
  change_bonds(a.particles, a.rows, a.laws.contact, next, a.broken.log_of(steps_.state), a.now.step);
  a.laws.contact.bond = next;
  prepare_rows(a.particles, a.rows, next);
  re_reference_rows(a.particles, a.rows, a.laws.contact);
  time_steps_.ask();
  evaluate_forces();
}

void Simulation::set_skin(Real skin) {
  assembly_.upkeep.set_skin(skin);
  assembly_.upkeep.ask();
}

void Simulation::set_ledger(bool on) {
  graph_.drop();
  Assembly& a = assembly_;
  a.laws.contact.ledger = on;
  a.dissipation = Dissipation();
  if (on) allocate_dissipation(a.dissipation, a.laws.losses(), a.particles.x.extent(0));
  a.now.walls.work = 0;
}

void Simulation::keep_breaks(BreakRecord record) {
  graph_.drop();
  assembly_.keep_breaks(record);
}

void Simulation::set_decomposition(Decomposition const& cuts) {
  assembly_.ghosts.set_decomposition(cuts);
  assembly_.upkeep.ask();
}

void Simulation::add_uniform_strain_rate(Real rate_x, Real rate_y) {
  AffineFrame const f = assembly_.frame();
  add_affine_velocity(assembly_.particles, rate_x, rate_y, f.centre_x, f.centre_y);
}

void Simulation::drive(AxisDrive const& x, AxisDrive const& y, Real rate_x, Real rate_y) {
  MovingWalls& walls = assembly_.now.walls;
  walls.loading.x = x;
  walls.loading.y = y;
  walls.loading.steer(walls.place, assembly_.stress(), walls.reactions, time_step);
  add_uniform_strain_rate(rate_x, rate_y);
}

void Simulation::strain(Real x, Real y) {
  Real const factor_x = 1 - x, factor_y = 1 - y;
  StepState& now = assembly_.now;
  Box const box = now.box();
  scale_positions(assembly_.particles, factor_x, factor_y, box.x, box.y);
  if (now.periodic()) {
    CellMatrix& edges = now.cell.edges;
    edges = {edges.xx * factor_x, edges.xy * factor_x, edges.yy * factor_y};
  } else {
    Coord(&at)[wall_count] = now.walls.place.position;
    for (WallName const wall : {left, right}) at[wall] = box.x + factor_x * (at[wall] - box.x);
    for (WallName const wall : {bottom, top}) at[wall] = box.y + factor_y * (at[wall] - box.y);
  }
  assembly_.refresh_ghosts();
}

void Simulation::strain_above(Coord floor, Real y) {
  Coord& at = assembly_.now.walls.place.position[top];
  scale_positions(assembly_.particles, 1, 1 - y, 0, floor, floor);
  at = floor + (1 - y) * (at - floor);
  assembly_.refresh_ghosts();
}

void Simulation::rebuild(RebuildInputs const& all, AuxiliaryFields const& also) {
  graph_.drop();
  search_neighbours(assembly_, all, /*skin_by_speed=*/true, also);
  time_steps_.after_search();
}

void Simulation::choose_time_step(StepChoice const& choice) {
  time_steps_.follow(choice, assembly_.ranks().min(local_time_step(assembly_.springs())));
  update_time_step();
}

void Simulation::update_time_step() {
  Assembly& a = assembly_;
  if (a.upkeep.is_asked()) rebuild(rebuild_inputs_of_all(a), force_fields(a));
  time_step = time_steps_.update(a.springs(), a.laws, a.across());
  a.now.at_update = {a.now.box(), 0};
  if (time_steps_.remember_places(a.particles)) graph_.drop();
}

}  // namespace clathra
