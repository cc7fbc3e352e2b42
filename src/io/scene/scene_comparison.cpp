#include "io/scene/scene_comparison.hpp"

#include <fmt/format.h>

#include "io/scene/scene_value.hpp"
#include "io/scene/schema.hpp"
#include "io/scene/stage_keys.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

constexpr char stages_name[] = "stage";

/// Keys that do not change what is computed. run.preset is a name for values of others.
bool may_differ(Key const& key) {
  return key.name == "output.folder" || key.name == "run.preset" || key.name == "run.threads" ||
         key.name == "run.ignore_guards" || key.name == "specimen.file" || key.name == "output.keep_checkpoint";
}

/// Where test.axial_strain is no more than the end of the last stage.
bool ends_by_strain(TestScene const& test) {
  switch (test.kind) {
    case TestKind::unload_reload:
      return !test.unload_at.empty();
    case TestKind::isotropic:
    case TestKind::oedometer:
    case TestKind::cyclic:
    case TestKind::heating:
    case TestKind::depressurisation:
    case TestKind::list:
      return false;
    default:
      return true;
  }
}

bool may_grow(Key const& key, Scene const& scene) {
  return key.name == "output.snapshots_at" || (key.name == "test.axial_strain" && ends_by_strain(scene.test));
}

bool same_file(std::string const& then, std::string const& now, fs::path const& folder) {
  if (then.empty() || now.empty()) return then == now;
  std::error_code ignored;
  fs::path const here = fs::weakly_canonical(fs::absolute(now, ignored), ignored);
  return fs::weakly_canonical(fs::absolute(folder / then, ignored), ignored) == here ||
         fs::weakly_canonical(fs::absolute(then, ignored), ignored) == here;
}

/// Whether a text that was kept states the value of a scene.
bool states(Key const& key, std::string const& text, Scene const& scene, fs::path const& folder) {
  if (text == value_text(key, scene)) return true;
  return key.kind == Kind::path && same_file(unquoted(text), unquoted(value_text(key, scene)), folder);
}

}  // namespace

SceneTexts scene_texts(Scene const& scene, fs::path const& folder) {
  SceneTexts texts;
  Scene relative = scene;
  if (std::string& file = relative.grading.file; !file.empty()) file = fs::proximate(file, folder).string();
  for (Key const& key : schema())
    if (!may_differ(key)) texts[std::string(key.name)] = value_text(key, relative);
  if (!scene.stages.empty()) texts[stages_name] = stages_toml(scene.stages);
  return texts;
}

std::string scene_differences(SceneTexts const& then, Scene const& now, fs::path const& folder, Agreement agreement) {
  std::string text;
  for (Key const& key : schema()) {
    if (may_differ(key) || (agreement == Agreement::further && may_grow(key, now))) continue;
    auto const kept = then.find(std::string(key.name));
    std::string const before = kept != then.end() ? kept->second : "not known";
    if (!states(key, before, now, folder)) text += fmt::format("; {} was {}, is {}", key.name, before, value_text(key, now));
  }
  auto const kept = then.find(stages_name);
  if ((kept != then.end() ? kept->second : std::string()) != stages_toml(now.stages))
    text += "; the sections [[stage]] are others";
  return text;
}

}  // namespace clathra
