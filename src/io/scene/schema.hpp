#pragma once
/// The one table of a scene's keys: where a value goes, what it may be, what it means. Reading, range checks, suggestions,
/// `--set`, the resolved echo and the help all come from it; the defaults are those of `Scene{}`.
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "domain/scene/scene.hpp"
#include "domain/scene/units.hpp"

namespace clathra {

/// Names of keys that tests are told apart or grouped by.
inline constexpr char stress_key[] = "test.confining_stress", saturation_key[] = "hydrate.saturation";

/// An enumeration of the scene, read and written by the place of its name in `Key::choices`.
struct ChoiceField {
  int (*get)(Scene const&);
  void (*set)(Scene&, int);
};

/// The place of a value in a Scene.
using SceneField =
    std::variant<double& (*)(Scene&), int& (*)(Scene&), std::int64_t& (*)(Scene&), std::uint64_t& (*)(Scene&), bool& (*)(Scene&),
                 std::string& (*)(Scene&), std::vector<double>& (*)(Scene&), RollingLever& (*)(Scene&), ChoiceField>;

/// quantities: a list of them, each in the allowed range; lever: a length, or a multiple of the bond width, as "0.25 B".
enum class Kind { quantity, quantities, lever, integer, boolean, choice, text, path };

/// One key. A path is relative to the folder of the scene file.
struct Key {
  std::string_view name;  ///< dotted: "test.confining_stress"
  Kind kind;
  SceneField field;
  std::string_view help;                        ///< a sentence without full stop
  Dimension dimension = Dimension::ratio;       ///< of a quantity
  double least = 0, most = 0;                   ///< allowed, both included; of quantities (SI) and integers
  std::string_view zero = {};                   ///< what holds where a Scene has 0 for it: where it is not given, or where 0 is
  std::span<std::string_view const> choices{};  ///< names of a choice, in the order of the enumerators
  bool takes_zero = false;                      ///< 0 may be stated besides the range

  std::string_view section() const { return name.substr(0, name.find('.')); }
  std::string_view leaf() const { return name.substr(name.find('.') + 1); }
};

/// All keys, in the order of the fields of Scene.
std::span<Key const> schema();

/// The key of a dotted name, of one stage also as "stage.2.until.path" (stage_setting()), or nullptr.
Key const* find_key(std::string_view name);

/// Whether a name is that of a section.
bool is_section(std::string_view name);

/// The nearest right name of a mistaken dotted key: "; did you mean 'time_step_safety'?" (with its section where that differs),
/// or nothing.
std::string key_suggestion(std::string_view name);
/// The same for a key that stands below [section]: "did you mean 'friction'?", or "... 'confining_stress' in [test]?"
std::string key_suggestion_in(std::string_view section, std::string_view name);

/// The nearest of some names, "; did you mean 'parallel'?", or nothing where none is near.
std::string name_suggestion(std::string_view name, std::span<std::string_view const> names);

}  // namespace clathra
