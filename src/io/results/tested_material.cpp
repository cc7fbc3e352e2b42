#include "io/results/tested_material.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <string_view>

#include "io/results/run_record.hpp"
#include "io/scene/schema.hpp"

namespace clathra {
namespace {

/// Keys that cannot matter to the strength of a material.
bool is_indifferent(std::string_view key) {
  static std::set<std::string_view> const names{"run.seed", "run.threads", "run.ignore_guards", "run.verlet_skin",
                                                "specimen.file"};
  return names.count(key) > 0 || key.starts_with("output.");
}

/// Keys that matter only to bonds.
bool is_of_bonds(std::string_view key) { return key.starts_with("hydrate.") || key.starts_with("bond."); }

std::string text_of(std::string const& name, nlohmann::json const& value, std::filesystem::path const& folder) {
  if (name == "grading.file" && value.is_string() && value != "")  // kept relative to the folder of the run
    return std::filesystem::absolute(folder / value.get<std::string>()).lexically_normal().string();
  Key const* const key = find_key(name);
  if (key && key->kind == Kind::quantity && value.is_number()) return format_quantity(value.get<double>(), key->dimension);
  return value.is_string() ? value.get<std::string>() : value.dump();
}

/// Takes the values of a scene into those of a material.
void take(SceneValues& values, nlohmann::json const& scene, std::filesystem::path const& folder) {
  for (auto const& [section, keys] : scene.items())
    if (keys.is_object())
      for (auto const& [leaf, value] : keys.items())
        if (std::string const name = section + "." + leaf; !is_indifferent(name)) values[name] = text_of(name, value, folder);
}

/// A key without its section where that says nothing more.
std::string name_in_words(std::string const& name) {
  std::string const section = name.substr(0, name.find('.')), leaf = name.substr(name.find('.') + 1);
  auto const has_leaf = [&](Key const& key) { return key.leaf() == leaf; };
  bool const ambiguous = std::count_if(schema().begin(), schema().end(), has_leaf) > 1;
  std::string words = section == "bond" || section == "damping" || ambiguous ? section + " " + leaf : leaf;
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

std::string value_in_words(std::string const& name, std::string const& value) {
  Key const* const key = find_key(name);
  bool const absent = value.empty() || (key && !key->zero.empty() && std::strtod(value.c_str(), nullptr) == 0);
  return absent ? "not given" : value;
}

}  // namespace

SceneValues material_of(RunResults const& run) {
  SceneValues values;
  take(values, scene_json(Scene{}), run.folder);
  if (auto const scene = run.record.find("scene"); scene != run.record.end() && scene->is_object())
    take(values, *scene, run.folder);
  else
    values["scene"] = "of " + run.name;  // unknown, so like no other
  if (run.text("/scene/specimen/file").value_or("") != "") {
    if (auto const discs = run.number("/stages/plan/particles")) values["specimen.particles"] = fmt::format("{:.0f}", *discs);
    if (auto const ratio = run.number("/stages/prepare/void_ratio_before_consolidation"))
      values["specimen.void_ratio"] = fmt::format("{:.3f}", *ratio);
  }
  if (!run.has_bonds()) {
    std::erase_if(values, [](auto const& entry) { return is_of_bonds(entry.first); });
    values["hydrate.saturation"] = "0";
  }
  return values;
}

std::vector<std::string> differing_keys(std::vector<SceneValues> const& materials) {
  std::set<std::string> names;
  for (SceneValues const& material : materials)
    for (auto const& entry : material) names.insert(entry.first);
  std::vector<std::string> different;
  for (std::string const& name : names) {
    std::set<std::string> values;
    for (SceneValues const& material : materials) {
      auto const found = material.find(name);
      values.insert(found == material.end() ? "" : found->second);
    }
    if (values.size() > 1) different.push_back(name);
  }
  return different;
}

std::string in_words(SceneValues const& material, std::vector<std::string> const& keys) {
  std::string text;
  for (std::string const& name : keys)
    if (auto const found = material.find(name); found != material.end())
      text += (text.empty() ? "" : ", ") + name_in_words(name) + " " + value_in_words(name, found->second);
  return text;
}

}  // namespace clathra
