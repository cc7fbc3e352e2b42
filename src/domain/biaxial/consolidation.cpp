/// The stages of a test before the shear: the confining stress is put on, and held until the specimen rests.
#include <algorithm>
#include <cmath>

#include "domain/biaxial/biaxial_state.hpp"
#include "domain/generation/equilibration.hpp"
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

}  // namespace

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

/// A row of consolidation() where one is due. Its I and W are those of the faster pair of walls on the average since the row
/// before.
void BiaxialTest::State::record_consolidation(bool anyway) {
  bool const first = consolidation.empty() || consolidation.back().stage != stage;
  double fastest = 0;
  if (!first) {
    HistoryRow const& last = consolidation.back();
    double const time = simulation->assembly().time() - start_time - last.time_s;
    bool const due = std::abs(mean_stress(*simulation) - last.p_Pa) > stress_of_row * scene.test.confining_stress;
    if (time <= 0 || (!due && !anyway)) return;
    double const vertical = eps1() - last.eps1, lateral = eps_v() - last.eps_v - vertical;
    fastest = std::max(std::abs(vertical), std::abs(lateral)) / time;
  }
  consolidation.push_back(row(simulation->assembly().measures(), fastest));
  simulation->watch_deviator();
}

/// Compresses homogeneously, discs and walls together, to near the stress, in `most_steps` at most.
void BiaxialTest::State::approach(double stress, double closing_rate, std::int64_t most_steps, ProgressCallback const& progress) {
  Simulation& s = *simulation;
  AxisDrive const servo_x = s.loading().x, servo_y = s.loading().y;
  s.drive(AxisDrive::at_rate(closing_rate), AxisDrive::at_rate(closing_rate), closing_rate, closing_rate);
  while (mean_stress(s) < 0.98 * stress && s.assembly().steps() < most_steps) {
    s.step(std::min<std::int64_t>(20, most_steps - s.assembly().steps()));
    record_consolidation(false);
    if (s.assembly().steps() % 2000 == 0)
      report(progress,
             {"consolidate", 0.5 * mean_stress(s) / stress, "compressing", s.assembly().steps() * s.assembly().discs()});
  }
  s.drive(servo_x, servo_y, -closing_rate, -closing_rate);
}

/// Puts the stress on, and lets the servo walls hold it until the specimen rests.
void BiaxialTest::State::consolidate(char const* stage_name, ProgressCallback const& progress) {
  constexpr double inertial_number = 2e-4;
  double const stress = scene.test.confining_stress;
  Simulation& s = *simulation;
  count_from_here(stage_name);
  record_consolidation(true);
  prepare_servo(s, stress, inertial_number, d50, scene.run.step_choice());
  double const closing_rate = strain_rate_of(inertial_number, stress, s.assembly().facts.moving_density(), d50);
  std::int64_t const budget = scene.test.consolidation_steps;
  if (mean_stress(s) < 0.95 * stress)
    approach(stress, closing_rate, std::min(budget, static_cast<std::int64_t>(0.1 / (closing_rate * s.time_step))), progress);
  auto const recording = [&](Progress const& now) {
    record_consolidation(false);
    return !progress || progress(now);
  };
  at_rest = hold_stress(s, stress, rest_before_shear, budget - s.assembly().steps(), recording, "consolidate");
  record_consolidation(true);
  preparation["consolidation_steps"] = static_cast<double>(s.assembly().steps());
  preparation["consolidated_unbalanced"] = s.assembly().measures().unbalanced_ratio(s.assembly().discs());
  preparation["at_rest"] = at_rest ? 1 : 0;
  if (!at_rest) require_rest(budget);
}

/// The specimen did not come to rest: refused, unless guards are ignored.
void BiaxialTest::State::require_rest(std::int64_t steps) {
  std::string const why = unrest(*simulation, simulation->assembly().measures(), scene.test.confining_stress, rest_before_shear);
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
