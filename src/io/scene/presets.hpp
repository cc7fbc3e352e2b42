#pragma once
/// Named sets of scene keys: answers to what Jiang et al. (2017) leave open, and points of the trade of speed for accuracy. A
/// preset stands in for the defaults of those of its keys that a scene does not state itself.
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "domain/scene/scene.hpp"

namespace clathra {

/// A key and the value that the preset gives it, as a scene states it.
struct PresetKey {
  std::string_view key, value;
};

struct Preset {
  std::string_view name;  ///< of the key that names one
  std::string_view what;  ///< a sentence without full stop
  std::span<PresetKey const> keys;
};

/// The presets that one key of a scene chooses from, the default one first: what it says are the defaults of Scene{}. All of them
/// say the same keys.
struct PresetGroup {
  std::string_view key;  ///< that names one of them
  std::span<Preset const> presets;
  std::span<std::string_view const> names;  ///< in the same order

  /// The preset of one of the names. @throws std::invalid_argument
  Preset const& of(std::string_view name) const;
};

PresetGroup const& bond_presets();  ///< of bond.preset
PresetGroup const& run_presets();   ///< of run.preset

/// Sets the keys of a preset but for those that are `stated` otherwise.
void apply_preset(Preset const& preset, Scene& scene, std::function<bool(std::string_view)> const& stated);

/// What the presets of a group are, and a table with a column each.
std::string presets_markdown(PresetGroup const& group);

}  // namespace clathra
