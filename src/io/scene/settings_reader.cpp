#include "io/scene/settings_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <stdexcept>

#include "io/scene/scene_value.hpp"
#include "io/scene/schema.hpp"

namespace clathra {
namespace {

constexpr std::size_t most_letters = 200;

/// Whether a text can be the name of a group and of its members' folders, which are not to be hidden.
bool is_name(std::string_view text) {
  return !text.starts_with('.') && std::all_of(text.begin(), text.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '_' || c == '+' || c == '-';
  });
}

bool is_range(TomlTable const& table) { return table.find("from") || table.find("to") || table.find("count"); }

/// Groups whose material is not stated and that differ in nothing but the confining stress are tests of one material.
void name_materials(std::vector<StudyGroup>& groups) {
  auto const without_stress = [](StudyGroup const& group) {
    std::map<std::string, std::string> settings(group.settings.begin(), group.settings.end());
    settings.erase(stress_key);
    return settings;
  };
  std::map<std::map<std::string, std::string>, std::string> names;
  for (StudyGroup const& group : groups) {
    if (!group.material.empty()) continue;
    std::string& name = names[without_stress(group)];
    if (name.size() + group.name.size() < most_letters) name += (name.empty() ? "" : "+") + group.name;
  }
  for (StudyGroup& group : groups)
    if (group.material.empty()) group.material = names.at(without_stress(group));
}

/// A text, number or truth value as a text.
std::optional<std::string> scalar_text(TomlNode const& node) {
  if (auto const* const quoted = node.as<std::string>()) return *quoted;
  if (auto const* const whole = node.as<std::int64_t>()) return fmt::format("{}", *whole);
  if (auto const* const number = node.as<double>()) return fmt::format("{}", *number);
  if (auto const* const truth = node.as<bool>()) return *truth ? "true" : "false";
  return {};
}

}  // namespace

std::vector<TomlEntry> SettingsReader::in_order(TomlTable const& table) {
  std::vector<TomlEntry> entries = table.entries;
  std::stable_sort(entries.begin(), entries.end(), [](TomlEntry const& a, TomlEntry const& b) {
    return std::pair(a.node.line, a.node.column) < std::pair(b.node.line, b.node.column);
  });
  return entries;
}

void SettingsReader::for_each_key(TomlNode const& section, char const* what, Found const& found) {
  auto const* const table = section.as<TomlTable>();
  if (!table) return report(section, fmt::format("'{}' is a section: write [{}] and keys of the scene below", what, what));
  std::map<std::string, int> lines;
  auto const take = [&](std::string const& name, TomlNode const& node) {
    auto const [first, is_new] = lines.emplace(name, node.line);
    if (is_new) return found(name, node);
    report(node, fmt::format("'{}' is stated twice, in lines {} and {}: leave one of them out", name, first->second, node.line));
  };
  for (TomlEntry const& entry : in_order(*table)) {
    auto const* const nested = entry.node.as<TomlTable>();
    if (!nested || is_range(*nested))
      take(entry.name, entry.node);
    else
      for (TomlEntry const& leaf : in_order(*nested)) take(entry.name + "." + leaf.name, leaf.node);
  }
}

Key const* SettingsReader::known(std::string const& name, TomlNode const& node) {
  if (char const* const instead = key_of_each_run(name))
    return report(node, fmt::format("'{}' cannot be varied here: {}", name, instead)), nullptr;
  Key const* const key = find_key(name);
  if (!key) report(node, fmt::format("unknown key '{}' of a scene{}", name.substr(0, 100), key_suggestion(name)));
  return key;
}

std::optional<std::string> SettingsReader::value_of(Key const& key, TomlNode const& node) {
  std::optional<std::string> text = scalar_text(node);
  if (auto const* const list = node.as<TomlList>(); list && key.kind == Kind::quantities) {
    std::string items;
    for (TomlNode const& item : *list)
      items += (items.empty() ? "" : ", ") +
               (item.as<std::string>() ? '"' + *item.as<std::string>() + '"' : scalar_text(item).value_or("?"));
    text = "[" + items + "]";
  }
  if (!text) return report(node, fmt::format("'{}' needs one value here", key.name)), std::nullopt;
  try {
    Scene scratch;
    set_stated(key, scratch, *text);
  } catch (std::invalid_argument const& problem) {
    return report(node, fmt::format("'{}' {}", key.name, problem.what())), std::nullopt;
  }
  if (key.kind == Kind::path && !text->empty()) text = (path_.parent_path() / *text).lexically_normal().string();
  return text;
}

std::vector<StudyGroup> SettingsReader::read_groups(TomlNode const& section, Own const& own) {
  std::vector<StudyGroup> all;
  auto const* const groups = section.as<TomlTable>();
  if (!groups) return report(section, "'groups' holds sections: write [groups.NAME] and keys of the scene below"), all;
  for (auto const& [name, line, column, node] : in_order(*groups)) {
    if (name.empty() || !is_name(name) || name.size() > most_letters) {
      report(node,
             fmt::format("'{}' is no name of a group: letters, digits and ._+- only, {} at most, none of them a dot in front",
                         name.substr(0, most_letters), most_letters));
      continue;
    }
    StudyGroup group{name, {}, ""};
    for_each_key(node, "groups.NAME", [&](std::string const& key_name, TomlNode const& value_node) {
      if (key_name == "material") return read_material(value_node, group);
      if (own(key_name, value_node, group)) return;
      if (Key const* const key = known(key_name, value_node))
        if (auto value = value_of(*key, value_node)) group.settings.emplace_back(key_name, std::move(*value));
    });
    all.push_back(std::move(group));
  }
  name_materials(all);
  return all;
}

void SettingsReader::read_material(TomlNode const& node, StudyGroup& group) {
  auto const* const text = node.as<std::string>();
  if (!text || text->empty() || text->size() > most_letters)
    return report(node, fmt::format("'material' needs a name in quotes, {} letters at most", most_letters));
  group.material = *text;
}

}  // namespace clathra
