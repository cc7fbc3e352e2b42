#include "io/scene/scene_reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "domain/scene/units.hpp"
#include "io/scene/presets.hpp"
#include "io/scene/rolling_lever_text.hpp"
#include "io/scene/scene_value.hpp"
#include "io/scene/stage_keys.hpp"

namespace clathra {
namespace {

using OrderedJson = nlohmann::ordered_json;

std::string limit_with_unit(Key const& key, double value) {
  if (key.kind != Kind::quantity && key.kind != Kind::quantities) return fmt::format("{:.0f}", value);
  std::string const text = format_quantity(value, key.dimension);
  bool const bare = text.find(' ') == std::string::npos && !bare_unit(key.dimension).empty();
  return bare ? fmt::format("{} {}", text, bare_unit(key.dimension)) : text;
}

/// Whether a scene leaves the key out, as opposed to stating the number 0.
bool is_absent(Key const& key, Scene const& scene) {
  bool const may_be_empty = key.kind == Kind::path || key.kind == Kind::text || key.kind == Kind::quantities;
  return is_not_given(key, scene) || (may_be_empty && is_zero(key, scene));
}

/// The default as a scene file states it, or what leaving the key out means.
std::string default_text(Key const& key) {
  Scene defaults;
  if (is_absent(key, defaults)) return key.zero.empty() ? "none" : std::string(key.zero);
  return fmt::format("`{}`", value_text(key, defaults));
}

std::string_view kind_text(Key const& key) {
  switch (key.kind) {
    case Kind::quantities:
      return "list";
    case Kind::quantity:
      return key.dimension == Dimension::ratio ? "number" : dimension_name(key.dimension);
    case Kind::lever:
      return "a length";
    case Kind::integer:
      return "whole number";
    case Kind::boolean:
      return "truth value";
    case Kind::choice:
      return "name";
    case Kind::text:
      return "text";
    case Kind::path:
      return "file";
  }
  return "";
}

OrderedJson default_json(Key const& key) {
  Scene defaults;
  std::string const text = value_text(key, defaults);
  if (text.size() >= 2 && text.front() == '"') return text.substr(1, text.size() - 2);
  return OrderedJson::parse(text);
}

OrderedJson key_json(Key const& key) {
  OrderedJson json = {{"description", fmt::format("{}. Allowed: {}.", key.help, allowed_values(key))}};
  if (!is_absent(key, Scene{})) json["default"] = default_json(key);
  OrderedJson const text = {{"type", "string"}}, truth = {{"type", "boolean"}};
  OrderedJson number = {{"type", key.kind == Kind::integer ? "integer" : "number"},
                        {"minimum", key.takes_zero ? std::min(0.0, key.least) : key.least},
                        {"maximum", key.most}};
  switch (key.kind) {
    case Kind::quantity:
      if (key.dimension == Dimension::temperature)
        json.update(text);  // a bare one could be deg C or K
      else
        json["anyOf"] = OrderedJson::array({number, text});
      break;
    case Kind::quantities:
      json.update({{"type", "array"}, {"items", {{"anyOf", OrderedJson::array({number, text})}}}});
      break;
    case Kind::integer:
      json.update(number);
      break;
    case Kind::boolean:
      json.update(truth);
      break;
    case Kind::choice:
      json["enum"] = key.choices;
      break;
    case Kind::lever:
    case Kind::text:
    case Kind::path:
      json.update(text);
      break;
  }
  return json;
}

/// The value of a key as a scene of one line a key states it, with its unit.
std::string_view stated_text(Key const& key, std::string_view source) {
  std::string_view section;
  while (!source.empty()) {
    std::size_t const end = std::min(source.size(), source.find('\n'));
    std::string_view const line = source.substr(0, end);
    source.remove_prefix(std::min(source.size(), end + 1));
    if (line.starts_with('[')) section = line.substr(1, line.find(']') - 1);
    std::size_t const equals = line.find(" = ");
    if (equals == line.npos || section != key.section() || line.substr(0, equals) != key.leaf()) continue;
    std::string_view const value = line.substr(equals + 3);
    std::size_t const comment = value.find(" #");
    return value.substr(0, comment == value.npos ? comment : value.find_last_not_of(' ', comment) + 1);
  }
  throw std::logic_error(std::string(key.name) + " is not stated on a line of its own");
}

/// What 0 stands for: "0 (none), or 1 to 100", "0 (smooth) to 5".
std::string range_text(Key const& key) {
  std::string const least = limit_with_unit(key, key.least), most = limit_with_unit(key, key.most);
  if (!key.takes_zero) return fmt::format("{} to {}", least, most);
  if (key.least == 0) return fmt::format("{} ({}) to {}", least, key.zero, most);
  return fmt::format("0 ({}), or {} to {}", key.zero, least, most);
}

}  // namespace

std::string allowed_values(Key const& key) {
  if (key.kind == Kind::boolean) return "true or false";
  if (key.kind == Kind::path) return "a path, relative to the folder of the scene";
  if (key.kind == Kind::text) return "text";
  if (key.kind == Kind::lever) return rolling_lever_limits();
  if (key.kind != Kind::choice) return range_text(key);
  std::string names;
  for (std::string_view const name : key.choices) names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", name);
  return names;
}

namespace {

constexpr char study_keys[] =
    "\n## Study files\n\nA study (`clathra study`) is a TOML file of its own, which names a scene and what is varied of it.\n\n"
    "- **`scene`**: scene file that all members share, relative to the folder of the study\n"
    "- **`seeds`**: list of seeds, or how many: `5`, the default, is 1 to 5\n"
    "- **`folder`**: folder of the results; `out/` and the name of the study file where it is left out\n"
    "- **`precision_target`**: add seeds until a number is known: `\"peak_q_Pa=2%\"`\n"
    "- **`max_seeds`**: at most so many seeds of a group, with `precision_target`\n"
    "- **`[matrix]`**: keys of the scene in quotes, each with a list of values, or `{ from = ..., to = ..., count = ... }`: "
    "every combination is a group\n"
    "- **`[groups.NAME]`**: a group of its own: keys of the scene, each with one value\n";

/// A page with lines of 110 columns at most: rows of tables stay whole, items of lists hang.
std::string wrapped(std::string const& page) {
  constexpr std::size_t columns = 110;
  std::string text, line;
  for (std::istringstream lines(page); std::getline(lines, line);) {
    std::string const indent = line.starts_with("- ") ? "  " : "";
    while (line.size() > columns && !line.starts_with('|')) {
      std::size_t const blank = line.rfind(' ', columns);
      if (blank == line.npos || blank <= indent.size()) break;  // a word as long as a line
      text += line.substr(0, blank) + "\n";
      line = indent + line.substr(blank + 1);
    }
    text += line + "\n";
  }
  return text;
}

std::string key_markdown(Key const& key) {
  std::string const allowed = key.kind == Kind::text ? "" : ", " + allowed_values(key);
  return fmt::format("- **`{}`**: {}. *{}{}; default: {}*\n", key.leaf(), key.help, kind_text(key), allowed, default_text(key));
}

/// With its whole name.
std::string stage_key_markdown(Key const& key) {
  std::string const allowed = key.kind == Kind::text ? "" : ", " + allowed_values(key);
  return fmt::format("- **`{}`**: {}. *{}{}; default: {}*\n", key.name, key.help, kind_text(key), allowed, default_text(key));
}

/// The JSON Schema of a [[stage]].
OrderedJson stage_json() {
  OrderedJson stage = {{"type", "object"}, {"additionalProperties", false}, {"properties", OrderedJson::object()}};
  for (Key const& key : stage_schema()) {
    std::string const leaf(key.leaf()), part(key.section());
    if (leaf == part) {
      stage["properties"][leaf] = key_json(key);
      continue;
    }
    OrderedJson& section = stage["properties"][part];
    if (section.is_null()) section = {{"type", "object"}, {"additionalProperties", false}, {"properties", OrderedJson::object()}};
    section["properties"][leaf] = key_json(key);
  }
  return stage;
}

}  // namespace

std::string schema_markdown() {
  std::string text =
      "# Scene keys\n\nA scene is a TOML file, in UTF-8 within quotes and comments, else ASCII. Every quantity is a number with "
      "its unit in quotes (`\"1 MPa\"`) or a bare number in SI units (temperatures in degrees Celsius, always with a unit). "
      "A key that is not stated has its default; a key that is not in this list is an error. `clathra schema` prints this page, "
      "`clathra schema --json` a JSON Schema for editors, and `clathra init quick` a scene with every key and its meaning.\n";
  std::string_view section;
  for (Key const& key : schema()) {
    if (key.section() != section) {
      section = key.section();
      text += fmt::format("\n## [{}]\n\n", section);
    }
    text += key_markdown(key);
  }
  text +=
      "\n## [[stage]]\n\nThe stages of a test that is a list (`test.kind = \"list\"`, which sections `[[stage]]` say by "
      "themselves), in "
      "their order after the consolidation ([how they work](../howto/stages.md)). `--set` and studies name a key of one by the "
      "number or the name of the stage: `stage.2.until.path`.\n\n";
  for (Key const& key : stage_schema()) text += stage_key_markdown(key);
  text +=
      "\n## Presets\n\nA preset stands in for the defaults of several keys; a key that the scene states keeps its value.\n"
      "\n### bond.preset\n\nWhat Jiang, He, Wang, Zhou and Zhu (2017, Comptes Rendus Mecanique 345 (12), 868-889) leave open, "
      "answered in several ways ([what speaks for which](../validation/paper.md)).\n\n" +
      presets_markdown(bond_presets()) +
      "\n### run.preset\n\nPoints of the trade of speed for accuracy ([how they were measured](../explanation/accuracy.md)). A "
      "stated `test.strain_rate` or `test.inertial_number` is bounded by a stated `test.max_platen_wave_stress` only. Local "
      "damping belongs to the model, not to these presets.\n\n" +
      presets_markdown(run_presets()) + study_keys;
  return wrapped(text);
}

std::string schema_json() {
  OrderedJson root = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                      {"title", "Clathra scene"},
                      {"type", "object"},
                      {"additionalProperties", false},
                      {"properties", OrderedJson::object()}};
  for (Key const& key : schema()) {
    OrderedJson& section = root["properties"][std::string(key.section())];
    if (section.is_null()) section = {{"type", "object"}, {"additionalProperties", false}, {"properties", OrderedJson::object()}};
    section["properties"][std::string(key.leaf())] = key_json(key);
  }
  root["properties"]["stage"] = {{"type", "array"}, {"items", stage_json()}};
  return root.dump(2) + "\n";
}

std::string commented_scene(Scene const& scene, std::vector<std::string_view> const& stated, std::string_view opening,
                            std::string_view source) {
  std::string text(opening);
  std::string_view section;
  for (Key const& key : schema()) {
    if (key.section() != section) text += fmt::format("\n[{}]\n", section = key.section());
    bool const given = std::find(stated.begin(), stated.end(), key.name) != stated.end();
    bool const absent = !given && is_absent(key, scene);
    text += fmt::format("# {}: {}", key.help, allowed_values(key));
    if (absent && !key.zero.empty()) text += fmt::format("; without it: {}", key.zero);
    // A value that stands for "not given" would be out of range if somebody took the comment sign away.
    text += absent ? fmt::format("\n# {} =\n", key.leaf())
                   : fmt::format("\n{}{} = {}\n", given ? "" : "# ", key.leaf(),
                                 given && !source.empty() ? stated_text(key, source) : value_text(key, scene));
  }
  if (scene.test.kind == TestKind::list) text += stages_toml(scene.stages);
  return text;
}

}  // namespace clathra
