#include "domain/scene/loading_stage.hpp"

#include <algorithm>
#include <utility>

#include "domain/scene/scene.hpp"

namespace clathra {

namespace {

/// Loaded at the rate of the test. @param sense  1 closes, -1 opens
SideScene at_rate(TestScene const& test, double sense) {
  SideScene side = SideScene::at_inertial_number(sense * test.inertial_number);
  side.strain_rate = sense * test.strain_rate;
  return side;
}

/// Sheared by its platens to an axial strain.
LoadingStage sheared(TestScene const& test, SideScene const& lateral) {
  LoadingStage stage(shear_stage, at_rate(test, 1), lateral);
  stage.until.axial_strain = test.axial_strain;
  return stage;
}

LoadingStage undrained(TestScene const& test) {
  LoadingStage stage = sheared(test, SideScene::following(Follow::constant_volume));
  stage.lateral.fluid_modulus = test.fluid_modulus;
  return stage;
}

LoadingStage opened(TestScene const& test) {
  LoadingStage stage("extension", at_rate(test, -1), SideScene::at_stress(test.confining_stress));
  stage.until.axial_strain = -test.axial_strain;
  return stage;
}

/// Put on in increments up to test.largest_stress, and taken off again to the confining stress.
std::vector<LoadingStage> compressed(TestScene const& test, bool isotropic) {
  std::vector<LoadingStage> stages;
  auto const add = [&](char const* name, double stress) {
    LoadingStage stage(name, SideScene::at_stress(stress), isotropic ? SideScene::at_stress(stress) : SideScene::held());
    stage.increments = test.increments;
    stage.until.rest = true;
    stages.push_back(stage);
  };
  add("compression", test.largest_stress > 0 ? test.largest_stress : 4 * test.confining_stress);
  add("unloading", test.confining_stress);
  return stages;
}

/// Sheared, at each strain of test.unload_at unloaded to q = 0 and loaded again.
std::vector<LoadingStage> unloaded_and_reloaded(TestScene const& test) {
  std::vector<LoadingStage> stages;
  std::vector<double> const at = test.unload_at.empty() ? std::vector{test.axial_strain / 2} : test.unload_at;
  LoadingStage loading = sheared(test, SideScene::at_stress(test.confining_stress));
  for (std::size_t i = 0; i < at.size(); ++i) {
    loading.until.axial_strain = at[i];
    stages.push_back(loading);
    LoadingStage unloading("unloading " + std::to_string(i + 1), at_rate(test, -1), SideScene::at_stress(test.confining_stress));
    unloading.until.deviator_stress = 0;
    stages.push_back(unloading);
    loading.name = "reloading " + std::to_string(i + 1);
  }
  loading.until.axial_strain = test.axial_strain;
  stages.push_back(loading);
  return stages;
}

LoadingStage cycled(TestScene const& test) {
  LoadingStage stage("cycles", at_rate(test, 1), SideScene::at_stress(test.confining_stress));
  if (test.cyclic_deviator_stress.empty())
    stage.turn.axial_strain = {0, test.axial_strain};
  else
    stage.turn.deviator_stress = test.cyclic_deviator_stress;
  stage.until.cycles = test.cycles;
  stage.until.path = longest_path * test.cycles;
  return stage;
}

LoadingStage loaded_dead(TestScene const& test) {
  LoadingStage stage("dead load", SideScene::at_stress(test.confining_stress + test.dead_load),
                     SideScene::at_stress(test.confining_stress));
  stage.until.rest = true;
  stage.until.axial_strain = test.axial_strain;
  return stage;
}

/// A dead load, and under it hydrate that changes. @param lost  of the effective stresses since the dead load [Pa]
LoadingStage changed(TestScene const& test, char const* name, double lost) {
  LoadingStage stage(name, SideScene::at_stress(test.confining_stress + test.dead_load - lost),
                     SideScene::at_stress(test.confining_stress - lost));
  stage.increments = test.increments;
  stage.until.rest = true;
  stage.until.axial_strain = test.axial_strain;
  return stage;
}

std::vector<LoadingStage> heated(TestScene const& test) {
  LoadingStage stage = changed(test, "heating", 0);
  stage.hydrate.temperature = test.final_temperature;
  stage.hydrate.saturation = test.final_saturation;
  if (test.dead_load > 0) return {loaded_dead(test), stage};
  return {stage};
}

/// At constant total stress; hydrate is lost as the pressure falls, and the pressure comes back.
std::vector<LoadingStage> depressurised(Scene const& scene) {
  TestScene const& test = scene.test;
  LoadingStage down = changed(test, "depressurisation", 0),
               up = changed(test, "repressurisation", test.final_pore_pressure - scene.hydrate.pore_pressure);
  down.hydrate.pore_pressure = test.final_pore_pressure;
  down.hydrate.saturation = test.final_saturation;
  up.hydrate.pore_pressure = scene.hydrate.pore_pressure;
  down.hydrate.constant_total_stress = up.hydrate.constant_total_stress = true;
  if (test.dead_load > 0) return {loaded_dead(test), down, up};
  return {down, up};
}

}  // namespace

std::vector<LoadingStage> stages_of(Scene const& scene) {
  TestScene const& test = scene.test;
  switch (test.kind) {
    case TestKind::biaxial:
      return {sheared(test, SideScene::at_stress(test.confining_stress))};
    case TestKind::extension:
      return {opened(test)};
    case TestKind::constant_volume:
      return {undrained(test)};
    case TestKind::constant_mean_stress:
      return {sheared(test, SideScene::following(Follow::constant_mean_stress))};
    case TestKind::isotropic:
    case TestKind::oedometer:
      return compressed(test, test.kind == TestKind::isotropic);
    case TestKind::unload_reload:
      return unloaded_and_reloaded(test);
    case TestKind::cyclic:
      return {cycled(test)};
    case TestKind::creep:
      return {loaded_dead(test)};
    case TestKind::heating:
      return heated(test);
    case TestKind::depressurisation:
      return depressurised(scene);
    case TestKind::list:
      return scene.stages;
  }
  return {};
}

bool forms_hydrate(std::vector<LoadingStage> const& stages) {
  return std::any_of(stages.begin(), stages.end(), [](LoadingStage const& stage) { return stage.forms_hydrate; });
}

bool changes_hydrate(std::vector<LoadingStage> const& stages) {
  return std::any_of(stages.begin(), stages.end(), [](LoadingStage const& stage) { return stage.hydrate.any(); });
}

namespace {

/// Of stages with a rate; 0 where there is none.
double path_of_rates(std::vector<LoadingStage> const& stages) {
  double path = 0, at = 0;
  for (LoadingStage const& stage : stages) {
    std::vector<double> const& turns = stage.turn.axial_strain;
    if (!turns.empty()) path += 2 * stage.until.cycles * (turns.back() - turns.front());
    if (!is_given(stage.until.axial_strain) || stage.has_stress_only()) continue;
    path += std::abs(stage.until.axial_strain - at);
    at = stage.until.axial_strain;
  }
  return path;
}

}  // namespace

double planned_path(Scene const& scene) {
  double const path = path_of_rates(stages_of(scene));
  return path > 0 ? path : scene.test.axial_strain;
}

double planned_steps(Scene const& scene, double strain_rate, double time_step) {
  constexpr double of_stress =
      3000;  // an increment; 2,200 of sand without lateral strain, 3,800 under both stresses (examples/tests)
  constexpr double of_hydrate = 2000;  // an increment that is asked for, halved or not; 1,400 to 4,800 (the same examples)
  std::vector<LoadingStage> const stages = stages_of(scene);
  double of_increments = 0;
  bool stress_only = true;
  for (LoadingStage const& stage : stages) {
    if (stage.has_stress_only()) of_increments += (stage.hydrate.any() ? of_hydrate : of_stress) * stage.increments;
    stress_only = stress_only && stage.has_stress_only();
  }
  double const path = stress_only ? 0 : planned_path(scene);
  return std::ceil(path / (strain_rate * time_step)) + of_increments;
}

}  // namespace clathra
