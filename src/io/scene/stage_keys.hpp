#pragma once
/// The keys of a [[stage]]: one table, as that of the other keys (schema.hpp). Their fields are those of the last stage of a
/// Scene, which gets one that states nothing where it has none.
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "domain/scene/loading_stage.hpp"
#include "io/scene/schema.hpp"

namespace clathra {

/// In the order of the fields of LoadingStage; names as "until.axial_strain".
std::span<Key const> stage_schema();
Key const* find_stage_key(std::string_view name);
/// Whether "until", "vertical", ... hold keys of a stage.
bool is_stage_section(std::string_view name);
/// "; did you mean 'until.axial_strain'?", or nothing.
std::string stage_key_suggestion(std::string_view name);

/// The same of a name as below whose key is mistaken.
std::string stage_setting_suggestion(std::string_view name);

/// "stage.2.until.path" or "stage.unloading.until.path": the key of one stage, by its number from 1 or its name.
struct StageSetting {
  std::string stage;
  Key const* key = nullptr;
};
/// Nothing where the name does not begin with "stage." or has no such key.
std::optional<StageSetting> stage_setting(std::string_view name);

/// What a stage states, key and value as in a scene file.
std::vector<std::pair<std::string, std::string>> stage_texts(LoadingStage const& stage);
/// The stages of a scene as a part of a scene file, each line behind `before`.
std::string stages_toml(std::vector<LoadingStage> const& stages, std::string_view before = "");
/// A stage from such texts. @throws std::invalid_argument
LoadingStage stage_of_texts(std::vector<std::pair<std::string, std::string>> const& texts);

/// What is wrong with a stage, and with which (from 0).
struct StageProblem {
  std::size_t stage;
  std::string text;
};
std::vector<StageProblem> stage_problems(std::vector<LoadingStage> const& stages);

}  // namespace clathra
