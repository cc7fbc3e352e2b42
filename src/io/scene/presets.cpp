#include "io/scene/presets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "io/scene/scene_value.hpp"

namespace clathra {
namespace {

// clang-format off
constexpr PresetKey calibrated[] = {
  {"grains.rolling_width_factor", "1"}, {"bond.grain_stiffness_factor", "2"}, {"bond.contact_coupling", "parallel"}, {"bond.rolling_lever", "B/4"},
  {"bond.thickness_mapping", "identity"}, {"bond.friction_floor", "false"}, {"bond.strength_from", "conditions"}, {"bond.after_consolidation", "true"}};
constexpr PresetKey first_crack[] = {
  {"grains.rolling_width_factor", "2"}, {"bond.grain_stiffness_factor", "1"}, {"bond.contact_coupling", "parallel"}, {"bond.rolling_lever", "B/14"},
  {"bond.thickness_mapping", "identity"}, {"bond.friction_floor", "false"}, {"bond.strength_from", "conditions"}, {"bond.after_consolidation", "false"}};
constexpr PresetKey long_lever[] = {
  {"grains.rolling_width_factor", "1"}, {"bond.grain_stiffness_factor", "1"}, {"bond.contact_coupling", "parallel"}, {"bond.rolling_lever", "B/3"},
  {"bond.thickness_mapping", "scaled"}, {"bond.friction_floor", "false"}, {"bond.strength_from", "conditions"}, {"bond.after_consolidation", "true"}};
constexpr PresetKey short_lever[] = {
  {"grains.rolling_width_factor", "1"}, {"bond.grain_stiffness_factor", "1"}, {"bond.contact_coupling", "parallel"}, {"bond.rolling_lever", "B/7"},
  {"bond.thickness_mapping", "identity"}, {"bond.friction_floor", "false"}, {"bond.strength_from", "conditions"}, {"bond.after_consolidation", "true"}};
constexpr PresetKey replacing[] = {
  {"grains.rolling_width_factor", "1"}, {"bond.grain_stiffness_factor", "1"}, {"bond.contact_coupling", "replaces"}, {"bond.rolling_lever", "B/14"},
  {"bond.thickness_mapping", "scaled"}, {"bond.friction_floor", "false"}, {"bond.strength_from", "conditions"}, {"bond.after_consolidation", "false"}};
constexpr PresetKey literal[] = {
  {"grains.rolling_width_factor", "2"}, {"bond.grain_stiffness_factor", "1"}, {"bond.contact_coupling", "replaces"}, {"bond.rolling_lever", "1 m"},
  {"bond.thickness_mapping", "identity"}, {"bond.friction_floor", "false"}, {"bond.strength_from", "printed"}, {"bond.after_consolidation", "false"}};
constexpr Preset all_bond_presets[] = {
  {"calibrated", "the default, which meets most of the claims of Jiang et al. (2017): hydrate forms under the confining stress, bonds act beside the grain contact, L_r = B/4, grains are twice as stiff as contacts, beta is half of the printed one", calibrated},
  {"first_crack", "bonds fail in bending when their section cracks, L_r = B/14; hydrate forms under 50 kPa; stiffness of grains and beta as printed", first_crack},
  {"long_lever", "as `calibrated`, but grains as stiff as contacts, L_r = B/3 and bond thicknesses scaled from grain to rod", long_lever},
  {"short_lever", "as `calibrated`, but grains as stiff as contacts and L_r = B/7", short_lever},
  {"replacing", "bonds replace the grain contact and form under 50 kPa; L_r = B/14, bond thicknesses scaled from grain to rod", replacing},
  {"literal", "as printed: a bond replaces the grain contact, L_r = 1 m, the strengths of Eq. 15", literal},
};

constexpr PresetKey standard[] = {
  {"test.inertial_number", "2e-4"}, {"test.max_platen_wave_stress", "0.13"}, {"run.precision", "mixed"}, {"run.time_step_safety", ""}, {"run.rotational_inertia_factor", "3"}, {"run.mass_scaled_fraction", "0"}};
constexpr PresetKey reference[] = {
  {"test.inertial_number", "1e-5"}, {"test.max_platen_wave_stress", "0.05"}, {"run.precision", "double"}, {"run.time_step_safety", "0.475"}, {"run.rotational_inertia_factor", "1"}, {"run.mass_scaled_fraction", "0"}};
constexpr PresetKey draft[] = {
  {"test.inertial_number", "1e-3"}, {"test.max_platen_wave_stress", "0.5"}, {"run.precision", "mixed"}, {"run.time_step_safety", ""}, {"run.rotational_inertia_factor", "3"}, {"run.mass_scaled_fraction", "0"}};
constexpr Preset all_run_presets[] = {
  {"standard", "the usual choice: moments of inertia times 3, numbers in 32 bits; peak of q 0.5 +- 0.6 % off `reference` (docs/explanation/accuracy.md)", standard},
  {"reference", "for comparisons: true moments of inertia, half the time step, a twentieth of the usual rate, less for tall specimens, numbers in 64 bits", reference},
  {"draft", "a first look: five times the usual rate; the peak of q is 2 to 6 % too high", draft},
};
// clang-format on

/// The names of presets, for the schema's lists of choices.
template <std::size_t count>
constexpr std::array<std::string_view, count> names_of(Preset const (&presets)[count]) {
  std::array<std::string_view, count> all;
  for (std::size_t i = 0; i < count; ++i) all[i] = presets[i].name;
  return all;
}
constexpr auto bond_preset_names = names_of(all_bond_presets);
constexpr auto run_preset_names = names_of(all_run_presets);

/// What a preset gives a key, in a word where it leaves it alone.
std::string_view shown(PresetKey const& said) { return said.value.empty() ? "default" : said.value; }

}  // namespace

PresetGroup const& bond_presets() {
  static constexpr PresetGroup group = {"bond.preset", all_bond_presets, bond_preset_names};
  return group;
}

PresetGroup const& run_presets() {
  static constexpr PresetGroup group = {"run.preset", all_run_presets, run_preset_names};
  return group;
}

Preset const& PresetGroup::of(std::string_view name) const {
  auto const found = std::find_if(presets.begin(), presets.end(), [&](Preset const& preset) { return preset.name == name; });
  if (found == presets.end()) throw std::invalid_argument(fmt::format("{} has no '{}'", key, name));
  return *found;
}

void apply_preset(Preset const& preset, Scene& scene, std::function<bool(std::string_view)> const& stated) {
  for (PresetKey const& said : preset.keys)
    if (!stated(said.key)) set_stated(*find_key(said.key), scene, said.value);
}

std::string presets_markdown(PresetGroup const& group) {
  std::string text;
  for (Preset const& preset : group.presets) text += fmt::format("- `{}`: {}.\n", preset.name, preset.what);
  std::string rule = "|---|";
  text += "\n| key |";
  for (Preset const& preset : group.presets) text += fmt::format(" `{}` |", preset.name), rule += "---|";
  text += "\n" + rule + "\n";
  for (std::size_t k = 0; k < group.presets.front().keys.size(); ++k) {
    text += fmt::format("| `{}` |", group.presets.front().keys[k].key);
    for (Preset const& preset : group.presets) text += fmt::format(" {} |", shown(preset.keys[k]));
    text += "\n";
  }
  return text;
}

}  // namespace clathra
