#include "domain/simulation/simulation.hpp"

#include <algorithm>
#include <cmath>

#include "domain/simulation/fault_report.hpp"

namespace clathra {

namespace {

constexpr int check_every = 64;    // steps between checks of the fault flags
constexpr Real calm_leeway = 0.3;  // of its skin that a calm disc may stray before the step is chosen anew
constexpr int most_steps_of_a_choice = 1000, least_steps_of_a_calm_choice = 150;

Coord middle(Coord a, Coord b) { return 0.5 * (a + b); }

}  // namespace

/// A sum over the specimen. A term that is out of its range is a fault, of the disc that another fault names if there is one.
template <class Work>
auto Simulation::in_range(Work const& sum) const {
  try {
    return sum();
  } catch (SumOutOfRange const& problem) {
    throw_if_unstable();
    throw Diverged("step " + std::to_string(step_) + ", time " + std::to_string(time_) + " s: " + problem.what());
  }
}

WallReactions Simulation::apply_wall_forces(Real dt) {
  return in_range([&] { return add_wall_forces(particles_, wall_contacts_, walls_, laws_.wall, dt, losses_, faults_, sums_); });
}

void Simulation::step() {
  if (following_.on && (following_.due || rebuild_pending_)) renew_time_step();
  loading.move(walls_, time_step);
  Kokkos::Timer const moving;
  StepLengths const lengths{following_.last > 0 ? middle(following_.last, time_step) : time_step, time_step};
  Real const largest_displacement = integrate(particles_, laws_.motion, lengths, frame(), losses_, faults_);
  following_.last = time_step;
  busy_seconds_ += moving.seconds();
  if (periodic()) stretch_homogeneously();
  Real const way = way_in_skins(ranks_.max(largest_displacement));
  if (rebuild_pending_ || have_strayed(search_mark_, particles_.reference_x, particles_.reference_y, way, 1)) {
    rebuild();
  } else {
    refresh_ghosts();
    if (following_.on)
      following_.due =
          ++following_.age >= most_steps_of_a_choice || have_strayed(step_mark_, step_x_, step_y_, way, following_.leeway);
  }
  WallReactions const before = reactions_;
  Kokkos::Timer const pushing;
  compute_forces(particles_, rows_, laws_.contact, time_step, step_ + 1, broken_bonds_.log_at(height()), losses_, faults_);
  busy_seconds_ += pushing.seconds();
  if (!periodic()) {
    reactions_ = apply_wall_forces(time_step);
    account_boundary_work(before);
    loading.steer(walls_, reactions_, time_step);
  }
  time_ += time_step;
  ++step_;
  if (step_ % check_every == 0) throw_if_unstable();
}

void Simulation::set_sums() {
  sums_ = {SumUnits::of(d50_ > 0 ? d50_ : 2 * largest_radius_, laws_.contact.grain.normal_stiffness, density_),
           ranks_.summation()};
}

ContactFeatures Simulation::features_of_rows() const {
  ContactFeatures features = laws_.features();
  features.format = history_format(laws_.precision, laws_.contact, largest_radius_);
  return features;
}

/// Of the discs of all ranks; throws where there are faults.
Survey Simulation::survey_discs() const {
  Survey all = survey(particles_, rows_, frame(), faults_, sums_.unit);
  ranks_.sum(all.sums, Survey::sum_count);
  ranks_.max(all.largest, Survey::largest_count);
  throw_of(all.largest + Survey::faults);
  all.mean_speed = in_range([&] { return all.mean_of_speeds(sums_.unit); });
  return all;
}

/// The homogeneous motion since a mark: that of the walls, or of the periodic cell.
AffineFrame Simulation::frame_since(Mark const& mark) const {
  AffineFrame f;
  if (periodic()) {
    f.centre_x = f.reference_centre_x = cell_.left;
    f.centre_y = f.reference_centre_y = cell_.bottom;
    f.stretch_x = cell_.width / mark.cell.width;
    f.stretch_y = cell_.height / mark.cell.height;
    return f;
  }
  f.centre_x = middle(walls_.position[left], walls_.position[right]);
  f.centre_y = middle(walls_.position[bottom], walls_.position[top]);
  f.reference_centre_x = middle(mark.walls.position[left], mark.walls.position[right]);
  f.reference_centre_y = middle(mark.walls.position[bottom], mark.walls.position[top]);
  f.stretch_x = walls_.width() / mark.walls.width();
  f.stretch_y = walls_.height() / mark.walls.height();
  f.gradient_x = (walls_.velocity[right] - walls_.velocity[left]) / walls_.width();
  f.gradient_y = (walls_.velocity[top] - walls_.velocity[bottom]) / walls_.height();
  f.drift_x = middle(walls_.velocity[left], walls_.velocity[right]);
  f.drift_y = middle(walls_.velocity[bottom], walls_.velocity[top]);
  return f;
}

/// A periodic cell must stay twice as wide as neighbours reach.
SkinRange Simulation::skin_range(bool by_speed) const {
  constexpr Real times = 5;
  Real const least = skin_ / 2;
  if (!by_speed) return {least, least};
  Real most = times * least;
  if (periodic()) most = std::min(most, 0.49 * (0.5 * std::min(cell_.width, cell_.height) - 2 * largest_radius_));
  return {least, std::max(most, least)};
}

/// What this step may have brought a disc away from the homogeneous motion, as a share of the least skin.
/// @param largest_displacement  of a disc of any rank in this step [m]
Real Simulation::way_in_skins(Real largest_displacement) const {
  Real const of_frame = periodic() ? 0 : (walls_.largest_speed(left, right) + walls_.largest_speed(bottom, top)) * time_step;
  return (largest_displacement + of_frame) / skin_range(false).least;
}

/// Whether two discs whose gap was wider than a share of both their skins, where a mark stands, could touch: the largest
/// non-affine displacement of a disc as a share of its skin, plus what the homogeneous motion itself brings two discs nearer, as
/// a share of the least skin. Ways are added up until they could amount to that, and only then are the discs' own ones computed.
/// @param x,y  where the discs were then;  @param way  of this step, in least skins;  @param leeway  the share
bool Simulation::have_strayed(Mark& mark, Field<Coord> const& x, Field<Coord> const& y, Real way, Real leeway) {
  AffineFrame const f = frame_since(mark);
  Real const closing = std::max({std::abs(1 - f.stretch_x), std::abs(1 - f.stretch_y)});
  Real const spent = closing * (2 * largest_radius_ / skin_ + 1);
  mark.strayed += way;
  if (mark.strayed * (1 + closing) + spent < leeway) return false;
  mark.strayed = std::sqrt(ranks_.max(largest_nonaffine_displacement2(particles_, x, y, f)));
  return mark.strayed + spent >= leeway;
}

void Simulation::account_boundary_work(WallReactions const& before) {
  // The mean force over the step times the way: what leapfrog's kinetic energy sees to the digit.
  for (int wall = 0; wall < wall_count; ++wall) {
    Real const outward = wall == right || wall == top ? 1 : -1;
    boundary_work_ -= 0.5 * (before.normal[wall] + reactions_.normal[wall]) * outward * walls_.velocity[wall] * time_step;
  }
}

void Simulation::evaluate_forces() {
  if (rebuild_pending_) rebuild();
  compute_forces(particles_, rows_, laws_.contact, 0, step_, broken_bonds_.log_at(height()), losses_, faults_);
  if (!periodic()) reactions_ = apply_wall_forces(0);
}

void Simulation::set_laws(SimulationLaws const& laws) {
  bool const ledger = laws_.contact.ledger;
  if (laws.precision != laws_.precision) throw std::invalid_argument("a simulation keeps its precision");
  laws_ = laws;
  laws_.contact.ledger = ledger;
  ContactFeatures const features = features_of_rows();
  bool const same_history = features == rows_.features;
  if (!same_history) change_features(rows_, features);
  if (!same_history || rows_.features.bonds) prepare_rows(particles_, rows_, laws_.contact.bond);
  if (ledger) open_accounts(losses_, laws_.losses(), particles_.x.extent(0));
}

void Simulation::set_ledger(bool on) {
  laws_.contact.ledger = on;
  losses_ = EnergyLosses();
  if (on) open_accounts(losses_, laws_.losses(), particles_.x.extent(0));
  boundary_work_ = 0;
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
  if (periodic()) images_.refresh(particles_, cell_);
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

/// Isotropic stretching of the periodic cell with all its discs.
void Simulation::stretch_homogeneously() {
  if (cell_rate_ == 0) return;
  Real const stretch = 1 - cell_rate_ * time_step;
  scale_positions(particles_, stretch, cell_.left, cell_.bottom);
  cell_.width *= stretch;
  cell_.height *= stretch;
}

Measures Simulation::measures() const {
  return in_range([&] { return measure(particles_, rows_, laws_.contact, wall_contacts_, walls_, laws_.wall, sums_); });
}

LossTotals Simulation::losses() const {
  if (!laws_.contact.ledger) return {};
  return in_range([&] { return total_losses(losses_, particles_.owned, sums_); });
}

std::uint64_t Simulation::hash() const {
  return static_cast<std::uint64_t>(ranks_.sum(static_cast<std::int64_t>(state_hash(particles_, rows_))));
}

SpringNetwork Simulation::springs() const { return {particles_, rows_, laws_.contact, walls_, laws_.wall}; }

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
  if (rebuild_pending_) rebuild(true, forces());
  following_.leeway = following_.age < least_steps_of_a_calm_choice ? 1 : calm_leeway;
  Real const limit = clathra::stable_limit(springs(), laws_.motion.damping, following_.leeway, across());
  time_step = std::min(following_.share * limit, following_.ceiling);
  following_.age = 0;
  following_.due = false;
  ++renewals_;
  step_mark_ = {walls_, cell_, 0};
  for (auto* field : {&step_x_, &step_y_})
    if (field->extent(0) != particles_.x.extent(0)) *field = Field<Coord>("step_reference", particles_.x.extent(0));
  Kokkos::deep_copy(step_x_, particles_.x);
  Kokkos::deep_copy(step_y_, particles_.y);
}

Real Simulation::largest_frequency(int iterations) const {
  return in_range([&] { return clathra::largest_frequency(springs(), across(), iterations); });
}

Real Simulation::stable_limit() const { return clathra::stable_limit(springs(), laws_.motion.damping, calm_leeway, across()); }

void Simulation::keep_break_events(bool on) {
  broken_bonds_.collect();
  broken_bonds_.keeps_events = on;
  broken_bonds_.drop_log();
  make_room_for_breaks();
}

void Simulation::keep_break_details() {
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
  auto const here = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), faults_.disc);
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
  last_good_step_ = step_;
}

}  // namespace clathra
