#include "tune/tune_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "domain/biaxial/scene_cost.hpp"
#include "io/scene/scene_edit.hpp"
#include "io/scene/scene_value.hpp"
#include "io/scene/schema.hpp"

namespace clathra {
namespace {

std::string step_text(TuneSetting const& s) { return s.dt_safety > 0 ? fmt::format("{:g}", s.dt_safety) : "usual"; }

std::string scaling_text(TuneSetting const& s) {
  std::string text = fmt::format("x{:g}", s.inertia_scaling);
  return s.mass_scaling > 0 ? text + fmt::format(", {:g}", s.mass_scaling) : text;
}

std::string verdict_text(SettingSearch const& search, std::size_t setting, double tolerance) {
  std::optional<SettingError> const error = search.error(setting);
  if (!error) return "";
  switch (verdict_on(*error, tolerance)) {
    case ErrorVerdict::within:
      return "within";
    case ErrorVerdict::outside:
      return "beyond";
    case ErrorVerdict::open:
      return "open";
  }
  return "";
}

/// A larger scene has another W than its levels.
std::string as_it_stands_text(TunePlan const& plan) {
  double const own = predict(plan.base.scene).at("platen_wave_stress");
  return plan.reduced ? fmt::format("as it stands, there with a W of {:.2g}", own) : "as it stands";
}

std::string row_of(TunePlan const& plan, SettingSearch const& search, std::size_t i, std::string const& failure) {
  TuneSetting const& s = plan.settings[i];
  std::optional<SettingError> const error = search.error(i);
  std::string const measured =
      error ? fmt::format("{:+.2f} ± {:.2f}", 100 * error->error, 100 * error->half_width) : std::string("-");
  std::string words = failure.empty() ? verdict_text(search, i, plan.goal.width) : "cannot be run: " + failure;
  if (i == plan.as_it_stands) words += (words.empty() ? "" : ", ") + as_it_stands_text(plan);
  if (search.choice() == i) words += ", chosen";
  return fmt::format("  {:<8.3g} {:<6.2g} {:<7} {:<6} {:<10} {:>5}  {:>14}  {:>7.3g}  {}\n", s.inertial_number,
                     plan.platen_wave_stress(i), precision_names[static_cast<int>(s.precision)], step_text(s), scaling_text(s),
                     error ? error->seeds : 0, measured, plan.relative_cost(i), words);
}

/// What a comment says of a key.
std::string comment_of(std::string const& key, TunePlan const& plan, SettingSearch const& search, std::size_t setting) {
  SettingError const all = *search.error(setting);
  if (key == "test.inertial_number")
    return fmt::format("clathra tune, within {:g} %: with all its keys {}; {:.3g} of the cost that was", 100 * plan.goal.width,
                       measured_text(plan, all), plan.relative_cost(setting));
  if (key == "test.max_platen_wave_stress")
    return plan.reduced ? "W of the specimens that were measured: a taller one is sheared slower"
                        : "W of the specimens that were measured";
  return fmt::format("measured with these keys: {:+.2f} ± {:.2f} %", 100 * all.error, 100 * all.half_width);
}

}  // namespace

std::string measured_text(TunePlan const& plan, SettingError const& error) {
  return fmt::format("{} {:+.2f} ± {:.2f} % (95 %, {} seeds of {} particles)", plan.goal.number, 100 * error.error,
                     100 * error.half_width, error.seeds, plan.discs);
}

std::string tune_table(TunePlan const& plan, SettingSearch const& search, std::vector<std::string> const& failures) {
  std::string text =
      fmt::format("{}: error of {}, tests of {} particles\n", plan.study.study.scene.string(), plan.goal.number, plan.discs);
  text += fmt::format("  {:<8} {:<6} {:<7} {:<6} {:<10} {:>5}  {:>14}  {:>7}\n", "I", "W", "numbers", "step", "inertia", "seeds",
                      "error [%]", "cost");
  for (std::size_t i = 0; i < plan.settings.size(); ++i)
    if (search.error(i) || !failures[i].empty()) text += row_of(plan, search, i, failures[i]);
  return text;
}

std::string tuned_scene(TunePlan const& plan, SettingSearch const& search, std::size_t setting,
                        std::filesystem::path const& folder) {
  std::vector<SceneEdit> edits;
  Scene const wanted = plan.scene_with(setting);
  for (std::string const& text : plan.base.overrides) {
    std::string const name = text.substr(0, text.find('='));
    bool const tuned = std::any_of(edits.begin(), edits.end(), [&](SceneEdit const& edit) { return edit.key == name; });
    if (Key const* const key = find_key(name); key && !tuned) edits.push_back({name, value_text(*key, wanted), "--set"});
  }
  for (auto const& [name, value] : plan.keys_of(setting)) {
    std::erase_if(edits, [&](SceneEdit const& edit) { return edit.key == name; });
    edits.push_back({name, value_text(*find_key(name), wanted), comment_of(name, plan, search, setting)});
  }
  std::erase_if(edits, [](SceneEdit const& edit) { return edit.key == "test.strain_rate" || edit.key == "run.preset"; });
  if (!wanted.grading.file.empty())
    edits.push_back(
        {"grading.file", fmt::format("\"{}\"", std::filesystem::proximate(wanted.grading.file, folder).string()), ""});
  return scene_text_for(wanted, plan.base.source, edits, {"test.strain_rate"}, folder);
}

}  // namespace clathra
