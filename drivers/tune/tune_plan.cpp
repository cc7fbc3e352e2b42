#include "tune/tune_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "domain/biaxial/scene_cost.hpp"
#include "domain/scene/specimen_design.hpp"

namespace clathra {
namespace {

constexpr double ladder_rates[] = {3e-3, 1e-3, 3e-4, 1e-4, 3e-5};

/// Keys that the levels set themselves.
constexpr std::string_view tuned_keys[] = {
    "test.inertial_number", "test.strain_rate", "test.max_platen_wave_stress",   "run.precision",
    "run.time_step_safety", "run.preset",       "run.rotational_inertia_factor", "run.mass_scaled_fraction"};

/// Keys of the command line that no level takes: each has its own.
constexpr std::string_view own_keys[] = {"run.seed", "run.threads", "output.folder"};

bool is_one_of(std::string_view text, std::span<std::string_view const> keys) {
  return std::find(keys.begin(), keys.end(), text.substr(0, text.find('='))) != keys.end();
}

std::string share_text(double value) { return fmt::format("{}", value); }

/// The settings at a rate, that of the ladder first.
std::vector<TuneSetting> settings_at(double rate, double half_step) {
  return {{rate, Precision::full, half_step, 1, 0}, {rate, Precision::full, 0, 1, 0},  {rate, Precision::full, 0, 3, 0},
          {rate, Precision::mixed, 0, 1, 0},        {rate, Precision::mixed, 0, 3, 0}, {rate, Precision::mixed, 0, 3, 0.25}};
}

bool is_reference(TuneSetting const& setting) {
  return setting.precision == Precision::full && setting.dt_safety > 0 && setting.inertia_scaling == 1 &&
         setting.mass_scaling == 0 && std::count(std::begin(ladder_rates), std::end(ladder_rates), setting.inertial_number) > 0;
}

TuneSetting setting_of(Scene const& scene) {
  return {predict(scene).at("inertial_number"), scene.run.precision, scene.run.time_step_safety,
          scene.run.rotational_inertia_factor, scene.run.mass_scaled_fraction};
}

std::vector<Setting> keys_of_rung(TuneSetting const& s) {
  return {{"test.inertial_number", share_text(s.inertial_number)},
          {"test.max_platen_wave_stress", "0"},
          {"run.precision", precision_names[static_cast<int>(s.precision)]},
          {"run.time_step_safety", s.dt_safety > 0 ? share_text(s.dt_safety) : ""},
          {"run.rotational_inertia_factor", share_text(s.inertia_scaling)},
          {"run.mass_scaled_fraction", share_text(s.mass_scaling)}};
}

/// The size of a level: that of the scene, in smaller.
std::vector<std::string> sample_of_rung(Scene const& scene, SpecimenDesign const& design, std::int64_t discs) {
  double const smaller = std::sqrt(static_cast<double>(discs) / static_cast<double>(design.particles));
  std::vector<std::string> overrides = {"specimen.generator=under_compaction",
                                        "specimen.particles=",
                                        fmt::format("specimen.width={}", design.width * smaller),
                                        fmt::format("specimen.height={}", design.height * smaller),
                                        fmt::format("specimen.void_ratio={}", design.void_ratio),
                                        fmt::format("grading.d50={}", design.grading.d50())};
  if (scene.specimen.compaction_layers > 5) overrides.emplace_back("specimen.compaction_layers=5");
  return overrides;
}

/// Of a level whose narrower side has grains enough across.
std::int64_t fewest_discs_of(SpecimenDesign const& design) {
  double const side = std::min(design.width, design.height),
               share = std::pow(fewest_grains_across * design.grading.largest() / side, 2);
  constexpr double spare = 1.05;  // the number of discs is whole, the box follows
  return std::llround(std::ceil(spare * share * static_cast<double>(design.particles)));
}

std::string group_name(std::int64_t discs, TuneSetting const& s) {
  std::string name = fmt::format("particles{}_I{:g}_{}_dt{:g}_x{:g}", discs, s.inertial_number,
                                 precision_names[static_cast<int>(s.precision)], s.dt_safety, s.inertia_scaling);
  return s.mass_scaling > 0 ? name + fmt::format("_m{:g}", s.mass_scaling) : name;
}

/// Median of a number over the finished members of a setting; 0 where there is none.
template <class Number>
double median_of(StudyPlan const& plan, std::size_t setting, Number const& number) {
  std::vector<double> values;
  for (MemberResult const& member : plan.members)
    if (member.state == MemberState::finished && member.group == setting) values.push_back(number(member));
  if (values.empty()) return 0;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

double step_of(MemberResult const& member) {
  auto const found = member.numbers.find("time_step_s");
  return found == member.numbers.end() ? 0 : found->second;
}

}  // namespace

TunePlan plan_tune(std::filesystem::path const& scene, std::vector<std::string> const& overrides, StudyGoal const& goal,
                   std::int64_t discs, std::filesystem::path const& folder) {
  TunePlan plan;
  plan.base = load_scene(scene, overrides);
  plan.goal = goal;
  Scene const& base = plan.base.scene;
  if (base.specimen.is_read())
    throw Refused("tune needs specimens of several seeds: a specimen from a file (specimen.file) is one only");
  if (base.test.kind != TestKind::biaxial)
    throw Refused("tune compares compressions under constant lateral stress: test.kind must be \"biaxial\"");
  SpecimenDesign const design = design_sample(base);
  discs = std::max(discs, fewest_discs_of(design));
  plan.reduced = discs < design.particles;
  plan.discs = std::min(discs, design.particles);
  for (double const rate : ladder_rates)
    for (TuneSetting const& setting :
         settings_at(rate, 0.5 * RunScene{.time_step_rule = base.run.time_step_rule}.step_choice().safety))
      plan.settings.push_back(setting);
  TuneSetting const own = setting_of(base);
  auto const known = std::find(plan.settings.begin(), plan.settings.end(), own);
  plan.as_it_stands = static_cast<std::size_t>(known - plan.settings.begin());
  if (known == plan.settings.end()) plan.settings.push_back(own);
  Study study;
  study.file = study.scene = scene;
  study.folder = folder;
  study.seeds = {1};
  study.seeds_stated = true;
  for (TuneSetting const& setting : plan.settings) {
    std::string const name = group_name(plan.discs, setting);
    study.groups.push_back({name, keys_of_rung(setting), name});
  }
  for (Setting const& setting : study.groups.front().settings) study.keys.push_back(setting.first);
  std::vector<std::string> shared = {"output.snapshots=0", "output.events=false", "output.event_details=false",
                                     "output.energy=false", "output.keep_checkpoint=false"};
  for (std::string const& text : overrides)
    if (!is_one_of(text, tuned_keys) && !is_one_of(text, own_keys)) shared.push_back(text);
  if (plan.reduced)
    for (std::string& text : sample_of_rung(base, design, plan.discs)) shared.push_back(std::move(text));
  override_study(study, shared);
  plan.study = plan_study(std::move(study));
  return plan;
}

std::vector<Trial> TunePlan::trials() const {
  std::vector<Trial> trials;
  for (std::size_t i = 0; i < settings.size(); ++i) {
    Trial trial;
    trial.rate = settings[i].inertial_number;
    trial.cost = relative_cost(i);
    trial.on_ladder = is_reference(settings[i]);
    trials.push_back(std::move(trial));
  }
  return trials;
}

double TunePlan::platen_wave_stress(std::size_t setting) const {
  return predict(member_scene(study.study, study.study.groups[setting], 1).scene).at("platen_wave_stress");
}

Scene TunePlan::scene_with(std::size_t setting) const {
  std::vector<std::string> overrides = base.overrides;
  std::erase_if(overrides, [](std::string const& text) { return is_one_of(text, tuned_keys); });
  for (auto const& [key, value] : keys_of(setting)) overrides.push_back(key + "=" + value);
  return load_scene(study.study.scene, overrides).scene;
}

std::vector<Setting> TunePlan::keys_of(std::size_t setting) const {
  TuneSetting const& s = settings[setting];
  double const step =
      s.dt_safety > 0 ? s.dt_safety : RunScene{.time_step_rule = base.scene.run.time_step_rule}.step_choice().safety;
  std::vector<Setting> keys = keys_of_rung(s);
  keys[1].second = fmt::format("{:.3g}", platen_wave_stress(setting));
  keys[3].second = share_text(step);
  return keys;
}

double TunePlan::relative_cost(std::size_t setting) const {
  Scene const scene = setting == as_it_stands ? base.scene : scene_with(setting);
  StageRecord const own = predict(base.scene), other = predict(scene);
  double cost = own.at("strain_rate_per_s") / other.at("strain_rate_per_s");
  double const own_step = median_of(study, as_it_stands, step_of), step = median_of(study, setting, step_of);
  cost *= own_step > 0 && step > 0 ? own_step / step : own.at("time_step_s") / other.at("time_step_s");
  auto const speed = [&](Precision precision) { return precision == Precision::mixed ? speed_of_mixed : 1; };
  return cost * speed(settings[as_it_stands].precision) / speed(settings[setting].precision);
}

}  // namespace clathra
