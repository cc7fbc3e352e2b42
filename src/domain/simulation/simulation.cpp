#include "domain/simulation/simulation.hpp"

#include <algorithm>
#include <cmath>

#include "domain/simulation/fault_report.hpp"
#include "kernels/history_forces.hpp"

namespace clathra {

void Simulation::throw_out_of_range(SumOutOfRange const& problem) const {
  throw Diverged("step " + std::to_string(now_.step) + ", time " + std::to_string(now_.time) + " s: " + problem.what());
}

void Simulation::set_sums() {
  sums_ = {
      SumUnits::of(facts_.d50 > 0 ? facts_.d50 : 2 * facts_.largest_radius, laws_.contact.grain.normal_stiffness, facts_.density),
      ranks().summation()};
}

ContactFeatures Simulation::features_of_rows() const {
  ContactFeatures features = laws_.features();
  features.format.precision = laws_.precision;
  return features;
}

/// What a search has to know of the discs of all ranks; throws where there are faults.
RebuildInputs Simulation::rebuild_inputs_of_all() const {
  if (rows_.features.bonds) refresh_ghosts();  // gaps to ghosts are those of now
  return checked(rebuild_inputs(particles_, rows_, frame(), faults_, sums_.unit));
}

RebuildInputs Simulation::checked(RebuildInputs all) const {
  ranks().sum(all.sums, RebuildInputs::sum_count);
  ranks().max(all.largest, RebuildInputs::largest_count);
  throw_of(all.largest + RebuildInputs::faults);
  all.mean_speed = in_range([&] { return all.mean_of_speeds(sums_.unit); });
  return all;
}

void Simulation::set_laws(SimulationLaws const& laws) {
  bool const ledger = laws_.contact.ledger;
  if (laws.precision != laws_.precision) throw std::invalid_argument("a simulation keeps its precision");
  graph_.drop();
  ContactLaws const before = laws_.contact;
  laws_ = laws;
  laws_.contact.ledger = ledger;
  ContactFeatures const features = features_of_rows();
  bool const same_history = features == rows_.features, anchors = !same_history || !same_stiffness(before, laws_.contact);
  if (anchors) rows_ = with_forces(particles_, rows_, before);
  if (!same_history) change_features(rows_, features);
  if (!same_history || rows_.features.bonds) prepare_rows(particles_, rows_, laws_.contact.bond);
  if (anchors)
    anchor_rows(particles_, rows_, laws_.contact);
  else if (before.grain.shape_factor != laws_.contact.grain.shape_factor)
    keep_moments(particles_, rows_, before, laws_.contact);
  if (ledger) allocate_dissipation(losses_, laws_.losses(), particles_.x.extent(0));
  time_steps_.after_laws(laws_);
}

void Simulation::set_ledger(bool on) {
  graph_.drop();
  laws_.contact.ledger = on;
  losses_ = Dissipation();
  if (on) allocate_dissipation(losses_, laws_.losses(), particles_.x.extent(0));
  now_.boundary_work = 0;
}

void Simulation::mark_start() {
  start_x_ = Field<Coord>("start_x", particles_.x.extent(0));
  start_y_ = Field<Coord>("start_y", particles_.x.extent(0));
  Kokkos::deep_copy(start_x_, particles_.x);
  Kokkos::deep_copy(start_y_, particles_.y);
}

void Simulation::set_decomposition(Decomposition const& cuts) {
  ghosts_.set_decomposition(cuts);
  upkeep_.ask();
}

void Simulation::refresh_ghosts() const { ghosts_.refresh(particles_, now_.box); }

void Simulation::refresh_ghosts(AnyField const& field) const { ghosts_.refresh(particles_, now_.box, field); }

void Simulation::add_uniform_strain_rate(Real rate_x, Real rate_y) {
  AffineFrame const f = frame();
  add_affine_velocity(particles_, rate_x, rate_y, f.centre_x, f.centre_y);
}

void Simulation::strain(Real x, Real y) {
  Real const factor_x = 1 - x, factor_y = 1 - y;
  if (periodic()) {
    PeriodicCell& cell = now_.box.cell;
    scale_positions(particles_, factor_x, factor_y, cell.left, cell.bottom);
    cell.width *= factor_x;
    cell.height *= factor_y;
  } else {
    Coord(&at)[wall_count] = now_.box.walls.position;
    AffineFrame const f = frame();
    scale_positions(particles_, factor_x, factor_y, f.centre_x, f.centre_y);
    for (WallName const wall : {left, right}) at[wall] = f.centre_x + factor_x * (at[wall] - f.centre_x);
    for (WallName const wall : {bottom, top}) at[wall] = f.centre_y + factor_y * (at[wall] - f.centre_y);
  }
  refresh_ghosts();
}

void Simulation::strain_above(Coord floor, Real y) {
  Coord& at = now_.box.walls.position[top];
  scale_positions(particles_, 1, 1 - y, 0, floor, floor);
  at = floor + (1 - y) * (at - floor);
  refresh_ghosts();
}

void Simulation::drive(AxisDrive const& x, AxisDrive const& y, Real rate_x, Real rate_y) {
  now_.loading.x = x;
  now_.loading.y = y;
  now_.loading.steer(now_.box.walls, stress(), now_.reactions, time_step);
  add_uniform_strain_rate(rate_x, rate_y);
}

Measures Simulation::measures() const {
  return in_range([&] { return measure(particles_, rows_, laws_.contact, wall_contacts_, now_.box.walls, laws_.wall, sums_); });
}

DissipationTotals Simulation::losses() const {
  if (!laws_.contact.ledger) return {};
  return in_range([&] { return total_losses(losses_, particles_.owned, sums_); });
}

std::uint64_t Simulation::hash() const {
  return static_cast<std::uint64_t>(ranks().sum(static_cast<std::int64_t>(state_hash(particles_, rows_))));
}

SpringNetwork Simulation::springs() const { return {particles_, rows_, laws_.contact, now_.box.walls, laws_.wall}; }

AcrossRanks Simulation::across() const {
  return {sums_, [this](double value) { return ranks().max(value); },
          [this](Field<Real> const& field) { refresh_ghosts(field); }};
}

Real Simulation::stable_time_step(Real safety) const {
  return std::min(safety * ranks().min(local_time_step(springs())), usual_share_of_limit * stable_limit());
}

void Simulation::choose_time_step(StepChoice const& choice) {
  time_steps_.follow(choice, ranks().min(local_time_step(springs())));
  update_time_step();
}

void Simulation::update_time_step() {
  if (upkeep_.is_asked()) rebuild(rebuild_inputs_of_all(), true, forces());
  time_step = time_steps_.update(springs(), laws_, across());
  now_.at_update = {now_.box, 0};
  if (time_steps_.remember_places(particles_)) graph_.drop();
}

Real Simulation::largest_frequency(int iterations) const {
  return in_range([&] { return clathra::largest_frequency(springs(), across(), iterations); });
}

Real Simulation::stable_limit() const { return TimeStepControl::calm_limit(springs(), laws_.motion.damping, across()); }

void Simulation::keep_break_events(bool on) {
  graph_.drop();
  broken_bonds_.collect();
  broken_bonds_.keeps_events = on;
  broken_bonds_.drop_log();
  make_room_for_breaks();
}

void Simulation::keep_break_details() {
  graph_.drop();
  broken_bonds_.collect();
  broken_bonds_.details_from_height = height();
  broken_bonds_.drop_log();
  make_room_for_breaks();
}

int Simulation::broken_bonds() const { return static_cast<int>(break_counts().total()); }

BreakCounts Simulation::break_counts() const {
  broken_bonds_.collect();
  BreakCounts counts = broken_bonds_.counts();
  ranks().sum(counts.number, break_mode_count);
  return counts;
}

BreakEvents Simulation::detailed_break_events(int first) const {
  broken_bonds_.collect();
  return broken_bonds_.sorted_events(first);
}

void Simulation::throw_if_unstable() const {
  auto const here = host_copy(faults_.disc);
  double disc[fault_count];
  for (int fault = 0; fault < fault_count; ++fault) disc[fault] = here(fault);
  ranks().max(disc, fault_count);
  throw_of(disc);
}

/// @param disc  [fault_count] the largest id of a disc of any rank that met each fault, or -1
void Simulation::throw_of(double const* disc) const {
  for (int fault = 0; fault < fault_count; ++fault) {
    if (disc[fault] < 0) continue;
    double place[2] = {0, 0};
    std::string const text =
        fault_text(*this, {static_cast<Fault>(fault), static_cast<int>(disc[fault]), last_good_step_}, place);
    throw Diverged(text, place[0], place[1]);
  }
  last_good_step_ = now_.step;
}

}  // namespace clathra
