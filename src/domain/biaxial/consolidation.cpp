/// The stages of a test before its loading: the confining stress is put on, and held until the specimen rests.
#include <algorithm>
#include <cmath>

#include "domain/biaxial/biaxial_state.hpp"
#include "domain/generation/bonding.hpp"
#include "domain/generation/equilibration.hpp"
#include "domain/parallel/redistribution.hpp"
#include "domain/scene/hydrate.hpp"
#include "domain/scene/scene_laws.hpp"
#include "domain/scene/short_number.hpp"

namespace clathra {

namespace {

/// So that the first row of a shear shows no deviator. Small specimens come to it with the rest; a million of clean sand rested
/// with its walls 0.34 % of sigma_3 apart.
constexpr RestCriterion rest_before_shear{1e-3, 1e-3};

/// Of the confining stress, that the mean stress changes by between two rows.
constexpr double stress_of_row = 0.01;

constexpr std::int64_t steps_of_closing = 20;  // between two looks at the stress

}  // namespace

/// Bonds first, and consolidates then; or the other way round (`bond.after_consolidation`).
void BiaxialTest::State::prepare(Specimen specimen) {
  if (forms_hydrate(stages) && specimen.critical_thickness > 0)
    throw Refused("hydrate is to form in a stage, and the specimen has bonds already");
  bool const bond = has_bonds(scene) && specimen.critical_thickness == 0 && !forms_hydrate(stages);
  consolidation.bonds_after = bond && scene.bond.after_consolidation;
  consolidation.made_under = specimen.stress;
  bool const bonds_first = bond && !scene.bond.after_consolidation, bonded = bonds_first || specimen.critical_thickness > 0;
  hydrate = {scene.hydrate.temperature, scene.hydrate.pore_pressure, bonded ? scene.hydrate.saturation : 0};
  if (bonds_first) {
    // Bonds reach across ranks: discs must first be where they belong.
    specimen = by_place(ranks, std::move(specimen));
    bond_specimen(scene, specimen, preparation, ranks);
  }
  start_simulation(std::move(specimen));
  preparation["void_ratio_before_consolidation"] = simulation->assembly().void_ratio();
  begin_consolidation(consolidation_stage);
}

void BiaxialTest::State::start_simulation(Specimen specimen) {
  SimulationLaws laws = test_laws(scene, specimen.d50, specimen.critical_thickness);
  laws.scaling = mass_scaling(specimen.radius);
  double const skin = this->skin(specimen.radius);
  simulation = std::make_unique<Simulation>(std::exchange(specimen, {}), laws, skin, ranks);
  simulation->keep_breaks(scene.output.events || scene.output.takes_snapshots() ? BreakRecord::events : BreakRecord::counts);
  measured_after = -1;
}

/// Rows count steps, time and strains from here.
void BiaxialTest::State::count_from_here(char const* stage_name) {
  Assembly const& a = simulation->assembly();
  stage = stage_name;
  height0 = a.walls().height();
  area0 = a.area();
  first_step = a.steps();
  start_time = a.time();
  bonds0 = std::llround(a.measures().bonded) + a.broken_bonds();
}

/// Discs and walls close together until the stress is near; then servo walls put it on.
void BiaxialTest::State::begin_consolidation(char const* stage_name) {
  constexpr double inertial_number = 2e-4, longest_closing = 0.1, near = 0.95;
  count_from_here(stage_name);
  Simulation& s = *simulation;
  last_row = {0, 0, 0, 0, s.assembly().stress().y, s.assembly().stress().x};
  Consolidation& c = consolidation;
  double const stress = scene.test.confining_stress;
  c.void_ratio = s.assembly().void_ratio();
  c.ended = false;
  prepare_servo(s, stress, inertial_number, d50, scene.run.step_choice());
  c.closing_rate = strain_rate_of(inertial_number, stress, s.assembly().facts.moving_density(), d50);
  c.servo_speed_x = s.loading().x.largest_speed;
  c.servo_speed_y = s.loading().y.largest_speed;
  c.closing_steps = std::min<std::int64_t>(scene.test.consolidation_steps,
                                           static_cast<std::int64_t>(longest_closing / (c.closing_rate * s.time_step)));
  c.closing = mean_stress(s) < near * stress && c.closing_steps > 0;
  c.rest = {s.assembly().steps()};
  if (c.closing) s.drive(AxisDrive::at_rate(c.closing_rate), AxisDrive::at_rate(c.closing_rate), c.closing_rate, c.closing_rate);
}

void BiaxialTest::State::end_closing() {
  Consolidation& c = consolidation;
  double const stress = scene.test.confining_stress;
  c.closing = false;
  c.rest = {simulation->assembly().steps()};
  simulation->drive(AxisDrive::at_stress(stress, c.servo_speed_x), AxisDrive::at_stress(stress, c.servo_speed_y), -c.closing_rate,
                    -c.closing_rate);
}

bool BiaxialTest::State::consolidation_row_is_due() const {
  return std::abs(mean_stress(*simulation) - last_row.p()) > stress_of_row * scene.test.confining_stress;
}

/// Makes at most so many steps. What is looked at, and when, does not depend on how many. @return whether a row is due
bool BiaxialTest::State::consolidate(std::int64_t most_steps) {
  Consolidation& c = consolidation;
  if (c.ended) {
    end_consolidation();
    return true;
  }
  Simulation& s = *simulation;
  auto const done = [&] { return s.assembly().steps() - first_step; };
  for (std::int64_t const last = s.assembly().steps() + most_steps; s.assembly().steps() < last && !c.ended;) {
    std::int64_t const left = last - s.assembly().steps();
    if (c.closing) {
      std::int64_t const to_look = std::min(steps_of_closing - done() % steps_of_closing, c.closing_steps - done());
      s.step(std::min(left, to_look));
      if (left < to_look) return false;
      bool const due = consolidation_row_is_due();
      if (done() >= c.closing_steps || mean_stress(s) >= 0.98 * scene.test.confining_stress) end_closing();
      if (due) return true;
      continue;
    }
    std::int64_t const to_end = scene.test.consolidation_steps - done(),
                       to_look = std::min(c.rest.steps_to_look(s), std::max<std::int64_t>(to_end, 0));
    s.step(std::min(left, to_look));
    if (left < to_look) return false;
    if (to_look > 0) c.rest.look(s, measures(), scene.test.confining_stress, rest_before_shear);
    if (c.rest.rests || done() >= scene.test.consolidation_steps) come_to_rest();
    if (c.ended || consolidation_row_is_due()) return true;
  }
  return false;
}

/// The part of the consolidation is over. @throws Refused where the specimen does not rest
void BiaxialTest::State::come_to_rest() {
  Assembly const& a = simulation->assembly();
  consolidation.ended = true;
  preparation["consolidation_steps"] = static_cast<double>(a.steps());
  preparation["consolidated_unbalanced"] = a.measures().unbalanced_ratio(a.discs());
  preparation["at_rest"] = consolidation.rest.rests ? 1 : 0;
  if (!consolidation.rest.rests) require_rest(scene.test.consolidation_steps);
}

/// Hydrate forms, where it does so now, and the consolidation goes on; or the loading begins.
void BiaxialTest::State::end_consolidation() {
  Consolidation& c = consolidation;
  if (std::exchange(c.bonds_after, false)) {
    count_disc_steps();
    Specimen specimen = simulation->specimen();
    simulation.reset();
    bond_specimen(scene, specimen, preparation, ranks);
    c.bonded = true;
    hydrate.saturation = scene.hydrate.saturation;
    start_simulation(std::move(specimen));
    return begin_consolidation(hydrate_consolidation_stage);
  }
  double const now = simulation->assembly().void_ratio();
  if (c.bonded && c.void_ratio - now > 0.003 && !scene.run.ignore_guards)
    throw Refused("bonding after consolidation with this bond.contact_coupling lets the void ratio drop from " +
                  std::to_string(c.void_ratio) + " to " + std::to_string(now) +
                  ": bond at low stress, or use \"parallel\" or \"replaces_keeping_force\"");
  preparation["void_ratio_after_consolidation"] = now;
  warn_of_density(preparation.at("void_ratio_before_consolidation"), c.made_under);
  Measures const& m = measures();
  require_grains(m.touching > 0 ? m.deep / m.touching : 0);
  c.over = true;
  begin_loading();
}

Progress BiaxialTest::State::consolidation_progress() const {
  Simulation const& s = *simulation;
  Consolidation const& c = consolidation;
  std::int64_t const done = s.assembly().steps() - first_step;
  double const share = static_cast<double>(done) / std::max(scene.test.consolidation_steps, 1);
  return {"consolidate", c.closing ? 0.5 * mean_stress(s) / scene.test.confining_stress : 0.5 + 0.5 * share,
          c.closing ? "compressing" : RestWatch::text(s), disc_steps + s.assembly().steps() * s.assembly().discs()};
}

/// The specimen did not come to rest: refused, unless guards are ignored.
void BiaxialTest::State::require_rest(std::int64_t steps) {
  std::string const why = unrest(*simulation, measures(), scene.test.confining_stress, rest_before_shear);
  std::string const when = preparation.contains("bonds") ? "after" : "before";
  std::string const text = (has_bonds(scene) ? when + " hydrate formed, " : std::string()) +
                           "consolidation did not come to rest within " + std::to_string(steps) +
                           (steps == 1 ? " step: " : " steps: ") +
                           (why.empty() ? "it rested for fewer than three checks on end" : why);
  if (!scene.run.ignore_guards) throw Refused(text + "; test.consolidation_steps gives it more" + ignore_hint);
  warnings.push_back(text + ": the test is not quasi-static from its beginning");
}

/// A specimen that is packed denser by its consolidation, beyond what is elastic, has no longer the void ratio it was made with.
void BiaxialTest::State::warn_of_density(double before, double made_under) {
  constexpr double plastic = 0.015;
  double const after = simulation->assembly().void_ratio(), elastic = elastic_loss(scene, before, made_under);
  if (before - after <= 1.2 * elastic + plastic) return;
  warnings.push_back("under the confining stress the void ratio fell from " + short_number(before, 4) + " to " +
                     short_number(after, 4) + " (" + short_number(elastic, 2) +
                     " of it elastic): what is tested is denser than what was made");
}

}  // namespace clathra
