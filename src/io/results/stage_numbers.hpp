#pragma once
/// What the numbers of a run's stages mean: for run.json and `clathra info`.
#include <string>
#include <string_view>

namespace clathra {

/// Whose number it is: "generate", "prepare", "plan", or a stage of the loading.
/// @return what `name` says in that stage, with its source equation; empty where nothing is known
std::string meaning_of(std::string_view stage, std::string_view name);

}  // namespace clathra
