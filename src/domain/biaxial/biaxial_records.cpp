/// What a running biaxial test says of itself: records, snapshots, events, and its state for checkpoints.
#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "domain/biaxial/biaxial_state.hpp"
#include "domain/measurement/history_row.hpp"
#include "domain/measurement/snapshot.hpp"
#include "domain/scene/hydrate_loss.hpp"
#include "domain/scene/phase_boundary.hpp"
#include "domain/simulation/break_event.hpp"
#include "kernels/bond_law.hpp"

namespace clathra {

Snapshot BiaxialTest::snapshot() const {
  Simulation const& s = *state_->simulation;
  Snapshot snapshot = take_snapshot(s);
  snapshot.stage = state_->stage;
  snapshot.step = s.assembly().steps() - state_->first_step;
  snapshot.time = s.assembly().time() - state_->start_time;
  snapshot.path = state_->path();
  snapshot.eps1 = state_->eps1();
  snapshot.eps_v = state_->eps_v();
  snapshot.d50 = state_->d50;
  return snapshot;
}

HistoryRow BiaxialTest::State::row(Measures const& m, double strain_rate) const {
  Assembly const& a = simulation->assembly();
  WallStress const stress = a.stress();
  HistoryRow row;
  row.stage = stage;
  row.step = a.steps() - first_step;
  row.time_s = a.time() - start_time;
  row.eps1 = eps1();
  row.eps_v = eps_v();
  row.sigma1_Pa = stress.y;
  row.sigma3_Pa = stress.x;
  row.q_Pa = stress.y - stress.x;
  row.p_Pa = 0.5 * (stress.y + stress.x);
  row.contact_sigma1_Pa = m.stress_area_yy / a.area();
  row.contact_sigma3_Pa = m.stress_area_xx / a.area();
  row.void_ratio = a.void_ratio();
  row.bonds_intact = std::llround(m.bonded);
  row.bonds_intact_pct = bonds0 > 0 ? 100.0 * m.bonded / static_cast<double>(bonds0) : 0;
  row.bonded_contacts_pct = m.interacting > 0 ? 100.0 * m.bonded / m.interacting : 0;
  row.broken = a.break_counts();
  row.coordination = 2 * m.interacting / a.discs();
  row.mechanical_coordination = m.mechanical_coordination();
  row.inertial_number = strain_rate * d50 * std::sqrt(a.facts.moving_density() / std::max(row.sigma3_Pa, 1.0));
  row.platen_wave_stress =
      platen_wave_stress(scene, strain_rate, a.walls().height(), row.void_ratio, scene.grains.density * (1 + a.facts.added_mass));
  row.unbalanced = m.unbalanced_ratio(a.discs());
  row.temperature = hydrate.temperature;
  row.pore_pressure = hydrate.pore_pressure;
  row.saturation_pct = 100 * hydrate.saturation;
  row.boundary_K = equilibrium_temperature(hydrate.pore_pressure, scene.hydrate.salinity) - hydrate.temperature;
  row.boundary_Pa = hydrate.pore_pressure - equilibrium_pressure(hydrate.temperature, scene.hydrate.salinity);
  LargestDeviator const& largest = a.now.walls.largest;
  bool const between = largest.q > row.q_Pa;
  row.largest_q_Pa = between ? largest.q : row.q_Pa;
  row.largest_q_eps1 = between ? std::log(height0 / largest.height) : row.eps1;
  return row;
}

/// Of the stage where it has one, else of the faster pair of walls on the average since the row before [1/s].
double BiaxialTest::State::rate_of_row() const {
  if (place.sense != 0) return rate.strain_rate;
  TestValues const v = values();
  if (!(v.time > last_row.time)) return 0;
  double const vertical = v.eps1 - last_row.eps1, lateral = v.eps_v - last_row.eps_v - vertical;
  return std::max(std::abs(vertical), std::abs(lateral)) / (v.time - last_row.time);
}

HistoryRow BiaxialTest::record() {
  State& t = *state_;
  HistoryRow row = t.row(t.measures(), t.rate_of_row());
  t.last_row = t.values();
  row.dilation_deg = t.dilation.largest();
  t.simulation->watch_deviator();
  t.dilation.begin_record();
  return row;
}

EnergyRow BiaxialTest::energy() { return state_->energy(); }

EnergyRow BiaxialTest::State::energy() {
  Simulation const& s = *simulation;
  Measures const& m = measures();
  DissipationTotals const lost = s.assembly().losses();
  EnergyRow row;
  row.boundary_work = s.assembly().boundary_work() + work_of_turns;
  row.kinetic = m.kinetic;
  row.grain_elastic = m.grain_energy;
  row.bond_elastic = m.bond_energy;
  row.wall_elastic = m.wall_energy;
  row.sliding = lost.sliding;
  row.rolling = lost.rolling;
  row.dashpot = lost.dashpot;
  row.damping = lost.damping;
  row.breakage = lost.breakage;
  row.dissolved = dissolved;
  double const stored = row.kinetic + row.grain_elastic + row.bond_elastic + row.wall_elastic;
  double const stored_at_start = start.kinetic + start.grain_elastic + start.bond_elastic + start.wall_elastic;
  row.residual = row.boundary_work - (stored - stored_at_start) -
                 (row.sliding + row.rolling + row.dashpot + row.damping + row.breakage + row.dissolved);
  return row;
}

BreakEvents BiaxialTest::take_events() {
  BreakEvents events = state_->simulation->assembly().detailed_break_events(state_->events_taken);
  state_->events_taken += static_cast<int>(events.rows.size());
  for (BreakEvent& event : events.rows) event.step -= state_->first_step;
  return gathered(state_->ranks, std::move(events));
}

BreakEvents BiaxialTest::events_after(std::int64_t step) const {
  BreakEvents all = state_->simulation->assembly().detailed_break_events(0), later;
  later.detailed = all.detailed;
  std::vector<BreakEvent> const pending = state_->simulation->assembly().break_events(state_->events_taken);
  for (std::size_t k = 0; k < all.rows.size(); ++k) {
    BreakEvent& event = all.rows[k];
    if (!pending.empty() && !comes_before(event, pending.front())) break;
    event.step -= state_->first_step;
    if (event.step > step) later.add(all, k);
  }
  return gathered(state_->ranks, std::move(later));
}

template <class Visit>
void BiaxialTest::State::for_each_number(Visit&& visit) {
  visit("d50", d50);
  visit("height0", height0);
  visit("area0", area0);
  visit("bonds0", bonds0);
  visit("records_due", records_due);
  visit("record_interval", record_interval);
  visit("first_step", first_step);
  visit("start_time", start_time);
  visit("began_quasi_static", began_quasi_static);
  visit("disc_steps", disc_steps);
  visit("strain_rate", rate.strain_rate);
  visit("inertial_number", rate.inertial_number);
  visit("platen_wave_stress", rate.platen_wave_stress);
  for_each_energy_column(start, [&](std::string const& name, double& value) { visit("start_" + name, value); });
  visit("work_of_turns", work_of_turns);
  hydrate.for_each_number("hydrate", visit);
  visit("dissolved", dissolved);
  consolidation.for_each_number(visit);
  place.for_each_number(visit);
  last_row.for_each_number("last_row", visit);
  watch.for_each_number(visit);
  dilation.for_each_number(visit);
}

TestState BiaxialTest::state() const {
  State& t = *state_;
  TestState s;
  s.simulation = t.simulation->state();
  s.events_taken = static_cast<std::size_t>(t.events_taken);
  s.hash = t.simulation->assembly().hash();
  t.for_each_number([&](std::string const& name, auto const& value) { s.numbers[name] = static_cast<double>(value); });
  s.done = t.done;
  s.preparation = t.preparation;
  s.warnings = t.warnings;
  return s;
}

BiaxialTest::BiaxialTest(Scene const& scene, TestState state, Ranks const& ranks) : state_(std::make_unique<State>()) {
  State& t = *state_;
  t.scene = scene;
  t.stages = stages_of(scene);
  t.ranks = ranks;
  t.for_each_number(
      [&](std::string const& name, auto& value) { value = static_cast<std::decay_t<decltype(value)>>(state.numbers.at(name)); });
  t.preparation = state.preparation;
  t.warnings = state.warnings;
  t.events_taken = static_cast<int>(state.events_taken);
  SimulationLaws laws = test_laws(scene, t.d50, state.simulation.numbers.at("critical_thickness"));
  if (t.consolidation.over) laws.motion.damping = scene.damping.local;
  if (changes_hydrate(t.stages) && laws.contact.bond_kind != BondKind::none)
    laws.contact.bond = changed_bond_law(scene, t.d50, laws.contact.bond, t.hydrate_scene(t.hydrate));
  t.simulation = std::make_unique<Simulation>(std::move(state.simulation), laws, ranks);
  t.done = state.done;
  t.stage = t.consolidation.over ? t.now().name : t.consolidation.bonded ? hydrate_consolidation_stage : consolidation_stage;
  if (!t.place.over || t.end_reached()) return;
  t.place.over = false;  // it is to go on further than it was
  t.done.pop_back();
}

StageRecord BiaxialTest::plan() const {
  Simulation const& s = *state_->simulation;
  StageRecord plan;
  plan["particles"] = s.assembly().discs();
  plan["time_step_s"] = s.time_step;
  plan["strain_rate_per_s"] = state_->rate.strain_rate;
  plan["inertial_number"] = state_->rate.inertial_number;
  plan["platen_wave_stress"] = state_->rate.platen_wave_stress;
  plan["steps"] = planned_steps(state_->scene, state_->rate.strain_rate, s.time_step);
  plan["width_m"] = s.assembly().walls().width();
  plan["height_m"] = s.assembly().walls().height();
  return plan;
}

}  // namespace clathra
