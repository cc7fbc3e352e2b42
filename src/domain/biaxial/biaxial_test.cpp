#include "domain/biaxial/biaxial_test.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <type_traits>
#include <utility>

#include "domain/biaxial/divergence.hpp"
#include "domain/biaxial/quasi_static.hpp"
#include "domain/biaxial/shear_watch.hpp"
#include "domain/generation/bonding.hpp"
#include "domain/generation/equilibration.hpp"
#include "domain/measurement/disc_grading.hpp"
#include "domain/measurement/history_row.hpp"
#include "domain/measurement/snapshot.hpp"
#include "domain/parallel/ranks.hpp"
#include "domain/parallel/redistribution.hpp"
#include "domain/scene/hydrate.hpp"
#include "domain/scene/sample_design.hpp"
#include "domain/scene/scene.hpp"
#include "domain/scene/scene_laws.hpp"
#include "domain/scene/specimen.hpp"
#include "domain/scene/stage.hpp"
#include "domain/simulation/break_event.hpp"
#include "domain/simulation/simulation.hpp"

namespace clathra {

namespace {

constexpr double elastic_lateral_ratio = 0.25;  // lateral expansion per axial compression at the start: the servo's first guess

BondKind bond_kind(Scene const& scene) {
  return scene.bond.composite == Composite::parallel ? BondKind::parallel : BondKind::replace;
}

/// The laws of consolidation and shear: only what the scene needs.
SimulationLaws test_laws(Scene const& scene, double h_max) {
  SimulationLaws laws;
  laws.contact.grain = grain_law(scene);
  if (h_max > 0) {
    laws.contact.bond_kind = bond_kind(scene);
    laws.contact.bond = make_bond_law(scene, h_max);
  }
  laws.wall = wall_law(scene, scene.test.wall_friction);
  laws.motion.damping = 0.7;
  return laws;
}

double height_of(Simulation const& s) { return s.walls().height(); }

}  // namespace

/// Everything a running test knows.
struct BiaxialTest::State {
  Scene scene;
  Ranks ranks;
  std::unique_ptr<Simulation> simulation;
  StageRecord preparation;
  std::vector<std::string> warnings;
  RateNumbers rate;
  double d50 = 0, height0 = 0, area0 = 0;
  std::int64_t bonds0 = 0, steps_per_record = 1, steps_since_record = 0, first_step = 0;
  std::int64_t disc_steps = 0;
  int events_taken = 0;  // of those that this rank has seen
  bool at_rest = false;  // when the shear began
  EnergyRow start;
  ShearWatch watch;

  void bond_and_consolidate(Specimen specimen, ProgressCallback const& progress);
  void consolidate(double stress, ProgressCallback const& progress);
  void require_rest(std::int64_t steps);
  void begin_shear();
  double eps1() const { return std::log(height0 / simulation->walls().height()); }
  void check();
  double skin() const { return scene.run.skin > 0 ? scene.run.skin : chosen_skin * d50; }
  template <class Visit>
  void for_each_number(Visit&& visit);
  void count_disc_steps() { disc_steps += simulation->steps() * simulation->discs(); }
};

/// Bonds first and consolidates then, or the other way round (`bond.after_consolidation`).
void BiaxialTest::State::bond_and_consolidate(Specimen specimen, ProgressCallback const& progress) {
  bool const bond = has_bonds(scene) && specimen.critical_thickness == 0;
  if (bond && !scene.bond.after_consolidation) {
    // Bonds reach across ranks: discs must first be where they belong.
    specimen = by_place(ranks, std::move(specimen));
    bond_specimen(scene, specimen, preparation, ranks);
  }
  auto const start_simulation = [&] {
    SimulationLaws const laws = test_laws(scene, specimen.critical_thickness);
    simulation = std::make_unique<Simulation>(std::exchange(specimen, {}), laws, skin(), ranks);
    simulation->keep_break_events(scene.output.events || scene.output.takes_snapshots());
  };
  start_simulation();
  preparation["void_ratio_before_consolidation"] = simulation->void_ratio();
  consolidate(scene.test.confining_stress, progress);
  if (bond && scene.bond.after_consolidation) {
    count_disc_steps();
    specimen = simulation->specimen();
    simulation.reset();
    bond_specimen(scene, specimen, preparation, ranks);
    start_simulation();
    double const before = simulation->void_ratio();
    consolidate(scene.test.confining_stress, progress);
    if (before - simulation->void_ratio() > 0.003 && !scene.run.force) {
      throw Refused("bonding after consolidation with this composite lets the void ratio drop from " + std::to_string(before) +
                    " to " + std::to_string(simulation->void_ratio()) +
                    ": bond at low stress, or use composite 'parallel' or 'memory'");
    }
  }
  preparation["void_ratio_after_consolidation"] = simulation->void_ratio();
}

/// Compresses homogeneously, discs and walls together, to near the stress, and lets the servo walls hold it there.
void BiaxialTest::State::consolidate(double stress, ProgressCallback const& progress) {
  constexpr double inertial_number = 2e-4;
  Simulation& s = *simulation;
  prepare_servo(s, stress, inertial_number, d50, scene.run.dt_safety);
  double const closing_rate = strain_rate_of(inertial_number, stress, s.density(), d50);
  AxisDrive const servo_x = s.loading.x, servo_y = s.loading.y;
  std::int64_t const budget = scene.test.consolidation_steps,
                     most_steps = std::min(budget, static_cast<std::int64_t>(0.1 / (closing_rate * s.time_step)));
  if (mean_stress(s) < 0.95 * stress) {
    s.loading.x = s.loading.y = AxisDrive::at_rate(closing_rate);
    s.add_uniform_strain_rate(closing_rate, closing_rate);
    while (mean_stress(s) < 0.98 * stress && s.steps() < most_steps) {
      for (int n = 0; n < 20 && s.steps() < most_steps; ++n) s.step();
      if (s.steps() % 2000 == 0)
        report(progress, {"consolidate", 0.5 * mean_stress(s) / stress, "compressing", s.steps() * s.discs()});
    }
    s.add_uniform_strain_rate(-closing_rate, -closing_rate);
  }
  s.loading.x = servo_x;
  s.loading.y = servo_y;
  at_rest = hold_stress(s, stress, unbalanced_at_rest, budget - s.steps(), progress, "consolidate");
  preparation["consolidation_steps"] = static_cast<double>(s.steps());
  preparation["consolidated_unbalanced"] = s.measures().unbalanced_ratio(s.discs());
  if (!at_rest) require_rest(budget);
}

/// The specimen did not come to rest: refused, unless the scene has asked for so many steps or forces it.
void BiaxialTest::State::require_rest(std::int64_t steps) {
  Simulation const& s = *simulation;
  char numbers[160];
  std::snprintf(numbers, sizeof numbers, ": unbalanced ratio %.2g (at rest below %g), mean stress %.4g of %.4g MPa",
                s.measures().unbalanced_ratio(s.discs()), unbalanced_at_rest, mean_stress(s) * 1e-6,
                scene.test.confining_stress * 1e-6);
  std::string const text = "consolidation did not come to rest within " + std::to_string(steps) + " steps" + numbers;
  if (scene.test.consolidation_steps == TestScene::usual_consolidation_steps && !scene.run.force)
    throw Refused(text + "; test.consolidation_steps = N shears it all the same after N steps");
  warnings.push_back(text + ": the test is not quasi-static from its beginning");
}

/// Sets platens, discs and servo in motion together, so that the shear starts without a wave, and opens the accounts.
void BiaxialTest::State::begin_shear() {
  Simulation& s = *simulation;
  SimulationLaws laws = s.laws();
  laws.motion.damping = scene.run.damping;
  s.set_laws(laws);
  s.time_step = s.stable_time_step(scene.run.dt_safety);
  double const frequency = s.largest_frequency();
  preparation["time_step_s"] = s.time_step;
  double const damped = 2 / std::sqrt(1 + scene.run.damping);
  preparation["time_step_margin"] = frequency > 0 ? damped / frequency / s.time_step : 0;
  preparation["time_step_limit_s"] = s.stable_limit();
  height0 = height_of(s);
  area0 = s.area();
  rate = rate_numbers(scene, d50, height0, s.void_ratio());
  for (std::string const& warning : check_rate(scene, rate)) warnings.push_back(warning);
  s.loading.y = AxisDrive::at_rate(rate.strain_rate);
  s.loading.x = AxisDrive::at_stress(scene.test.confining_stress, 2 * rate.strain_rate * height0);
  s.loading.x.integral = -0.5 * elastic_lateral_ratio * rate.strain_rate * s.walls().width();
  s.add_uniform_strain_rate(-elastic_lateral_ratio * rate.strain_rate, rate.strain_rate);
  if (scene.output.energy) s.set_ledger(true);
  first_step = s.steps();
  double const steps = scene.test.axial_strain / (rate.strain_rate * s.time_step);
  steps_per_record = std::max<std::int64_t>(1, std::llround(steps / scene.output.records));
  events_taken = static_cast<int>(s.break_events(0).size());
  int const broken = s.broken_bonds();
  bonds0 = std::llround(s.measures().bonded) + broken;
  if (scene.output.takes_snapshots()) s.mark_start();
  preparation["broken_in_consolidation"] = broken;
  preparation["bytes_per_disc"] = static_cast<double>(ranks.sum(static_cast<std::int64_t>(s.bytes()))) / s.discs();
  preparation["strain_rate_per_s"] = rate.strain_rate;
  preparation["quasi_static"] = at_rest && is_quasi_static(rate) ? 1 : 0;
}

BiaxialTest::BiaxialTest(Scene const& scene, Specimen specimen, ProgressCallback const& progress, Ranks const& ranks)
    : state_(std::make_unique<State>()) {
  State& t = *state_;
  t.scene = scene;
  t.ranks = ranks;
  t.d50 = specimen.d50 > 0 ? specimen.d50 : diameter_finer(specimen.radius, 0.5, ranks);
  with_surroundings(t.simulation, t.d50, [&] { t.bond_and_consolidate(std::move(specimen), progress); });
  t.begin_shear();
  if (scene.output.energy) t.start = energy();
}

BiaxialTest::BiaxialTest(BiaxialTest&& other) noexcept = default;
BiaxialTest::~BiaxialTest() = default;

StageRecord const& BiaxialTest::preparation() const { return state_->preparation; }
std::vector<std::string> const& BiaxialTest::warnings() const { return state_->warnings; }
bool BiaxialTest::finished() const { return strain_fraction() >= 1 - 1e-9; }
double BiaxialTest::axial_strain() const { return state_->eps1(); }
double BiaxialTest::strain_fraction() const { return state_->eps1() / state_->scene.test.axial_strain; }
std::int64_t BiaxialTest::disc_steps() const {
  return state_->disc_steps + state_->simulation->steps() * state_->simulation->discs();
}
double BiaxialTest::search_seconds() const { return state_->simulation->rebuild_seconds(); }
std::uint64_t BiaxialTest::state_hash() const { return state_->simulation->hash(); }

Specimen BiaxialTest::specimen() const {
  Specimen specimen = state_->simulation->specimen();
  specimen.stress = state_->scene.test.confining_stress;
  return specimen;
}

Snapshot BiaxialTest::snapshot() const {
  Simulation const& s = *state_->simulation;
  Snapshot snapshot = take_snapshot(s);
  snapshot.step = s.steps() - state_->first_step;
  snapshot.time = static_cast<double>(snapshot.step) * s.time_step;
  snapshot.eps1 = state_->eps1();
  snapshot.eps_v = std::log(state_->area0 / s.area());
  snapshot.d50 = state_->d50;
  return snapshot;
}

bool BiaxialTest::advance(std::int64_t most_steps, double pause_at) {
  return with_surroundings(state_->simulation, state_->d50, [&] { return advance_unobserved(most_steps, pause_at); });
}

bool BiaxialTest::advance_unobserved(std::int64_t most_steps, double pause_at) {
  Simulation& s = *state_->simulation;
  for (std::int64_t n = 0; n < most_steps; ++n) {
    s.step();
    if (state_->watch.due(state_->eps1())) state_->check();
    bool const due = ++state_->steps_since_record >= state_->steps_per_record || finished();
    if (!due && state_->eps1() >= pause_at) {
      s.throw_if_unstable();
      return false;
    }
    if (!due) continue;
    state_->steps_since_record = 0;
    s.throw_if_unstable();
    return true;
  }
  return false;
}

void BiaxialTest::State::check() {
  watch.check(*simulation, eps1());
  if (!watch.balanced()) preparation["quasi_static"] = 0;
}

std::vector<std::string> BiaxialTest::shear_warnings() const { return state_->watch.warnings(); }

StageRecord BiaxialTest::shear_checks() const {
  StageRecord checks;
  state_->watch.for_each_number([&](char const* name, auto const& value) { checks[name] = static_cast<double>(value); });
  return checks;
}

HistoryRow BiaxialTest::record() {
  Simulation const& s = *state_->simulation;
  Measures const m = s.measures();
  WallStress const stress = s.stress();
  HistoryRow row;
  row.step = s.steps() - state_->first_step;
  row.time_s = static_cast<double>(row.step) * s.time_step;
  row.eps1 = state_->eps1();
  row.eps_v = std::log(state_->area0 / s.area());
  row.sigma1_Pa = stress.y;
  row.sigma3_Pa = stress.x;
  row.q_Pa = stress.y - stress.x;
  row.p_Pa = 0.5 * (stress.y + stress.x);
  row.contact_sigma1_Pa = m.stress_area_yy / s.area();
  row.contact_sigma3_Pa = m.stress_area_xx / s.area();
  row.void_ratio = s.void_ratio();
  row.bonds_intact = std::llround(m.bonded);
  row.intact_initial_pct = state_->bonds0 > 0 ? 100.0 * m.bonded / static_cast<double>(state_->bonds0) : 0;
  row.intact_interacting_pct = m.interacting > 0 ? 100.0 * m.bonded / m.interacting : 0;
  row.broken = s.break_counts();
  row.coordination = 2 * m.interacting / s.discs();
  row.mechanical_coordination = m.mechanical_coordination();
  row.inertial_number = state_->rate.strain_rate * state_->d50 * std::sqrt(s.density() / std::max(row.sigma3_Pa, 1.0));
  row.wave_number = rate_numbers(state_->scene, state_->d50, height_of(s), row.void_ratio).wave_number;
  row.unbalanced = m.unbalanced_ratio(s.discs());
  return row;
}

EnergyRow BiaxialTest::energy() {
  Simulation const& s = *state_->simulation;
  Measures const m = s.measures();
  LossTotals const lost = s.losses();
  EnergyRow row;
  row.boundary_work = s.boundary_work();
  row.kinetic = m.kinetic;
  row.grain_elastic = m.grain_energy;
  row.bond_elastic = m.bond_energy;
  row.wall_elastic = m.wall_energy;
  row.sliding = lost.sliding;
  row.rolling = lost.rolling;
  row.dashpot = lost.dashpot;
  row.damping = lost.damping;
  row.breakage = lost.breakage;
  EnergyRow const& start = state_->start;
  double const stored = row.kinetic + row.grain_elastic + row.bond_elastic + row.wall_elastic;
  double const stored_at_start = start.kinetic + start.grain_elastic + start.bond_elastic + start.wall_elastic;
  row.residual =
      row.boundary_work - (stored - stored_at_start) - (row.sliding + row.rolling + row.dashpot + row.damping + row.breakage);
  return row;
}

std::vector<BreakEvent> BiaxialTest::take_events() {
  std::vector<BreakEvent> events = state_->simulation->break_events(state_->events_taken);
  state_->events_taken += static_cast<int>(events.size());
  for (BreakEvent& event : events) event.step -= state_->first_step;
  return gathered(state_->ranks, std::move(events));
}

std::vector<BreakEvent> BiaxialTest::events_after(std::int64_t step) const {
  std::vector<BreakEvent> later;
  std::vector<BreakEvent> const all = state_->simulation->break_events(0);
  std::vector<BreakEvent> const pending = state_->simulation->break_events(state_->events_taken);
  for (BreakEvent event : all) {
    if (!pending.empty() && !comes_before(event, pending.front())) break;
    event.step -= state_->first_step;
    if (event.step > step) later.push_back(event);
  }
  return gathered(state_->ranks, std::move(later));
}

template <class Visit>
void BiaxialTest::State::for_each_number(Visit&& visit) {
  visit("d50", d50);
  visit("height0", height0);
  visit("area0", area0);
  visit("bonds0", bonds0);
  visit("steps_per_record", steps_per_record);
  visit("steps_since_record", steps_since_record);
  visit("first_step", first_step);
  visit("disc_steps", disc_steps);
  visit("strain_rate", rate.strain_rate);
  visit("inertial_number", rate.inertial_number);
  visit("wave_number", rate.wave_number);
  for_each_energy_column(start, [&](std::string const& name, double& value) { visit("start_" + name, value); });
  watch.for_each_number(visit);
}

TestState BiaxialTest::state() const {
  State& t = *state_;
  TestState s;
  s.simulation = t.simulation->state();
  s.events_taken = static_cast<std::size_t>(t.events_taken);
  s.hash = t.simulation->hash();
  t.for_each_number([&](std::string const& name, auto const& value) { s.numbers[name] = static_cast<double>(value); });
  s.preparation = t.preparation;
  s.warnings = t.warnings;
  return s;
}

BiaxialTest::BiaxialTest(Scene const& scene, TestState state, Ranks const& ranks) : state_(std::make_unique<State>()) {
  State& t = *state_;
  t.scene = scene;
  t.ranks = ranks;
  // Checkpoints from before there were checks hold none.
  t.watch.for_each_number(
      [&](std::string const& name, auto const& value) { state.numbers.emplace(name, static_cast<double>(value)); });
  t.for_each_number(
      [&](std::string const& name, auto& value) { value = static_cast<std::decay_t<decltype(value)>>(state.numbers.at(name)); });
  t.preparation = state.preparation;
  t.warnings = state.warnings;
  t.events_taken = static_cast<int>(state.events_taken);
  SimulationLaws laws = test_laws(scene, state.simulation.numbers.at("critical_thickness"));
  laws.motion.damping = scene.run.damping;
  t.simulation = std::make_unique<Simulation>(std::move(state.simulation), laws, ranks);
}

StageRecord BiaxialTest::plan() const {
  Simulation const& s = *state_->simulation;
  StageRecord plan;
  plan["discs"] = s.discs();
  plan["time_step_s"] = s.time_step;
  plan["strain_rate_per_s"] = state_->rate.strain_rate;
  plan["inertial_number"] = state_->rate.inertial_number;
  plan["wave_number"] = state_->rate.wave_number;
  plan["steps"] = std::ceil(state_->scene.test.axial_strain / (state_->rate.strain_rate * s.time_step));
  plan["width_m"] = s.walls().width();
  plan["height_m"] = s.walls().height();
  return plan;
}

}  // namespace clathra
