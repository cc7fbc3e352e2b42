#include "io/scene/scene_edit.hpp"

#include <algorithm>
#include <optional>

#include "io/errors/problems.hpp"
#include "io/scene/scene_file.hpp"
#include "io/scene/scene_reference.hpp"
#include "io/scene/scene_value.hpp"
#include "io/scene/schema.hpp"
#include "io/scene/stage_keys.hpp"

namespace clathra {
namespace {

std::string_view trimmed(std::string_view text) {
  auto const is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::vector<std::string> lines_of(std::string const& source) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < source.size();) {
    std::size_t const end = std::min(source.find('\n', begin), source.size());
    lines.push_back(source.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

/// "[test]" and "[test] # loading" -> "test"; nothing for other lines.
std::optional<std::string> header_of(std::string_view line) {
  line = trimmed(line);
  std::size_t const end = line.find(']');
  if (line.empty() || line.front() != '[' || end == std::string_view::npos) return {};
  return std::string(trimmed(line.substr(1, end - 1)));
}

/// The key that a line states, with its section.
std::string key_of(std::string_view line, std::string const& section) {
  std::size_t const equals = line.find('=');
  if (trimmed(line).starts_with('#') || equals == std::string_view::npos) return {};
  std::string name;
  for (char const c : trimmed(line.substr(0, equals)))
    if (c != ' ' && c != '\t' && c != '"' && c != '\'') name += c;
  return section.empty() ? name : section + "." + name;
}

/// Where each key is stated, and where sections begin.
struct Places {
  explicit Places(std::vector<std::string> const& lines) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (std::optional<std::string> const header = header_of(lines[i])) {
        section = *header;
        headers.emplace_back(section, i);
      } else if (std::string key = key_of(lines[i], section); !key.empty()) {
        keys.emplace_back(std::move(key), i);
      }
    }
  }
  static std::optional<std::size_t> in(std::vector<std::pair<std::string, std::size_t>> const& all, std::string_view name) {
    auto const found = std::find_if(all.begin(), all.end(), [&](auto const& one) { return one.first == name; });
    return found == all.end() ? std::nullopt : std::optional(found->second);
  }
  std::string section;
  std::vector<std::pair<std::string, std::size_t>> keys, headers;
};

/// Paths may be written in several ways.
bool loads_to(Scene const& wanted, std::string const& text, std::filesystem::path const& folder) {
  try {
    Scene const loaded = parse_scene(text, "scene", folder).scene;
    return std::all_of(
               schema().begin(), schema().end(),
               [&](Key const& key) { return key.kind == Kind::path || value_text(key, loaded) == value_text(key, wanted); }) &&
           stages_toml(loaded.stages) == stages_toml(wanted.stages);
  } catch (SceneProblems const&) {
    return false;
  }
}

std::string comment_line(SceneEdit const& edit) { return edit.comment.empty() ? "" : "# " + edit.comment + "\n"; }

}  // namespace

std::string edited_scene_text(std::string const& source, std::vector<SceneEdit> const& edits,
                              std::vector<std::string> const& left_out) {
  std::vector<std::string> lines = lines_of(source);
  Places const places(lines);
  std::vector<std::string> below(lines.size());  // what is put after a line
  std::vector<std::pair<std::string, std::string>> sections;
  for (std::string const& key : left_out)
    if (auto const at = Places::in(places.keys, key)) lines[*at] = "# " + lines[*at];
  for (SceneEdit const& edit : edits) {
    std::string const section = edit.key.substr(0, edit.key.find('.')), leaf = edit.key.substr(section.size() + 1);
    std::string const stated = comment_line(edit) + leaf + " = " + edit.value + "\n";
    if (auto const at = Places::in(places.keys, edit.key)) {
      bool const dotted = key_of(lines[*at], "") == edit.key;
      below[*at] = comment_line(edit) + (dotted ? edit.key : leaf) + " = " + edit.value + "\n";
      lines[*at] = "# " + lines[*at];
    } else if (auto const header = Places::in(places.headers, section)) {
      below[*header] += stated;
    } else {
      auto found = std::find_if(sections.begin(), sections.end(), [&](auto const& one) { return one.first == section; });
      if (found == sections.end()) found = sections.insert(sections.end(), {section, "\n[" + section + "]\n"});
      found->second += stated;
    }
  }
  std::string text;
  for (std::size_t i = 0; i < lines.size(); ++i) text += lines[i] + "\n" + below[i];
  for (auto const& section : sections) text += section.second;
  return text;
}

std::string scene_text_for(Scene const& wanted, std::string const& source, std::vector<SceneEdit> const& edits,
                           std::vector<std::string> const& left_out, std::filesystem::path const& folder) {
  std::string text = edited_scene_text(source, edits, left_out);
  if (loads_to(wanted, text, folder)) return text;
  Scene relative = wanted;
  for (std::string* const path : {&relative.specimen.file, &relative.grading.file})
    if (!path->empty()) *path = std::filesystem::proximate(*path, folder).string();
  std::string opening;
  for (SceneEdit const& edit : edits) opening += "# " + edit.key + ": " + edit.comment + "\n";
  std::vector<std::string_view> stated;
  for (Key const& key : schema())
    if (!is_not_given(key, wanted)) stated.push_back(key.name);
  return commented_scene(relative, stated, opening);
}

}  // namespace clathra
