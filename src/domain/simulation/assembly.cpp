#include "domain/simulation/assembly.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "domain/scene/stage.hpp"
#include "domain/simulation/fault_report.hpp"
#include "domain/simulation/time_step_control.hpp"

namespace clathra {

Assembly::Assembly(SimulationLaws const& by_laws, Real skin, Ranks ranks, bool periodic)
    : laws(by_laws), ghosts(std::move(ranks)), upkeep(skin), faults(make_faults()) {
  if (!periodic) boundaries.push_back(std::make_unique<RigidWalls>(/*rough=*/laws.wall.friction > 0));
}

WallContacts Assembly::wall_contacts() const {
  for (auto const& boundary : boundaries)
    if (auto const* const rigid = dynamic_cast<RigidWalls const*>(boundary.get())) return rigid->contacts();
  return {};
}

Measures Assembly::measures() const {
  return in_range([&] { return measure(particles, rows, laws.contact, wall_contacts(), walls(), laws.wall, sums); });
}

Real Assembly::force_of_leaving_bonds(BondLaw const& next) const {
  return in_range([&] { return clathra::force_of_leaving_bonds(particles, rows, laws.contact, next, sums); });
}

DissipationTotals Assembly::losses() const {
  if (!laws.contact.ledger) return {};
  return in_range([&] { return total_losses(dissipation, particles.owned, sums); });
}

std::uint64_t Assembly::hash() const {
  return static_cast<std::uint64_t>(ranks().sum(static_cast<std::int64_t>(state_hash(particles, rows))));
}

SpringNetwork Assembly::springs() const { return {particles, rows, laws.contact, walls(), laws.wall}; }

AcrossRanks Assembly::across() const {
  return {sums, [this](double value) { return ranks().max(value); }, [this](Field<Real> const& field) { refresh_ghosts(field); }};
}

Real Assembly::largest_frequency(int iterations) const {
  return in_range([&] { return clathra::largest_frequency(springs(), across(), iterations); });
}

Real Assembly::stable_limit() const { return TimeStepControl::calm_limit(springs(), laws.motion.damping, across()); }

Real Assembly::stable_time_step(Real safety) const {
  return std::min(safety * ranks().min(local_time_step(springs())), usual_share_of_limit * stable_limit());
}

BreakCounts Assembly::break_counts() const {
  broken.collect();
  BreakCounts counts = broken.counts();
  ranks().sum(counts.number, break_mode_count);
  return counts;
}

BreakEvents Assembly::detailed_break_events(int first) const {
  broken.collect();
  return broken.sorted_events(first);
}

std::size_t Assembly::bytes() const {
  return clathra::bytes(particles) + clathra::bytes(rows) + ghosts.bytes() + clathra::bytes(dissipation) + broken.bytes() +
         (start_x.span() + start_y.span()) * sizeof(Coord) + search_bytes();
}

void Assembly::set_sums() {
  sums = {SumUnits::of(facts.d50 > 0 ? facts.d50 : 2 * facts.largest_radius, laws.contact.grain.normal_stiffness, facts.density),
          ranks().summation()};
}

/// Where no rank sends or gets discs, intact bonds only become fewer after they have been installed.
bool Assembly::log_lasts() const { return laws.contact.bond_kind == BondKind::none || (ranks().alone() && broken.has_log()); }

void Assembly::make_room_for_breaks() {
  if (log_lasts()) return;
  broken.make_room(broken.keeps_events ? static_cast<std::size_t>(count_own_bonds(particles, rows)) : 0);
}

void Assembly::keep_breaks(BreakRecord record) {
  broken.collect();
  broken.keeps_events = record != BreakRecord::counts;
  if (record == BreakRecord::details) broken.details_from_height = now.box().height();
  broken.drop_log();
  make_room_for_breaks();
}

void Assembly::mark_start() {
  start_x = Field<Coord>("start_x", particles.x.extent(0));
  start_y = Field<Coord>("start_y", particles.y.extent(0));
  Kokkos::deep_copy(start_x, particles.x);
  Kokkos::deep_copy(start_y, particles.y);
}

void Assembly::throw_out_of_range(SumOutOfRange const& problem) const {
  throw Diverged("step " + std::to_string(steps()) + ", time " + std::to_string(time()) + " s: " + problem.what());
}

void Assembly::throw_if_unstable() const {
  auto const here = host_copy(faults.disc);
  double disc[fault_count];
  for (int fault = 0; fault < fault_count; ++fault) disc[fault] = here(fault);
  ranks().max(disc, fault_count);
  throw_of(disc);
}

void Assembly::throw_of(double const* disc) const {
  for (int fault = 0; fault < fault_count; ++fault) {
    if (disc[fault] < 0) continue;
    double place[2] = {0, 0};
    std::string const text = fault_text(*this, {static_cast<Fault>(fault), static_cast<int>(disc[fault]), last_good_step}, place);
    throw Diverged(text, place[0], place[1]);
  }
  last_good_step = steps();
}

}  // namespace clathra
