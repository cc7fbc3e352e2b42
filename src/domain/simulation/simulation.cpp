#include "domain/simulation/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "domain/simulation/fault_report.hpp"
#include "kernels/history_forces.hpp"

namespace clathra {

namespace {

/// Whether histories come to the same forces, but for the rolling of grain contacts.
bool same_stiffness(ContactLaws const& a, ContactLaws const& b) {
  auto const of_grains = [](GrainLaw const& law) { return std::tuple(law.normal_stiffness, law.shear_stiffness); };
  auto const of_bonds = [](BondLaw const& law) {
    return std::tuple(law.modulus, law.particle_stiffness, law.critical_thickness, law.thickness_partner, law.thickness_weight,
                      law.plate_thickness);
  };
  return a.bond_kind == b.bond_kind && of_grains(a.grain) == of_grains(b.grain) && of_bonds(a.bond) == of_bonds(b.bond);
}

/// How many times as large the square of the largest frequency may become, with the factor of local damping, when laws follow
/// others: no spring network vibrates faster by more than its springs became stiffer.
Real stiffening(SimulationLaws const& before, SimulationLaws const& after) {
  constexpr Real calm_friction = 2;  // sliding vibrates faster above it (stability.hpp)
  Real most = 1;
  auto const compare = [&most](Real was, Real is) {
    if (is > was) most = std::max(most, was > 0 ? is / was : HUGE_VAL);
  };
  GrainLaw const &old_grain = before.contact.grain, &grain = after.contact.grain;
  compare(old_grain.normal_stiffness * old_grain.shape_factor * old_grain.shape_factor,
          grain.normal_stiffness * grain.shape_factor * grain.shape_factor);
  compare(std::max(old_grain.friction, calm_friction), std::max(grain.friction, calm_friction));
  compare(old_grain.damping_ratio, grain.damping_ratio);
  compare(before.wall.normal_stiffness, after.wall.normal_stiffness);
  compare(before.wall.shear_stiffness, after.wall.shear_stiffness);
  if (!same_stiffness(before.contact, after.contact)) return HUGE_VAL;
  return most * std::max<Real>(1, (1 + after.motion.damping) / (1 + before.motion.damping));
}

constexpr Real most_stiffening = 1.05;  // that a share of 0.95 of the limit bears without a new choice: it is then 0.973
constexpr Real calm_leeway = 0.3;       // of its skin that a calm disc may stray before the step is chosen anew
constexpr int least_steps_of_a_calm_choice = 150;

}  // namespace

void Simulation::throw_out_of_range(SumOutOfRange const& problem) const {
  throw Diverged("step " + std::to_string(now_.step) + ", time " + std::to_string(now_.time) + " s: " + problem.what());
}

void Simulation::set_sums() {
  sums_ = {SumUnits::of(d50_ > 0 ? d50_ : 2 * largest_radius_, laws_.contact.grain.normal_stiffness, density_),
           ranks_.summation()};
}

ContactFeatures Simulation::features_of_rows() const {
  ContactFeatures features = laws_.features();
  features.format.precision = laws_.precision;
  return features;
}

/// What a search has to know of the discs of all ranks; throws where there are faults.
Survey Simulation::survey_discs() const {
  if (rows_.features.bonds) refresh_ghosts();  // gaps to ghosts are those of now
  return checked(survey(particles_, rows_, frame(), faults_, sums_.unit));
}

Survey Simulation::checked(Survey all) const {
  ranks_.sum(all.sums, Survey::sum_count);
  ranks_.max(all.largest, Survey::largest_count);
  throw_of(all.largest + Survey::faults);
  all.mean_speed = in_range([&] { return all.mean_of_speeds(sums_.unit); });
  return all;
}

/// A periodic cell must stay twice as wide as neighbours reach.
SkinRange Simulation::skin_range(bool by_speed) const {
  constexpr Real times = 5;
  Real const least = skin_ / 2;
  if (!by_speed) return {least, least};
  Real most = times * least;
  if (periodic()) most = std::min(most, 0.49 * (0.5 * std::min(now_.box.cell.width, now_.box.cell.height) - 2 * largest_radius_));
  return {least, std::max(most, least)};
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
  if (ledger) open_accounts(losses_, laws_.losses(), particles_.x.extent(0));
  following_.due |= following_.on && stiffening(laws_of_choice_, laws_) > most_stiffening;
}

void Simulation::set_ledger(bool on) {
  graph_.drop();
  laws_.contact.ledger = on;
  losses_ = EnergyLosses();
  if (on) open_accounts(losses_, laws_.losses(), particles_.x.extent(0));
  now_.boundary_work = 0;
}

void Simulation::mark_start() {
  start_x_ = Field<Coord>("start_x", particles_.x.extent(0));
  start_y_ = Field<Coord>("start_y", particles_.x.extent(0));
  Kokkos::deep_copy(start_x_, particles_.x);
  Kokkos::deep_copy(start_y_, particles_.y);
}

void Simulation::set_decomposition(Decomposition const& cuts) {
  decomposition_ = cuts;
  rebuild_pending_ = true;
}

void Simulation::refresh_ghosts() const {
  if (periodic()) images_.refresh(particles_, now_.box.cell);
  if (!ranks_.alone()) halo_.refresh(ranks_, particles_);
}

void Simulation::refresh_ghosts(AnyField const& field) const {
  if (periodic()) images_.refresh(particles_, field);
  if (!ranks_.alone()) halo_.refresh(ranks_, particles_, field);
}

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

LossTotals Simulation::losses() const {
  if (!laws_.contact.ledger) return {};
  return in_range([&] { return total_losses(losses_, particles_.owned, sums_); });
}

std::uint64_t Simulation::hash() const {
  return static_cast<std::uint64_t>(ranks_.sum(static_cast<std::int64_t>(state_hash(particles_, rows_))));
}

SpringNetwork Simulation::springs() const { return {particles_, rows_, laws_.contact, now_.box.walls, laws_.wall}; }

AcrossRanks Simulation::across() const {
  return {sums_, [this](double value) { return ranks_.max(value); }, [this](Field<Real> const& field) { refresh_ghosts(field); }};
}

Real Simulation::stable_time_step(Real safety) const {
  return std::min(safety * ranks_.min(local_time_step(springs())), usual_share_of_limit * stable_limit());
}

void Simulation::choose_time_step(StepChoice const& choice) {
  Real const estimate = ranks_.min(local_time_step(springs()));
  constexpr Real most = 1.35;  // times the estimate, which counts contacts to come: no bound knows those of flying discs
  following_.on = true;
  following_.share = choice.rule == TimeStepRule::spectrum ? choice.safety : usual_share_of_limit;
  following_.ceiling = (choice.rule == TimeStepRule::spectrum ? most : choice.safety) * estimate;
  following_.age = least_steps_of_a_calm_choice;
  renew_time_step();
}

/// Where discs stray so fast that the last choice did not last, the next one counts every listed gap as closed: it lasts until
/// the next search.
void Simulation::renew_time_step() {
  if (rebuild_pending_) rebuild(survey_discs(), true, forces());
  following_.leeway = following_.age < least_steps_of_a_calm_choice ? 1 : calm_leeway;
  Real const limit = clathra::stable_limit(springs(), laws_.motion.damping, following_.leeway, across());
  time_step = std::min(following_.share * limit, following_.ceiling);
  laws_of_choice_ = laws_;
  following_.age = 0;
  following_.due = false;
  ++renewals_;
  now_.choice = {now_.box, 0};
  for (auto* field : {&step_x_, &step_y_}) {
    if (field->extent(0) == particles_.x.extent(0)) continue;
    graph_.drop();
    *field = Field<Coord>("step_reference", particles_.x.extent(0));
  }
  Kokkos::deep_copy(step_x_, particles_.x);
  Kokkos::deep_copy(step_y_, particles_.y);
}

Real Simulation::largest_frequency(int iterations) const {
  return in_range([&] { return clathra::largest_frequency(springs(), across(), iterations); });
}

Real Simulation::stable_limit() const { return clathra::stable_limit(springs(), laws_.motion.damping, calm_leeway, across()); }

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
  ranks_.sum(counts.number, break_mode_count);
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
  ranks_.max(disc, fault_count);
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
