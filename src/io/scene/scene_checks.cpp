#include "io/scene/scene_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>

#include "domain/scene/hydrate.hpp"
#include "domain/scene/hydrate_loss.hpp"
#include "domain/scene/phase_boundary.hpp"
#include "domain/scene/specimen_design.hpp"
#include "domain/scene/stage.hpp"
#include "domain/scene/units.hpp"
#include "io/scene/hydrate_course_warnings.hpp"
#include "io/scene/scene_value.hpp"
#include "io/scene/schema.hpp"
#include "io/scene/size_warnings.hpp"

namespace clathra {
namespace {

/// The scene, what it states, and what was found so far.
struct Check {
  Scene const& scene;
  std::function<bool(std::string_view)> const& given;
  SceneFindings found;

  void error(std::vector<std::string_view> keys, std::string text) {
    found.problems.push_back({std::move(keys), std::move(text)});
  }
  void refusal(std::vector<std::string_view> keys, std::string text) {
    if (scene.run.ignore_guards)
      found.warnings.push_back(guard_ignored + text);
    else
      found.problems.push_back({std::move(keys), text + ignore_hint, Severity::refusal});
  }
  /// Whether a key is stated, and not as it is by default: what a run writes down as resolved states all keys.
  bool changed(std::string_view name) const {
    Key const& key = *find_key(name);
    return given(name) && value_text(key, scene) != value_text(key, Scene{});
  }
  void warn(std::string text) { found.warnings.push_back(std::move(text)); }
};

std::string length_text(double metres) { return fmt::format("{:.4g} mm", metres * 1e3); }

void check_input_file(Check& check, std::string_view key, std::string const& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored))
    check.found.problems.push_back(
        {{key}, fmt::format("'{}' names a file that is not there: {}", key, path), Severity::missing_file});
  else if (!std::filesystem::is_regular_file(path, ignored) || !std::ifstream(path))
    check.found.problems.push_back(
        {{key}, fmt::format("'{}' names a file that cannot be read: {}", key, path), Severity::missing_file});
}

/// Any three of particles, box, void ratio and grading fix the fourth.
void check_size(Check& check) {
  SpecimenScene const& specimen = check.scene.specimen;
  if (specimen.is_read()) {
    check_input_file(check, "specimen.file", specimen.file);
    for (std::string_view const key :
         {"specimen.particles", "specimen.void_ratio", "specimen.void_ratio_at", "specimen.width", "specimen.height",
          "specimen.generator", "specimen.compaction_layers", "grading.d50", "grading.file", "grading.table"})
      if (check.changed(key)) check.warn(fmt::format("{} has no effect: the specimen comes from {}", key, specimen.file));
    return;
  }
  bool const box = specimen.width > 0 || specimen.height > 0;
  if (specimen.particles == 0 && !box)
    check.error({"specimen.particles"},
                "the size of the specimen is open: give 'specimen.particles', or 'specimen.width' and 'specimen.height'");
  if (specimen.particles > 0 && box && specimen.void_ratio > 0 && check.scene.grading.d50 > 0)
    check.error(
        {"specimen.void_ratio", "specimen.particles", "grading.d50"},
        "specimen.particles, box, specimen.void_ratio and grading.d50 are all given, but three of them fix the fourth: leave "
        "one out");
  if (specimen.width > 0 && specimen.height > 0 && specimen.void_ratio_at == VoidRatioAt::test)
    check.error(
        {"specimen.void_ratio_at", "specimen.height", "specimen.width"},
        "specimen.width and specimen.height are those of the specimen as it is made, which fixes its void ratio there: leave one "
        "of them out, or have specimen.void_ratio_at = \"preparation\"");
  if (specimen.width > 0 && specimen.height > 0 && check.given("specimen.aspect_ratio") &&
      std::fabs(specimen.height / specimen.width / specimen.aspect_ratio - 1) > 1e-6)
    check.error({"specimen.aspect_ratio", "specimen.width"},
                "specimen.width, specimen.height and specimen.aspect_ratio contradict each other");
}

/// Reads the grading and completes the specimen; nothing where that is not possible, which is then reported.
std::optional<SpecimenDesign> check_design(Check& check) {
  Scene const& scene = check.scene;
  if (scene.specimen.is_read()) return {};
  if (!scene.grading.file.empty()) {
    check_input_file(check, "grading.file", scene.grading.file);
    if (check.given("grading.table")) check.warn("grading.table has no effect: the sizes come from grading.file");
  }
  if (!check.found.problems.empty()) return {};
  try {
    SpecimenDesign design = design_sample(scene);
    double const largest = design.grading.largest();
    if (std::min(design.width, design.height) < largest)
      check.error({"specimen.width", "specimen.height", "specimen.particles", "grading.d50"},
                  fmt::format("no grain of {} fits into a specimen of {} x {}", length_text(largest), length_text(design.width),
                              length_text(design.height)));
    else if (std::string const problem = narrowness(design.width, design.height, largest); !problem.empty())
      check.refusal({"specimen.width", "specimen.height", "specimen.particles", "grading.d50"}, problem);
    if (std::string const problem = crowding(design.grading.smallest(), largest, reach_of_bonds(scene, design.grading.d50()));
        !problem.empty())
      check.refusal({"grading.file", "grading.d50"}, problem);
    if (std::string const problem = wide_skin(design.grading, scene.run.verlet_skin); !problem.empty())
      check.refusal({"run.verlet_skin"}, problem);
    if (int const layers = compaction_layers(scene, design); layers < scene.specimen.compaction_layers &&
                                                             scene.specimen.generator == Generator::under_compaction &&
                                                             check.given("specimen.compaction_layers"))
      check.warn(fmt::format("the specimen is compacted in {} layers, not {}: thinner ones would not be layers of these grains",
                             layers, scene.specimen.compaction_layers));
    if (design.particles < 16 || design.particles > 1'000'000'000)
      check.error({"specimen.width", "specimen.height", "grading.d50"},
                  fmt::format("the box of {} x {} holds {} particles of this grading; between 16 and 1e9 are possible",
                              length_text(design.width), length_text(design.height), design.particles));
    if (std::string text = far_void_ratio(scene, design); !text.empty()) check.warn(std::move(text));
    for (std::string& text : size_warnings(design.grading.sizes())) check.warn(std::move(text));
    return design;
  } catch (std::invalid_argument const& problem) {
    check.error({"grading.file", "specimen.particles", "specimen.width"}, problem.what());
    return {};
  }
}

/// What the kinds of test need, and what they leave aside.
void check_kind(Check& check) {
  TestScene const& test = check.scene.test;
  auto const only = [&](std::string_view key, std::initializer_list<TestKind> kinds) {
    if (check.changed(key) && std::find(kinds.begin(), kinds.end(), test.kind) == kinds.end())
      check.warn(fmt::format("{} has no effect with test.kind = {}", key, value_text(*find_key("test.kind"), check.scene)));
  };
  only("test.largest_stress", {TestKind::isotropic, TestKind::oedometer});
  only("test.increments", {TestKind::isotropic, TestKind::oedometer, TestKind::heating, TestKind::depressurisation});
  only("test.unload_at", {TestKind::unload_reload});
  only("test.cyclic_deviator_stress", {TestKind::cyclic});
  only("test.cycles", {TestKind::cyclic});
  only("test.fluid_modulus", {TestKind::constant_volume});
  only("test.dead_load", {TestKind::creep, TestKind::heating, TestKind::depressurisation});
  only("test.final_temperature", {TestKind::heating});
  only("test.final_pore_pressure", {TestKind::depressurisation});
  only("test.final_saturation", {TestKind::heating, TestKind::depressurisation});
  if (test.kind == TestKind::creep && test.dead_load == 0)
    check.error({"test.dead_load", "test.kind"}, "'test.kind' = \"creep\" needs 'test.dead_load'");
  if (test.largest_stress > 0 && test.largest_stress <= test.confining_stress)
    check.error({"test.largest_stress", "test.confining_stress"}, "'test.largest_stress' must be above 'test.confining_stress'");
  if (test.kind == TestKind::unload_reload && !test.unload_at.empty() && test.unload_at.back() >= test.axial_strain)
    check.error({"test.unload_at", "test.axial_strain"}, "'test.unload_at' must lie below 'test.axial_strain'");
  if (!test.cyclic_deviator_stress.empty() && test.cyclic_deviator_stress.size() != 2)
    check.error({"test.cyclic_deviator_stress"},
                fmt::format("'test.cyclic_deviator_stress' needs two different values, {} are given",
                            test.cyclic_deviator_stress.size()));
}

/// Exactly one of inertial_number and strain_rate; stating the rate replaces the default inertial number (see scene_file.cpp).
void check_loading(Check& check) {
  TestScene const& test = check.scene.test;
  if (test.inertial_number > 0 && test.strain_rate > 0)
    check.error({"test.strain_rate", "test.inertial_number"},
                "give either 'test.inertial_number' or 'test.strain_rate', not both");
  if (test.inertial_number == 0 && test.strain_rate == 0)
    check.error({"test.inertial_number", "test.strain_rate"},
                "one of 'test.inertial_number' and 'test.strain_rate' must be given");
  if (test.strain_rate > 0 && test.max_platen_wave_stress > 0)
    check.error(
        {"test.max_platen_wave_stress", "test.strain_rate"},
        "'test.max_platen_wave_stress' lowers the rate of 'test.inertial_number': it cannot change a stated 'test.strain_rate'");
  check_kind(check);
  if (check.scene.specimen.preparation_stress > test.confining_stress)
    check.error({"specimen.preparation_stress", "test.confining_stress"},
                fmt::format("'specimen.preparation_stress' ({}) is above 'test.confining_stress' ({})",
                            format_quantity(check.scene.specimen.preparation_stress, Dimension::pressure),
                            format_quantity(test.confining_stress, Dimension::pressure)));
}

/// A d50 so small that no gap between the two largest discs gives a bond with tensile strength (trap 5 of the physics page).
void check_strength(Check& check, SpecimenDesign const& design) {
  if (check.scene.bond.critical_thickness_from == CriticalThicknessFrom::bond_area) return;
  double const d50 = design.grading.d50(), radius = design.grading.largest() / 2;
  double const h_max = evaluate_bond(check.scene, d50, radius, radius, 0, 0).h_max;
  constexpr int steps = 64;
  double best = -HUGE_VAL;
  for (int i = 0; i < steps; ++i)
    best = std::max(best, evaluate_bond(check.scene, d50, radius, radius, h_max * i / steps, 0).R_t);
  if (best > 0) return;
  check.error(
      {"grading.d50", "hydrate.saturation", "bond.critical_thickness"},
      fmt::format("with d50 = {} no bond has tensile strength: between the largest particles R_t is {:.4g} N/m at best (Eq. 15a)",
                  length_text(d50), best));
}

void check_hydrate(Check& check, std::optional<SpecimenDesign> const& design) {
  Scene const& scene = check.scene;
  if (!has_bonds(scene)) return;
  std::vector<std::string_view> const state = {"hydrate.temperature", "hydrate.pore_pressure", "hydrate.density",
                                               "hydrate.saturation"};
  if (std::string const problem = hydrate_problem(scene.hydrate); !problem.empty()) return check.error(state, problem);
  if (std::string const problem = stability_problem(scene.hydrate); !problem.empty())
    check.refusal({"hydrate.temperature", "hydrate.pore_pressure", "hydrate.salinity", "hydrate.saturation"}, problem);
  if (std::string const warning = boundary_warning(scene.hydrate.temperature, scene.hydrate.salinity); !warning.empty())
    check.warn(warning);
  if (std::string const warning = fit_warning(scene.hydrate); !warning.empty()) check.warn(warning);
  if (scene.bond.critical_thickness_from == CriticalThicknessFrom::given && scene.bond.critical_thickness == 0)
    return check.error({"bond.critical_thickness_from"},
                       "'bond.critical_thickness_from' = \"given\" needs 'bond.critical_thickness'");
  if (scene.bond.critical_thickness_from != CriticalThicknessFrom::given && scene.bond.critical_thickness > 0)
    check.warn("bond.critical_thickness has no effect: bond.critical_thickness_from is not \"given\"");
  if (scene.bond.critical_thickness_from == CriticalThicknessFrom::saturation) {
    if (std::string const warning = saturation_warning(scene.hydrate.saturation); !warning.empty()) check.warn(warning);
    if (critical_thickness_ratio(scene.hydrate.saturation) == 0) return;
  }
  if (design) check_strength(check, *design);
}

/// What a stage wants in which hydrate forms.
void check_formation(Check& check) {
  if (!forms_hydrate(stages_of(check.scene))) return;
  if (!has_bonds(check.scene))
    return check.error({"hydrate.saturation", "bond.law"}, "hydrate is to form in a stage, and the scene has none");
  if (check.scene.bond.contact_coupling == ContactCoupling::replaces)
    return check.error(
        {"bond.contact_coupling"},
        "hydrate is to form in a stage, where 'bond.contact_coupling' = \"replaces\" would delete the contact forces "
        "that carry its stresses; use \"parallel\" or \"replaces_keeping_force\"");
  if (!check.scene.bond.after_consolidation)
    check.error({"bond.after_consolidation"},
                "'bond.after_consolidation' = false lets hydrate form before the consolidation, 'forms_hydrate' in a stage");
}

/// What the law of loss needs, and what it leaves aside.
void check_loss(Check& check, std::vector<LoadingStage> const& stages) {
  HydrateScene const& hydrate = check.scene.hydrate;
  bool const uniform = hydrate.loss == HydrateLoss::uniform;
  std::string_view const idle = uniform ? "hydrate.spread_of_loss" : "hydrate.loss_exponent";
  bool const by_rate = std::any_of(stages.begin(), stages.end(), [](auto const& stage) { return stage.hydrate.has_rate(); });
  if (check.changed(idle) && !(uniform && by_rate))  // a rate reads the saturation off a width
    check.warn(fmt::format("{} has no effect with hydrate.loss = {}", idle, value_text(*find_key("hydrate.loss"), check.scene)));
  double const spread = uniform ? 0 : hydrate.spread_of_loss;
  if (hydrate.saturation <= least_cementing + spread)
    check.error({"hydrate.saturation", "hydrate.spread_of_loss"},
                fmt::format("a stage changes the hydrate, which must form with a saturation above {:g} %{}",
                            (least_cementing + spread) * 100, uniform ? "" : ": 20 % and hydrate.spread_of_loss"));
}

/// What stages want of hydrate that changes.
void check_hydrate_of_stages(Check& check) {
  Scene const& scene = check.scene;
  std::vector<LoadingStage> const stages = stages_of(scene);
  if (!changes_hydrate(stages)) {
    for (std::string_view const key : {"hydrate.loss", "hydrate.spread_of_loss", "hydrate.loss_exponent"})
      if (check.changed(key)) check.warn(fmt::format("{} has no effect: no stage changes the hydrate", key));
    return;
  }
  std::vector<std::string_view> const at = {"test.kind", "hydrate.saturation"};
  if (!has_bonds(scene)) return check.error(at, "a stage changes the hydrate, and there are no bonds that it could change");
  if (scene.bond.law == BondLawKind::constant_thickness)
    check.error({"bond.law"}, "a stage changes the hydrate: how bonds of \"constant_thickness\" lose it is not known");
  if (scene.test.kind == TestKind::depressurisation &&
      scene.test.final_pore_pressure - scene.hydrate.pore_pressure >= scene.test.confining_stress)
    check.error(
        {"test.final_pore_pressure", "test.confining_stress"},
        "'test.final_pore_pressure' is above 'hydrate.pore_pressure' by more than the confining stress: at constant total "
        "stress no effective stress would be left");
  check_loss(check, stages);
  for (std::string const& warning : hydrate_course_warnings(scene, stages)) check.warn(warning);
  double saturation = scene.hydrate.saturation;
  bool known = true;
  for (LoadingStage const& stage : stages) {
    HydrateChange const& change = stage.hydrate;
    std::string const of = fmt::format("stage '{}': ", stage.name.substr(0, 60));
    if (is_given(change.saturation) && change.saturation > saturation)
      check.error(at, fmt::format("{}a saturation of {:g} % is above the {:g} % that are there: hydrate does not form again", of,
                                  change.saturation * 100, saturation * 100));
    if (is_given(change.saturation) && !known && change.saturation > least_cementing)
      check.error(at,
                  fmt::format("{}a saturation of {:g} % may be above what a stage before it leaves, whose hydrate dissociates: "
                              "state 20 % or less",
                              of, change.saturation * 100));
    if (change.dissociates()) known = false;
    if (is_given(change.saturation)) saturation = change.saturation;
    if (is_given(change.temperature))
      if (std::string const text = boundary_warning(change.temperature, scene.hydrate.salinity); !text.empty())
        check.warn(of + text);
    if (scene.bond.strength_from == StrengthFrom::printed && (is_given(change.temperature) || is_given(change.pore_pressure)))
      check.warn(of + "temperature and pore pressure change no strength with bond.strength_from = \"printed\"");
  }
}

void check_bonding(Check& check) {
  BondScene const& bond = check.scene.bond;
  if (!has_bonds(check.scene)) {
    for (std::string_view const key :
         {"bond.contact_coupling", "bond.critical_thickness_from", "bond.rolling_lever", "bond.strength_from",
          "bond.thickness_mapping", "bond.friction_floor", "bond.strength_modulus"})
      if (check.changed(key)) return check.warn("the [bond] section has no effect: the scene has no hydrate");
    return;
  }
  if (bond.strength_modulus == 0 && check.changed("bond.strength_seed"))
    check.warn("bond.strength_seed has no effect: bond.strength_modulus is 0, all bonds are alike");
  if (bond.constant_thickness > 0 && bond.law != BondLawKind::constant_thickness)
    check.warn("bond.constant_thickness has no effect: bond.law is not \"constant_thickness\"");
  if (bond.constant_thickness > 0 && bond.critical_thickness_from == CriticalThicknessFrom::given &&
      bond.constant_thickness >= bond.critical_thickness)
    check.error({"bond.constant_thickness", "bond.critical_thickness"},
                "'bond.constant_thickness' must be below 'bond.critical_thickness'");
  if (bond.after_consolidation && bond.contact_coupling == ContactCoupling::replaces)
    check.refusal(
        {"bond.after_consolidation", "bond.contact_coupling"},
        "contact_coupling = \"replaces\" with after_consolidation deletes the contact forces that carry the confining stress "
        "(Eq. 7a); use \"parallel\" or \"replaces_keeping_force\"");
}

/// The folder itself must be named: neither a root, nor the way up, nor a link to elsewhere.
void check_output(Check& check) {
  std::filesystem::path folder = std::filesystem::path(check.scene.output.folder).lexically_normal();
  if (!folder.has_filename()) folder = folder.parent_path();  // "out/"
  std::filesystem::path const name = folder.filename();
  if (name.empty() || name == ".." || name == ".")
    check.error({"output.folder"},
                fmt::format("'output.folder' must name a folder of its own, got '{}'", check.scene.output.folder));
  if (check.scene.output.snapshots > check.scene.output.records)
    check.error({"output.snapshots", "output.records"},
                fmt::format("'output.snapshots' ({}) must not exceed 'output.records' ({})", check.scene.output.snapshots,
                            check.scene.output.records));
  constexpr double coarse = 1e-3, past_a_peak = 0.02;  // strains: of rows apart, of tests that may have a peak
  double const strain = planned_path(check.scene), apart = strain / check.scene.output.records;
  if (apart > coarse && strain > past_a_peak)
    check.warn(
        fmt::format("rows of history.csv are {:.2g} % of strain apart: the volumetric strain and the bonds at the peak, and E50, "
                    "are read between them; raise output.records to {:.0f} or more",
                    100 * apart, std::ceil(strain / coarse)));
  if (!check.scene.output.event_details) return;
  if (!check.scene.output.events)
    check.warn("output.event_details has no effect: output.events is false");
  else if (!has_bonds(check.scene))
    check.warn("output.event_details has no effect: the scene has no hydrate");
}

}  // namespace

SceneFindings check_scene(Scene const& scene, std::function<bool(std::string_view)> const& given) {
  Check check{scene, given, {}};
  check_size(check);
  std::optional<SpecimenDesign> const design = check_design(check);
  check_loading(check);
  check_hydrate(check, design);
  check_formation(check);
  check_hydrate_of_stages(check);
  check_bonding(check);
  check_output(check);
  return std::move(check.found);
}

}  // namespace clathra
