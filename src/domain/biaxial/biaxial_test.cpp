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
#include "domain/measurement/disc_grading.hpp"
#include "domain/measurement/history_row.hpp"
#include "domain/measurement/snapshot.hpp"
#include "domain/parallel/ranks.hpp"
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

BiaxialTest::BiaxialTest() : state_(std::make_unique<State>()) {}

BiaxialTest BiaxialTest::to_consolidate(Scene const& scene, Specimen specimen, Ranks const& ranks) {
  BiaxialTest test;
  State& t = *test.state_;
  t.scene = scene;
  t.stages = stages_of(scene);
  t.ranks = ranks;
  if (!(specimen.d50 > 0)) specimen.d50 = diameter_finer(specimen.radius, 0.5, ranks);
  t.d50 = specimen.d50;
  for (LoadingStage const& stage : t.stages)  // before the work
    (void)check_rate(scene, rate_numbers(scene, stage, t.d50, specimen.height(), specimen.void_ratio));
  with_snapshot_of_divergence(t.simulation, t.d50, [&] { t.prepare(std::move(specimen)); });
  return test;
}

BiaxialTest::BiaxialTest(Scene const& scene, Specimen specimen, ProgressCallback const& progress, Ranks const& ranks)
    : BiaxialTest(to_consolidate(scene, std::move(specimen), ranks)) {
  constexpr std::int64_t steps_between_reports = 2000;
  std::vector<HistoryRow>& rows = state_->consolidation_rows;
  rows.push_back(record());
  while (consolidates()) {
    if (advance(steps_between_reports) && consolidates()) rows.push_back(record());
    if (consolidates()) report(progress, consolidation_progress());
  }
}

BiaxialTest::BiaxialTest(BiaxialTest&& other) noexcept = default;
BiaxialTest::~BiaxialTest() = default;

StageRecord const& BiaxialTest::preparation() const { return state_->preparation; }
std::vector<std::string> const& BiaxialTest::warnings() const { return state_->warnings; }
std::vector<HistoryRow> const& BiaxialTest::consolidation() const { return state_->consolidation_rows; }
bool BiaxialTest::consolidates() const { return !state_->consolidation.over; }
Progress BiaxialTest::consolidation_progress() const { return state_->consolidation_progress(); }
bool BiaxialTest::finished() const { return state_->place.over && state_->is_last(); }
double BiaxialTest::axial_strain() const { return state_->eps1(); }
double BiaxialTest::path() const { return state_->path(); }
double BiaxialTest::path_of_last_record() const { return state_->last_row.path; }
double BiaxialTest::fraction() const { return state_->fraction(); }
LoadingStage const& BiaxialTest::stage() const { return state_->now(); }
std::int64_t BiaxialTest::disc_steps() const {
  return state_->disc_steps + state_->simulation->assembly().steps() * state_->simulation->assembly().discs();
}
std::int64_t BiaxialTest::loading_disc_steps() const {
  if (consolidates()) return 0;
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
  return with_snapshot_of_divergence(state_->simulation, state_->d50, [&] {
    return consolidates() ? state_->consolidate(most_steps) : state_->advance(most_steps, pause_at);
  });
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

}  // namespace clathra
