/// Taking a simulation apart for a checkpoint, and putting it together again.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "domain/parallel/id_index.hpp"
#include "domain/simulation/simulation.hpp"

namespace clathra {

namespace {

constexpr char const* wall_names[] = {"left", "right", "bottom", "top"};

template <class Visit>
void visit_walls(std::string const& name, Walls& walls, Visit&& visit) {
  for (int wall = 0; wall < wall_count; ++wall) {
    visit(name + "_" + wall_names[wall], walls.position[wall]);
    visit(name + "_" + wall_names[wall] + "_velocity", walls.velocity[wall]);
  }
}

template <class Visit>
void visit_drive(std::string const& name, AxisDrive& drive, Visit&& visit) {
  visit(name + "_kind", drive.kind);
  visit(name + "_strain_rate", drive.strain_rate);
  visit(name + "_target_stress", drive.target_stress);
  visit(name + "_one_sided", drive.one_sided);
  visit(name + "_integral", drive.integral);
  visit(name + "_largest_speed", drive.largest_speed);
}

}  // namespace

/// Visits every number of the whole: (name, double, integer, bool or enumeration).
template <class Visit>
void Simulation::for_each_number(Visit&& visit) {
  visit("step", now_.step);
  visit("time", now_.time);
  visit("time_step", time_step);
  visit("boundary_work", now_.boundary_work);
  visit("ledger", laws_.contact.ledger);
  visit("keeps_break_events", broken_bonds_.keeps_events);
  visit_walls("wall", now_.box.walls, visit);
  visit_walls("wall_at_search", now_.at_search.box.walls, visit);
  for (int wall = 0; wall < wall_count; ++wall) {
    std::string const name = std::string("reaction_") + wall_names[wall];
    visit(name, now_.reactions.normal[wall]);
    visit(name + "_shear", now_.reactions.shear[wall]);
    visit(name + "_contacts", now_.reactions.contacts[wall]);
  }
  visit_drive("drive_x", now_.loading.x, visit);
  visit_drive("drive_y", now_.loading.y, visit);
  visit("servo_gain", now_.loading.servo.gain);
  visit("servo_integral_time", now_.loading.servo.integral_time);
  visit("servo_contact_stiffness", now_.loading.servo.contact_stiffness);
  facts_.for_each_number(visit);
  upkeep_.for_each_number(visit);
  time_steps_.for_each_number(visit);
  visit_walls("wall_at_update", now_.at_update.box.walls, visit);
  visit("largest_deviator", now_.largest.q);
  visit("largest_deviator_height", now_.largest.height);
  visit("break_details_from_height", broken_bonds_.details_from_height);
}

AuxiliaryFields Simulation::forces() {
  AuxiliaryFields all;
  for_each_force(particles_, [&](DiscField const& about, auto& field) { all.push_back({about.name, &field}); });
  return all;
}

/// What is derived from the state but must not be derived anew: forces, and where the last search and the last update of the time
/// step found the discs.
AuxiliaryFields Simulation::derived() {
  AuxiliaryFields all;
  for_each_derived_field(particles_, [&](DiscField const& about, auto& field) { all.push_back({about.name, &field}); });
  UpdatePlaces& places = time_steps_.places();
  if (time_steps_.follows()) all.insert(all.begin(), {{"x_at_update", &places.x}, {"y_at_update", &places.y}});
  return all;
}

SimulationState Simulation::state() {
  if (periodic()) throw std::logic_error("a periodic cell has no checkpoint");
  if (upkeep_.is_asked()) rebuild(rebuild_inputs_of_all(), true, forces());  // rows as the next step would find them
  SimulationState s;
  for_each_number([&](std::string const& name, auto const& value) { s.numbers[name] = static_cast<double>(value); });
  s.numbers["marked_start"] = start_x_.extent(0) > 0 ? 1 : 0;
  WallShear wall_shear = wall_shear_of_discs(particles_, wall_contacts_, scratch_);
  AuxiliaryFields const with_discs = with(auxiliary_fields(wall_shear), derived());
  ContactRows named = rows_;
  named.neighbour = uninitialised<int>("named", rows_.neighbour.extent(0));
  Kokkos::deep_copy(named.neighbour, rows_.neighbour);
  name_neighbours(particles_, named);
  std::vector<int> all(static_cast<std::size_t>(particles_.owned));
  std::iota(all.begin(), all.end(), 0);
  s.discs = pack_discs(particles_, with_discs, named, all);
  RecordColumns const columns = record_columns(with_discs, rows_.features);
  s.disc_columns = columns.discs;
  s.history_columns = columns.history;
  broken_bonds_.collect();
  broken_bonds_.write(s, ranks());
  return s;
}

Simulation::Simulation(SimulationState state, SimulationLaws const& laws, Ranks among)
    : ghosts_(std::move(among)), laws_(laws), upkeep_(0), faults_(make_faults()) {
  for_each_number(
      [&](std::string const& name, auto& value) { value = static_cast<std::decay_t<decltype(value)>>(state.numbers.at(name)); });
  time_steps_.go_on_with(laws);
  set_sums();
  rows_.features = features_of_rows();
  particles_ = allocate_particles(0, laws_.precision, facts_.largest_radius);
  if (laws_.contact.ledger) allocate_dissipation(losses_, laws_.losses(), 1);
  if (state.numbers.at("marked_start") != 0) mark_start();
  wall_contacts_.rough = laws_.wall.friction > 0;
  WallShear wall_shear = wall_shear_of_discs(particles_, wall_contacts_, scratch_);
  AuxiliaryFields const with_discs = with(auxiliary_fields(wall_shear), derived());
  if (record_columns(with_discs, rows_.features) != RecordColumns{state.disc_columns, state.history_columns})
    throw std::runtime_error("a checkpoint's discs have other numbers than its laws ask for");
  rows_ = unpack_discs(records_of_own_discs(std::move(state.discs)), rows_.features, particles_, with_discs);
  // Discs have moved since the rows were listed: neighbours may be farther than the search reached, by both their skins.
  ghosts_.rebuild(particles_, now_.box, upkeep_.reach() + 2 * (upkeep_.reach() - 2 * facts_.largest_radius));
  find_listed_neighbours();
  prepare_rows(particles_, rows_, laws_.contact.bond);
  make_room_for_breaks();
  Field<std::int64_t> const number = scratch_.take<std::int64_t>("near_walls", 1);
  Field<int> const near_walls = list_near_walls(particles_, now_.box.walls, number, scratch_);
  auto const size = static_cast<int>(host_copy(number)(0));
  wall_contacts_ = make_wall_contacts(near_walls, size, laws_.wall.friction > 0, wall_shear, scratch_);
  broken_bonds_.read(state, ranks());
}

/// The records of the discs that belong to this rank, from wherever they were read.
std::vector<double> Simulation::records_of_own_discs(DiscRecords discs) {
  if (ranks().alone()) return std::move(discs.numbers);
  // Behind the id come x and y.
  std::vector<double> x, y;
  for (std::size_t k = 0; k < discs.size(); ++k) {
    x.push_back(discs.numbers[discs.begin[k] + 1]);
    y.push_back(discs.numbers[discs.begin[k] + 2]);
  }
  ghosts_.set_decomposition(Decomposition::bisect(ranks(), x, y, 1));
  std::vector<std::vector<double>> to(static_cast<std::size_t>(ranks().count()));
  for (std::size_t k = 0; k < discs.size(); ++k) {
    auto& part = to[static_cast<std::size_t>(decomposition().owner(x[k], y[k]))];
    part.insert(part.end(), discs.numbers.begin() + static_cast<std::ptrdiff_t>(discs.begin[k]),
                discs.numbers.begin() + static_cast<std::ptrdiff_t>(discs.begin[k + 1]));
  }
  discs = {};
  std::vector<double> home;
  for (auto& part : ranks().exchange(std::move(to))) {
    home.insert(home.end(), part.begin(), part.end());
    part = {};
  }
  return home;
}

/// Replaces the neighbours' ids in the rows by the indices of discs and ghosts.
void Simulation::find_listed_neighbours() {
  auto const id = host_copy(particles_.id);
  auto const length = host_copy(rows_.length);
  auto const slice_start = host_copy(rows_.slice_start);
  auto const listed = host_copy(rows_.neighbour);
  std::vector<int> index(listed.extent(0), particles_.padding());
  IdIndex const places(id, particles_.all());
  bool lost = false;
  for (int i = 0; i < particles_.owned; ++i) {
    for (int k = 0; k < length(i); ++k) {
      std::size_t const e = entry_in(slice_start, rows_.features.format, i, k);
      index[e] = places.find(listed(e));
      lost = lost || index[e] < 0;
    }
  }
  if (ranks().any(lost)) throw std::runtime_error("a checkpoint's row names a neighbour that is not near");
  rows_.neighbour = uninitialised<int>("rows.neighbour", index.size());
  auto host = Kokkos::create_mirror_view(Kokkos::HostSpace(), rows_.neighbour);
  std::copy(index.begin(), index.end(), host.data());
  Kokkos::deep_copy(rows_.neighbour, host);
}

}  // namespace clathra
