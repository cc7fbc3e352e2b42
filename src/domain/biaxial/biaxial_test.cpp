#include "domain/biaxial/biaxial_test.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <type_traits>
#include <utility>

#include "domain/biaxial/biaxial_state.hpp"
#include "domain/biaxial/divergence.hpp"
#include "domain/biaxial/quasi_static.hpp"
#include "domain/biaxial/shear_watch.hpp"
#include "domain/generation/bonding.hpp"
#include "domain/measurement/disc_grading.hpp"
#include "domain/measurement/history_row.hpp"
#include "domain/measurement/snapshot.hpp"
#include "domain/parallel/ranks.hpp"
#include "domain/parallel/redistribution.hpp"
#include "domain/scene/hydrate.hpp"
#include "domain/scene/scene.hpp"
#include "domain/scene/scene_laws.hpp"
#include "domain/scene/short_number.hpp"
#include "domain/scene/specimen.hpp"
#include "domain/scene/stage.hpp"
#include "domain/simulation/break_event.hpp"
#include "domain/simulation/simulation.hpp"

namespace clathra {

namespace {

/// Cap on the speed of the servo walls over that of a platen. A brittle specimen that fails widens ten times as fast as the
/// platens close it; at 4 such walls let sigma_3 rise by 70 % over a burst of breaking bonds.
constexpr double largest_lateral_speed = 40;

std::string overshoot_text(double reached, double wanted) {
  char text[160];
  std::snprintf(
      text, sizeof text,
      "the test ends at an axial strain of %.4g %%, %.4g %% was asked for: a single step strains it that far, lower the "
      "rate",
      100 * reached, 100 * wanted);
  return text;
}

constexpr double elastic_lateral_ratio = 0.25;  // lateral expansion per axial compression at the start: the servo's first guess

BondKind bond_kind(Scene const& scene) {
  return scene.bond.contact_coupling == ContactCoupling::parallel ? BondKind::parallel : BondKind::replace;
}

}  // namespace

SimulationLaws test_laws(Scene const& scene, double d50, double h_max) {
  SimulationLaws laws;
  laws.precision = scene.run.precision;
  laws.contact.grain = grain_law(scene);
  if (h_max > 0) {
    laws.contact.bond_kind = bond_kind(scene);
    laws.contact.bond = make_bond_law(scene, d50, h_max);
  }
  laws.wall = wall_law(scene, scene.test.wall_friction);
  laws.motion.damping = 0.7;
  return laws;
}

double BiaxialTest::State::skin(std::vector<double> const& radii) const {
  double largest_negative = -HUGE_VAL;
  for (double const r : radii) largest_negative = std::max(largest_negative, -r);
  double const smallest = -2 * ranks.max(largest_negative);
  return scene.run.verlet_skin > 0 ? scene.run.verlet_skin : usual_skin(d50, smallest);
}

/// Bonds first and consolidates then, or the other way round (`bond.after_consolidation`).
void BiaxialTest::State::bond_and_consolidate(Specimen specimen, ProgressCallback const& progress) {
  bool const bond = has_bonds(scene) && specimen.critical_thickness == 0;
  double const made_under = specimen.stress;
  if (bond && !scene.bond.after_consolidation) {
    // Bonds reach across ranks: discs must first be where they belong.
    specimen = by_place(ranks, std::move(specimen));
    bond_specimen(scene, specimen, preparation, ranks);
  }
  auto const start_simulation = [&] {
    SimulationLaws laws = test_laws(scene, specimen.d50, specimen.critical_thickness);
    laws.scaling = mass_scaling(specimen.radius);
    double const skin = this->skin(specimen.radius);
    simulation = std::make_unique<Simulation>(std::exchange(specimen, {}), laws, skin, ranks);
    simulation->keep_breaks(scene.output.events || scene.output.takes_snapshots() ? BreakRecord::events : BreakRecord::counts);
  };
  start_simulation();
  preparation["void_ratio_before_consolidation"] = simulation->assembly().void_ratio();
  consolidate(consolidation_stage, progress);
  if (bond && scene.bond.after_consolidation) {
    count_disc_steps();
    specimen = simulation->specimen();
    simulation.reset();
    bond_specimen(scene, specimen, preparation, ranks);
    start_simulation();
    double const before = simulation->assembly().void_ratio();
    consolidate(hydrate_consolidation_stage, progress);
    if (before - simulation->assembly().void_ratio() > 0.003 && !scene.run.ignore_guards) {
      throw Refused("bonding after consolidation with this bond.contact_coupling lets the void ratio drop from " +
                    std::to_string(before) + " to " + std::to_string(simulation->assembly().void_ratio()) +
                    ": bond at low stress, or use \"parallel\" or \"replaces_keeping_force\"");
    }
  }
  preparation["void_ratio_after_consolidation"] = simulation->assembly().void_ratio();
  warn_of_density(preparation.at("void_ratio_before_consolidation"), made_under);
  Measures const m = simulation->assembly().measures();
  require_grains(m.touching > 0 ? m.deep / m.touching : 0);
}

std::string BiaxialTest::State::text_of_scaling() const {
  char text[160];
  std::snprintf(text, sizeof text, "masses are scaled: %.3g %% of the mass of all grains added, moments of inertia times %g",
                100 * simulation->assembly().facts.added_mass, scene.run.rotational_inertia_factor);
  return text;
}

/// @param radii  of this rank's discs [m]
MassScaling BiaxialTest::State::mass_scaling(std::vector<double> const& radii) const {
  MassScaling scaling;
  scaling.inertia = scene.run.rotational_inertia_factor;
  if (scene.run.mass_scaled_fraction > 0) scaling.least_radius = radius_above(radii, scene.run.mass_scaled_fraction, ranks);
  return scaling;
}

/// Sets platens, discs and servo in motion together, so that the shear starts without a wave, and opens the accounts.
void BiaxialTest::State::begin_shear() {
  Simulation& s = *simulation;
  SimulationLaws laws = s.assembly().laws;
  laws.motion.damping = scene.damping.local;
  s.set_laws(laws);
  s.choose_time_step(scene.run.step_choice());
  double const frequency = s.assembly().largest_frequency();
  preparation["time_step_s"] = s.time_step;
  double const damped = 2 / std::sqrt(1 + scene.damping.local);
  preparation["time_step_margin"] = frequency > 0 ? damped / frequency / s.time_step : 0;
  preparation["time_step_limit_s"] = s.assembly().stable_limit();
  preparation["added_mass_share"] = s.assembly().facts.added_mass;
  begin_stage(shear_stage);
  rate = rate_numbers(scene, d50, height0, s.assembly().void_ratio(), s.assembly().facts.added_mass);
  for (std::string const& warning : check_rate(scene, rate)) warnings.push_back(warning);
  if (scene.run.scales_masses_further()) warnings.push_back(text_of_scaling());
  AxisDrive lateral = AxisDrive::at_stress(scene.test.confining_stress, largest_lateral_speed * 0.5 * rate.strain_rate * height0);
  lateral.integral = -0.5 * elastic_lateral_ratio * rate.strain_rate * s.assembly().walls().width();
  s.drive(lateral, AxisDrive::at_rate(rate.strain_rate), -elastic_lateral_ratio * rate.strain_rate, rate.strain_rate);
  if (scene.output.energy) s.set_ledger(true);
  record_interval = scene.test.axial_strain / scene.output.records;
  if (scene.output.takes_event_details() && has_bonds(scene)) s.keep_breaks(BreakRecord::details);
  events_taken = static_cast<int>(s.assembly().break_events(0).size());
  int const broken = s.assembly().broken_bonds();
  if (scene.output.takes_snapshots()) s.mark_start();
  s.watch_deviator();
  preparation["broken_in_consolidation"] = broken;
  constexpr double many = 0.2;
  if (broken > many * static_cast<double>(bonds0))
    warnings.push_back(short_number(100.0 * broken / static_cast<double>(bonds0)) +
                       " % of the bonds broke before the test: the specimen is no longer the one that was bonded");
  preparation["bytes_per_particle"] = static_cast<double>(ranks.sum(static_cast<std::int64_t>(s.bytes()))) / s.assembly().discs();
  preparation["strain_rate_per_s"] = rate.strain_rate;
  if (rate.share < 1) preparation["rate_share"] = rate.share;
  began_quasi_static = at_rest && is_quasi_static(scene, rate);
  preparation["quasi_static"] = began_quasi_static ? 1 : 0;
}

BiaxialTest::BiaxialTest(Scene const& scene, Specimen specimen, ProgressCallback const& progress, Ranks const& ranks)
    : state_(std::make_unique<State>()) {
  State& t = *state_;
  t.scene = scene;
  t.ranks = ranks;
  if (!(specimen.d50 > 0)) specimen.d50 = diameter_finer(specimen.radius, 0.5, ranks);
  t.d50 = specimen.d50;
  (void)check_rate(scene, rate_numbers(scene, t.d50, specimen.height(), specimen.void_ratio));  // before the work
  with_snapshot_of_divergence(t.simulation, t.d50, [&] { t.bond_and_consolidate(std::move(specimen), progress); });
  t.begin_shear();
  if (scene.output.energy) t.start = energy();
}

BiaxialTest::BiaxialTest(BiaxialTest&& other) noexcept = default;
BiaxialTest::~BiaxialTest() = default;

StageRecord const& BiaxialTest::preparation() const { return state_->preparation; }
std::vector<std::string> const& BiaxialTest::warnings() const { return state_->warnings; }
std::vector<HistoryRow> const& BiaxialTest::consolidation() const { return state_->consolidation; }
bool BiaxialTest::finished() const { return strain_fraction() >= 1 - 1e-9; }
double BiaxialTest::axial_strain() const { return state_->eps1(); }
double BiaxialTest::strain_fraction() const { return state_->eps1() / state_->scene.test.axial_strain; }
std::int64_t BiaxialTest::disc_steps() const {
  return state_->disc_steps + state_->simulation->assembly().steps() * state_->simulation->assembly().discs();
}
std::int64_t BiaxialTest::shear_disc_steps() const {
  return (state_->simulation->assembly().steps() - state_->first_step) * state_->simulation->assembly().discs();
}
double BiaxialTest::search_seconds() const { return state_->simulation->assembly().upkeep.seconds(); }
std::uint64_t BiaxialTest::state_hash() const { return state_->simulation->assembly().hash(); }

Specimen BiaxialTest::specimen() const {
  Specimen specimen = state_->simulation->specimen();
  specimen.stress = state_->scene.test.confining_stress;
  return specimen;
}

bool BiaxialTest::advance(std::int64_t most_steps, double pause_at) {
  return with_snapshot_of_divergence(state_->simulation, state_->d50, [&] { return advance_unobserved(most_steps, pause_at); });
}

bool BiaxialTest::advance_unobserved(std::int64_t most_steps, double pause_at) {
  Simulation& s = *state_->simulation;
  for (std::int64_t const last = s.assembly().steps() + most_steps; s.assembly().steps() < last;) {
    s.step(last - s.assembly().steps(), state_->height_of_next_look(pause_at));
    if (state_->watch.due(state_->eps1())) state_->check();
    bool const due = state_->record_is_due() || finished();
    if (!due && state_->eps1() >= pause_at) {
      s.assembly().throw_if_unstable();
      return false;
    }
    if (!due) continue;
    ++state_->records_due;
    s.assembly().throw_if_unstable();
    return true;
  }
  return false;
}

Measures const& BiaxialTest::State::measures() {
  if (measured_after != simulation->assembly().steps()) measured = simulation->assembly().measures();
  measured_after = simulation->assembly().steps();
  return measured;
}

/// A specimen whose grains have mostly moved into each other is none: such a test ends.
void BiaxialTest::State::require_grains(double deep_share) const {
  if (scene.run.ignore_guards) return;
  if (std::string const problem = collapse(simulation->assembly().void_ratio(), deep_share); !problem.empty())
    throw Refused(problem + ": the grains are too soft for this stress, raise grains.normal_stiffness" + ignore_hint);
}

/// Masses scaled further than usual must not carry the loads that contacts should: such a test ends.
void BiaxialTest::State::check() {
  ShearCheck const seen = look_at_shear(*simulation, measures(), eps1());
  watch.add(seen);
  dilation.check(eps1(), eps_v());
  bool const is_sand = collapse(simulation->assembly().void_ratio(), seen.deep_share).empty();
  preparation["quasi_static"] = began_quasi_static && is_sand && watch.balanced(bonds0 > 0) ? 1 : 0;
  require_grains(seen.deep_share);
  if (!scene.run.scales_masses_further() || watch.is_slow(scene.test.axial_strain) || scene.run.ignore_guards) return;
  throw Refused(watch.of_kinetic_energy() +
                "; scale less (run.rotational_inertia_factor, run.mass_scaled_fraction) or shear slower");
}

std::vector<std::string> BiaxialTest::shear_warnings() const {
  State const& t = *state_;
  std::vector<std::string> warnings = t.watch.warnings(t.bonds0 > 0, t.preparation.at("at_rest") == 1);
  if (std::string const soft = stiffness_warning_at(t.scene, t.watch.largest_sigma1()); !soft.empty()) warnings.push_back(soft);
  if (std::string const problem = collapse(t.simulation->assembly().void_ratio(), 0);
      t.scene.run.ignore_guards && !problem.empty())
    warnings.push_back(guard_ignored + problem);
  constexpr double said = 1.01;  // of the strain that was asked for
  if (finished() && strain_fraction() > said) warnings.push_back(overshoot_text(t.eps1(), t.scene.test.axial_strain));
  return warnings;
}

StageRecord BiaxialTest::shear_checks() const {
  StageRecord checks = state_->watch.record();
  checks["time_step_renewals"] = static_cast<double>(state_->simulation->time_steps().updates());
  return checks;
}

}  // namespace clathra
