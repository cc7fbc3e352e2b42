#include "io/scene/stage_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "domain/scene/scene.hpp"
#include "io/scene/scene_value.hpp"

namespace clathra {
namespace {

LoadingStage& last_stage(Scene& scene) { return scene.stages.empty() ? scene.stages.emplace_back() : scene.stages.back(); }

template <auto Member>
auto& of_stage(Scene& scene) {
  return last_stage(scene).*Member;
}

template <auto Part, auto Member>
auto& of_part(Scene& scene) {
  return (last_stage(scene).*Part).*Member;
}

template <auto Side>
constexpr ChoiceField follow_of() {
  return {[](Scene const& scene) { return static_cast<int>((last_stage(const_cast<Scene&>(scene)).*Side).follow); },
          [](Scene& scene, int place) { (last_stage(scene).*Side).follow = static_cast<Follow>(place); }};
}

using Stage = LoadingStage;
using enum Dimension;
using enum Kind;
constexpr std::array follows = {std::string_view("nothing"), std::string_view("constant_volume"),
                                std::string_view("constant_mean_stress")};
constexpr std::array dissociations = {std::string_view("given"), std::string_view("instant"), std::string_view("clarke_2001"),
                                      std::string_view("kim_1987"), std::string_view("slow")};
constexpr ChoiceField dissociation_field = {
    [](Scene const& scene) { return static_cast<int>(last_stage(const_cast<Scene&>(scene)).hydrate.dissociation); },
    [](Scene& scene, int place) { last_stage(scene).hydrate.dissociation = static_cast<Dissociation>(place); }};
constexpr char none[] = "not stated", stays[] = "it stays as it is", no_end[] = "no end of this stage";

// clang-format off
Key const table[] = {
  {"name", text, of_stage<&Stage::name>, "name of the stage in history.csv and run.json, of letters, digits, blanks and ._-; each once"},
  {"vertical.hold", boolean, of_part<&Stage::vertical, &SideScene::hold>, "top and bottom stand"},
  {"vertical.inertial_number", quantity, of_part<&Stage::vertical, &SideScene::inertial_number>, "rate of top and bottom as an inertial number I; negative opens", ratio, -1, 1, none},
  {"vertical.strain_rate", quantity, of_part<&Stage::vertical, &SideScene::strain_rate>, "rate of top and bottom; negative opens", rate, -1e6, 1e6, none},
  {"vertical.stress", quantity, of_part<&Stage::vertical, &SideScene::stress>, "effective vertical stress sigma_1 that is put on and held", pressure, 1e3, 1e9, none},
  {"vertical.follow", choice, follow_of<&Stage::vertical>(), "what top and bottom keep, whatever the sides do: the volume, or p = (sigma_1 + sigma_3) / 2", ratio, 0, 0, {}, follows},
  {"vertical.fluid_modulus", quantity, of_part<&Stage::vertical, &SideScene::fluid_modulus>, "bulk modulus of the fluid that keeps the volume which top and bottom follow", pressure, 1e5, 1e12, "the fluid does not give way"},
  {"lateral.hold", boolean, of_part<&Stage::lateral, &SideScene::hold>, "left and right stand"},
  {"lateral.inertial_number", quantity, of_part<&Stage::lateral, &SideScene::inertial_number>, "rate of left and right as an inertial number I; negative opens", ratio, -1, 1, none},
  {"lateral.strain_rate", quantity, of_part<&Stage::lateral, &SideScene::strain_rate>, "rate of left and right; negative opens", rate, -1e6, 1e6, none},
  {"lateral.stress", quantity, of_part<&Stage::lateral, &SideScene::stress>, "effective lateral stress sigma_3 that is put on and held", pressure, 1e3, 1e9, none},
  {"lateral.follow", choice, follow_of<&Stage::lateral>(), "what left and right keep, whatever top and bottom do: the volume, or p = (sigma_1 + sigma_3) / 2", ratio, 0, 0, {}, follows},
  {"lateral.fluid_modulus", quantity, of_part<&Stage::lateral, &SideScene::fluid_modulus>, "bulk modulus of the fluid that keeps the volume which left and right follow", pressure, 1e5, 1e12, "the fluid does not give way"},
  {"increments", integer, of_stage<&Stage::increments>, "increments, by equal factors, in which stresses are put on, with rest after each", ratio, 1, 1e4},
  {"allow_unsettled", boolean, of_stage<&Stage::allow_unsettled>, "go on where the specimen does not come to rest within test.consolidation_steps"},
  {"forms_hydrate", boolean, of_stage<&Stage::forms_hydrate>, "hydrate forms when the stage begins, under the stresses that then act, and not in the consolidation"},
  {"hydrate.temperature", quantity, of_part<&Stage::hydrate, &HydrateChange::temperature>, "temperature of the hydrate by the end of the stage, in a straight line over its increments", temperature, -100, 100, stays},
  {"hydrate.pore_pressure", quantity, of_part<&Stage::hydrate, &HydrateChange::pore_pressure>, "pore pressure likewise", pressure, 1e3, 1e9, stays},
  {"hydrate.saturation", quantity, of_part<&Stage::hydrate, &HydrateChange::saturation>, "saturation likewise; hydrate does not form again", ratio, 0, 1, stays},
  {"hydrate.constant_total_stress", boolean, of_part<&Stage::hydrate, &HydrateChange::constant_total_stress>, "the effective stresses of the sides fall by what the pore pressure rises; else they stay"},
  {"hydrate.undrained", boolean, of_part<&Stage::hydrate, &HydrateChange::undrained>, "likewise, with a pore pressure that stays until the boundary of stability is met, and follows that from there"},
  {"hydrate.dissociation", choice, dissociation_field, "saturation beyond the boundary of stability: as given, lost at once, or at a rate that was measured (docs/howto/changing-hydrate.md)", ratio, 0, 0, {}, dissociations},
  {"hydrate.duration", quantity, of_part<&Stage::hydrate, &HydrateChange::duration>, "how long the stage lasts, for a rate of dissociation", Dimension::duration, 1e-3, 1e10, none},
  {"turn.deviator_stress", quantities, of_part<&Stage::turn, &StageTurn::deviator_stress>, "two values of q = sigma_1 - sigma_3 between which the vertical rate goes back and forth", pressure, -1e9, 1e9},
  {"turn.axial_strain", quantities, of_part<&Stage::turn, &StageTurn::axial_strain>, "two axial strains since the consolidation between which the vertical rate goes back and forth", ratio, -0.5, 0.5},
  {"until.axial_strain", quantity, of_part<&Stage::until, &StageEnd::axial_strain>, "natural axial strain since the consolidation at which the stage ends, from either side", ratio, -0.5, 0.5, no_end},
  {"until.volumetric_strain", quantity, of_part<&Stage::until, &StageEnd::volumetric_strain>, "natural volumetric strain likewise, contraction positive", ratio, -0.5, 0.5, no_end},
  {"until.deviator_stress", quantity, of_part<&Stage::until, &StageEnd::deviator_stress>, "q = sigma_1 - sigma_3 likewise", pressure, -1e9, 1e9, no_end},
  {"until.mean_stress", quantity, of_part<&Stage::until, &StageEnd::mean_stress>, "p = (sigma_1 + sigma_3) / 2 likewise", pressure, 0, 1e9, no_end},
  {"until.stress_ratio", quantity, of_part<&Stage::until, &StageEnd::stress_ratio>, "q / p likewise", ratio, -2, 2, no_end},
  {"until.path", quantity, of_part<&Stage::until, &StageEnd::path>, "path of the axial strain within the stage, back and forth", ratio, 1e-6, 100, "refused after 50 % without an end"},
  {"until.strain_rate", quantity, of_part<&Stage::until, &StageEnd::strain_rate>, "strain rate of the faster sides under their stresses, that is to be fallen below for three looks on end", rate, 1e-9, 1e6, no_end},
  {"until.cycles", integer, of_part<&Stage::until, &StageEnd::cycles>, "cycles of two turns each", ratio, 1, 1e6, no_end},
  {"until.rest", boolean, of_part<&Stage::until, &StageEnd::rest>, "the stage ends where the specimen rests under its stresses"},
};
// clang-format on

/// What must be given exactly once for a pair of sides.
int controls_of(SideScene const& side) {
  return (side.hold ? 1 : 0) + (side.inertial_number != 0 ? 1 : 0) + (side.strain_rate != 0 ? 1 : 0) +
         (side.has_stress() ? 1 : 0) + (side.follow != Follow::nothing ? 1 : 0);
}

bool is_good_name(std::string_view name) {
  constexpr std::size_t longest = 60;
  bool const is_number = name.find_first_not_of("0123456789") == std::string_view::npos;  // --set takes it for a place
  return !name.empty() && !is_number && name.size() <= longest && name.front() != ' ' && name.back() != ' ' &&
         std::all_of(name.begin(), name.end(), [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                  std::string_view(" ._-").find(c) != std::string_view::npos;
         });
}

/// Tells each thing that is wrong with one stage.
template <class Say>
void check_sides(LoadingStage const& stage, Say const& say) {
  for (auto const& [name, side] : {std::pair{"vertical", &stage.vertical}, std::pair{"lateral", &stage.lateral}})
    if (controls_of(*side) != 1)
      say(fmt::format("'{}' needs exactly one of hold, inertial_number, strain_rate, stress and follow, {} are given", name,
                      controls_of(*side)));
  for (SideScene const* const side : {&stage.vertical, &stage.lateral})
    if (side->fluid_modulus > 0 && side->follow != Follow::constant_volume)
      say("'fluid_modulus' needs 'follow' = \"constant_volume\"");
  if (stage.vertical.follow != Follow::nothing && stage.lateral.follow != Follow::nothing)
    say("'vertical' and 'lateral' cannot both follow each other");
  if (stage.vertical.hold && stage.lateral.hold) say("'vertical' and 'lateral' both hold: nothing would move");
  bool const one_follows = stage.vertical.follow != Follow::nothing || stage.lateral.follow != Follow::nothing;
  if (one_follows && (stage.vertical.hold || stage.lateral.hold))
    say("one pair of sides follows the other, which holds: nothing would move");
}

template <class Say>
void check_ends(LoadingStage const& stage, Say const& say) {
  StageTurn const& turn = stage.turn;
  if (!stage.until.any()) say("'until' states no end of the stage");
  if (stage.until.rest && !stage.has_stress_only())
    say("'until.rest' needs sides that hold or have a stress: a rate does not come to rest");
  if (stage.until.strain_rate > 0 && !stage.has_stress_only())
    say("'until.strain_rate' needs sides that hold or have a stress: a rate is what it is");
  if (turn.any() && !stage.vertical.has_rate()) say("'turn' needs a rate of 'vertical'");
  if (!turn.axial_strain.empty() && !turn.deviator_stress.empty())
    say("give either 'turn.deviator_stress' or 'turn.axial_strain', not both");
  for (auto const* const marks : {&turn.axial_strain, &turn.deviator_stress})
    if (!marks->empty() && marks->size() != 2) say(fmt::format("'turn' needs two different values, {} are given", marks->size()));
  if (stage.until.cycles > 0 && !turn.any()) say("'until.cycles' needs 'turn'");
  if (turn.any() && stage.until.cycles == 0 && stage.until.path == 0)
    say("'turn' needs 'until.cycles' or 'until.path': nothing else ends it for certain");
  if (stage.increments > 1 && !stage.hydrate.any() &&
      (!stage.has_stress_only() || !stage.until.rest || !(stage.vertical.has_stress() || stage.lateral.has_stress())))
    say("'increments' need a stress, no rate, and 'until.rest' = true");
}

template <class Say>
void check_hydrate_of_stage(LoadingStage const& stage, Say const& say) {
  HydrateChange const& change = stage.hydrate;
  if (!change.any()) {
    if (change.holds_total_stress()) say("'hydrate' says how stresses follow, but nothing that changes");
    return;
  }
  if (!stage.has_stress_only()) say("'hydrate' changes while sides hold or have a stress, not a rate");
  if (!stage.until.rest)
    say("'hydrate' needs 'until.rest' = true: each of its increments waits for it, and the stage ends after the last");
  if (change.undrained && !is_given(change.temperature)) say("'hydrate.undrained' needs 'hydrate.temperature'");
  if (change.undrained && is_given(change.pore_pressure))
    say("'hydrate.pore_pressure' follows the temperature where 'hydrate.undrained' is true: leave one of them out");
  if (change.dissociates() && is_given(change.saturation))
    say("'hydrate.saturation' follows from 'hydrate.dissociation': leave one of them out");
  if (change.dissociates() && change.undrained)
    say("'hydrate.undrained' keeps hydrate on the boundary of stability, where 'hydrate.dissociation' has no rate: state "
        "'hydrate.saturation'");
  if (change.has_rate() && change.duration == 0) say("a rate of 'hydrate.dissociation' needs 'hydrate.duration'");
  if (!change.has_rate() && change.duration > 0)
    say("'hydrate.duration' needs 'hydrate.dissociation' = \"clarke_2001\", \"kim_1987\" or \"slow\": else nothing in a stage "
        "knows "
        "a time");
  if (change.holds_total_stress() && !stage.vertical.has_stress() && !stage.lateral.has_stress())
    say("a constant total stress needs a stress of 'vertical' or 'lateral'");
}

}  // namespace

std::span<Key const> stage_schema() { return table; }

Key const* find_stage_key(std::string_view name) {
  auto const found = std::find_if(std::begin(table), std::end(table), [&](Key const& key) { return key.name == name; });
  return found == std::end(table) ? nullptr : found;
}

bool is_stage_section(std::string_view name) {
  return std::any_of(std::begin(table), std::end(table),
                     [&](Key const& key) { return key.section() == name && key.leaf() != name; });
}

std::string stage_key_suggestion(std::string_view name) {
  std::vector<std::string_view> names;
  for (Key const& key : table) names.push_back(key.name);
  if (std::string const text = name_suggestion(name, names); !text.empty()) return text;
  std::string_view const leaf = name.substr(name.find('.') + 1);
  for (Key const& key : table)
    if (key.leaf() == leaf) return fmt::format("; did you mean '{}'?", key.name);
  return "";
}

std::string stage_setting_suggestion(std::string_view name) {
  std::size_t const leaf = name.rfind('.'), part = leaf == 0 || leaf == name.npos ? name.npos : name.rfind('.', leaf - 1);
  for (std::size_t const dot : {part, leaf})
    if (dot != name.npos)
      if (std::string text = stage_key_suggestion(name.substr(dot + 1)); !text.empty()) return text;
  return "";
}

std::optional<StageSetting> stage_setting(std::string_view name) {
  constexpr std::string_view before = "stage.";
  if (!name.starts_with(before)) return {};
  name.remove_prefix(before.size());
  // A name of a stage may have dots: the key is what the rest ends in.
  for (Key const& key : table)
    if (name.ends_with(key.name) && name.size() > key.name.size() + 1 && name[name.size() - key.name.size() - 1] == '.')
      return StageSetting{std::string(name.substr(0, name.size() - key.name.size() - 1)), &key};
  return {};
}

std::vector<std::pair<std::string, std::string>> stage_texts(LoadingStage const& stage) {
  Scene scene;
  scene.stages = {stage};
  std::vector<std::pair<std::string, std::string>> texts;
  for (Key const& key : table)
    if (!is_not_given(key, scene))
      if (std::string value = value_text(key, scene); value != value_text(key, Scene{}))
        texts.emplace_back(key.name, std::move(value));
  return texts;
}

std::string stages_toml(std::vector<LoadingStage> const& stages, std::string_view before) {
  std::string text;
  for (LoadingStage const& stage : stages) {
    text += fmt::format("\n{}[[stage]]\n", before);
    for (auto const& [key, value] : stage_texts(stage)) text += fmt::format("{}{} = {}\n", before, key, value);
  }
  return text;
}

LoadingStage stage_of_texts(std::vector<std::pair<std::string, std::string>> const& texts) {
  Scene scene;
  for (auto const& [name, value] : texts) {
    Key const* const key = find_stage_key(name);
    if (!key) throw std::invalid_argument(fmt::format("there is no key '{}' of a stage", name.substr(0, 60)));
    set_from_text(*key, scene, unquoted(value));
  }
  return last_stage(scene);
}

std::vector<StageProblem> stage_problems(std::vector<LoadingStage> const& stages) {
  std::vector<StageProblem> problems;
  std::size_t formed_in = stages.size();
  for (std::size_t i = 0; i < stages.size(); ++i) {
    LoadingStage const& stage = stages[i];
    auto const say = [&](std::string text) {
      problems.push_back({i, fmt::format("stage {} ('{}'): {}", i + 1, stage.name.substr(0, 60), text)});
    };
    if (!is_good_name(stage.name))
      say("'name' must be given, of letters, digits, blanks and ._-, 60 at most, no blank at its ends, not of digits alone");
    for (std::string_view const reserved : {"generate", "prepare", "plan"})
      if (stage.name == reserved || is_consolidation(stage.name)) {
        say("this name is that of a part of each run: choose another");
        break;
      }
    for (std::size_t k = 0; k < i; ++k)
      if (stages[k].name == stage.name) say(fmt::format("stage {} has the same name", k + 1));
    check_sides(stage, say);
    check_ends(stage, say);
    check_hydrate_of_stage(stage, say);
    if (stage.forms_hydrate && formed_in < i) say(fmt::format("hydrate forms in stage {} already", formed_in + 1));
    if (stage.forms_hydrate) formed_in = std::min(formed_in, i);
  }
  for (std::size_t i = 0; i < formed_in && formed_in < stages.size(); ++i)
    if (stages[i].hydrate.any())
      problems.push_back({i, fmt::format("stage {} ('{}'): 'hydrate' changes before it forms in stage {}", i + 1,
                                         stages[i].name.substr(0, 60), formed_in + 1)});
  return problems;
}

}  // namespace clathra
