#include "io/scene/study_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include "io/formats/text_file.hpp"
#include "io/scene/guarded_toml.hpp"
#include "io/scene/scene_guard.hpp"
#include "io/scene/scene_value.hpp"
#include "io/scene/schema.hpp"

namespace clathra {
namespace {

constexpr char stress_key[] = "test.confining_stress";

/// A piece of a file's name: "26 %" -> "26pct".
std::string slug(std::string_view text) {
  std::string name;
  for (char const c : text) {
    if (c == '%') name += "pct";
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '+' || c == '-') name += c;
    if (c == '/' || c == '_') name += '-';
  }
  return name;
}

constexpr std::size_t most_letters = 200;

/// Whether a text can be the name of a group and of its members' folders, which are not to be hidden.
bool is_name(std::string_view text) {
  return !text.starts_with('.') && std::all_of(text.begin(), text.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '_' || c == '+' || c == '-';
  });
}

/// What a value is called in names: with the key where the value is a bare number or truth value.
std::string value_name(Setting const& setting) {
  std::string const value = slug(setting.second), leaf = setting.first.substr(setting.first.find('.') + 1);
  double number = 0;
  auto const [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  bool const bare = value == "true" || value == "false" || (error == std::errc() && end == value.data() + value.size());
  return bare || value.starts_with('.') || value.starts_with('-') ? slug(leaf) + value : value;
}

/// A number and its unit, "1 MPa" -> (1, " MPa"); nothing where it begins with no number.
std::optional<std::pair<double, std::string>> parts_of(std::string const& text) {
  double number = 0;
  auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || !std::isfinite(number)) return {};
  return std::pair(number, std::string(end, text.data() + text.size()));
}

/// The values of one key.
struct Choices {
  std::string key;
  std::vector<std::string> values;
  bool named = true;  ///< they are part of the groups' names
};

class StudyReader {
 public:
  explicit StudyReader(std::filesystem::path const& path) : file_(path.string()) {
    study_.file = path;
    study_.folder = std::filesystem::path("out") / path.stem();
  }

  Study read(std::string const& text) {
    std::optional<TomlTable> const root = parse_guarded(text, file_, problems_);
    if (root) read_root(*root);
    if (problems_.empty()) make_groups();
    if (!problems_.empty()) throw SceneProblems(std::move(problems_));
    return std::move(study_);
  }

 private:
  void report(TomlNode const& node, std::string text) { problems_.push_back({file_, node.line, node.column, std::move(text)}); }

  /// The entries of a table in the order of the file.
  static std::vector<TomlEntry> in_order(TomlTable const& table) {
    std::vector<TomlEntry> entries = table.entries;
    std::stable_sort(entries.begin(), entries.end(), [](TomlEntry const& a, TomlEntry const& b) {
      return std::pair(a.node.line, a.node.column) < std::pair(b.node.line, b.node.column);
    });
    return entries;
  }

  void read_root(TomlTable const& root) {
    static constexpr std::string_view names[] = {"scene", "seeds", "folder", "precision_target", "max_seeds", "matrix", "groups"};
    std::string of_a_scene;
    TomlNode first;
    for (auto const& [name, line, column, node] : in_order(root)) {
      if (name == "scene")
        read_path(node, study_.scene);
      else if (name == "folder")
        read_path(node, study_.folder);
      else if (name == "seeds")
        read_seeds(node);
      else if (name == "precision_target")
        read_goal(node);
      else if (name == "max_seeds")
        read_max_seeds(node);
      else if (name == "matrix")
        read_matrix(node);
      else if (name == "groups")
        read_groups(node);
      else if (is_section(name) && node.as<TomlTable>())
        of_a_scene += fmt::format("{}[{}]", of_a_scene.empty() ? "" : ", ", name), first = first.line ? first : node;
      else if (std::string const hint = name_suggestion(name, names); hint.empty())
        report(node, fmt::format("unknown key '{}'; a study has {}", name.substr(0, 60), fmt::join(names, ", ")));
      else
        report(node, fmt::format("unknown key '{}'{}", name.substr(0, 60), hint));
    }
    if (!of_a_scene.empty())
      report(first, study_.scene.empty() ? fmt::format("{} belong to a scene, and this is one: clathra run {}", of_a_scene, file_)
                                         : of_a_scene + " belong into the scene file, or their keys below [matrix]");
    if (study_.scene.empty() && problems_.empty())
      problems_.push_back({file_, 0, 0, "'scene' is missing: the scene file that all members share"});
    study_.seeds_stated = !study_.seeds.empty();
    if (study_.seeds.empty())
      for (int seed = 1; seed <= usual_seeds; ++seed) study_.seeds.push_back(static_cast<std::uint64_t>(seed));
  }

  void read_path(TomlNode const& node, std::filesystem::path& path) {
    auto const* const text = node.as<std::string>();
    if (!text || text->empty()) return report(node, "needs the name of a file or folder in quotes");
    path = (study_.file.parent_path() / *text).lexically_normal();
  }

  void read_seeds(TomlNode const& node) {
    constexpr std::int64_t most = 10000;
    if (auto const* const count = node.as<std::int64_t>()) {
      if (*count < 1 || *count > most) return report(node, fmt::format("'seeds' must be between 1 and {}", most));
      for (std::int64_t seed = 1; seed <= *count; ++seed) study_.seeds.push_back(static_cast<std::uint64_t>(seed));
      return;
    }
    auto const* const list = node.as<TomlList>();
    if (!list || list->empty()) return report(node, "'seeds' needs their number, or a list of them: seeds = [1, 2, 3]");
    for (TomlNode const& item : *list) {
      auto const* const seed = item.as<std::int64_t>();
      if (!seed || *seed < 0) return report(item, "a seed is a whole number, 0 or more");
      auto const value = static_cast<std::uint64_t>(*seed);
      if (std::count(study_.seeds.begin(), study_.seeds.end(), value) > 0)
        return report(item, fmt::format("seed {} is there twice", value));
      study_.seeds.push_back(value);
    }
  }

  void read_goal(TomlNode const& node) {
    auto const* const text = node.as<std::string>();
    if (!text) return report(node, "'precision_target' needs a text like \"peak_q=2%\"");
    try {
      study_.precision_target = study_goal(*text);
    } catch (std::invalid_argument const& problem) {
      report(node, std::string("'precision_target' ") + problem.what());
    }
  }

  void read_max_seeds(TomlNode const& node) {
    auto const* const most = node.as<std::int64_t>();
    if (!most || *most < 2 || *most > 10000) return report(node, "'max_seeds' is a whole number between 2 and 10000");
    study_.max_seeds = static_cast<int>(*most);
  }

  static bool is_range(TomlTable const& table) { return table.find("from") || table.find("to") || table.find("count"); }

  /// Calls found(key, node) for the values of a section, whose keys may be written "a.b" = or a.b =.
  template <class Found>
  void for_each_key(TomlNode const& section, char const* what, Found const& found) {
    auto const* const table = section.as<TomlTable>();
    if (!table) return report(section, fmt::format("'{}' is a section: write [{}] and keys of the scene below", what, what));
    std::map<std::string, int> lines;
    auto const take = [&](std::string const& name, TomlNode const& node) {
      auto const [first, is_new] = lines.emplace(name, node.line);
      if (is_new) return found(name, node);
      report(node,
             fmt::format("'{}' is stated twice, in lines {} and {}: leave one of them out", name, first->second, node.line));
    };
    for (TomlEntry const& entry : in_order(*table)) {
      auto const* const nested = entry.node.as<TomlTable>();
      if (!nested || is_range(*nested))
        take(entry.name, entry.node);
      else
        for (TomlEntry const& leaf : in_order(*nested)) take(entry.name + "." + leaf.name, leaf.node);
    }
  }

  /// The key of a scene, where it may stand in a study.
  Key const* known(std::string const& name, TomlNode const& node) {
    if (char const* const instead = key_of_each_run(name))
      return report(node, fmt::format("'{}' cannot be varied here: {}", name, instead)), nullptr;
    Key const* const key = find_key(name);
    if (!key) report(node, fmt::format("unknown key '{}' of a scene{}", name.substr(0, 100), key_suggestion(name)));
    return key;
  }

  /// A single value as text, checked against its key.
  std::optional<std::string> value_of(Key const& key, TomlNode const& node) {
    std::string text;
    if (auto const* const quoted = node.as<std::string>())
      text = *quoted;
    else if (auto const* const whole = node.as<std::int64_t>())
      text = fmt::format("{}", *whole);
    else if (auto const* const number = node.as<double>())
      text = fmt::format("{}", *number);
    else if (auto const* const truth = node.as<bool>())
      text = *truth ? "true" : "false";
    else
      return report(node, fmt::format("'{}' needs one value here", key.name)), std::nullopt;
    try {
      Scene scratch;
      set_stated(key, scratch, text);
    } catch (std::invalid_argument const& problem) {
      return report(node, fmt::format("'{}' {}", key.name, problem.what())), std::nullopt;
    }
    if (key.kind == Kind::path && !text.empty()) text = (study_.file.parent_path() / text).lexically_normal().string();
    return text;
  }

  void read_matrix(TomlNode const& section) {
    for_each_key(section, "matrix", [&](std::string const& name, TomlNode const& node) {
      Key const* const key = known(name, node);
      if (!key) return;
      Choices choices{name, {}};
      if (auto const* const list = node.as<TomlList>()) {
        for (TomlNode const& item : *list) {
          auto value = value_of(*key, item);
          if (!value) return;  // what follows is most often wrong in the same way
          choices.values.push_back(std::move(*value));
        }
        if (list->empty()) report(node, fmt::format("'{}' has no value in its list", name));
      } else if (auto const* const range = node.as<TomlTable>()) {
        choices.values = range_of(*key, *range, node);
      } else if (auto value = value_of(*key, node)) {
        choices.values.push_back(std::move(*value));
        choices.named = false;
      }
      std::set<std::string> const distinct(choices.values.begin(), choices.values.end());
      if (distinct.size() < choices.values.size()) report(node, fmt::format("'{}' has a value twice", name));
      matrix_.push_back(std::move(choices));
    });
  }

  /// { from, to, count }: evenly spaced, both ends included.
  std::vector<std::string> range_of(Key const& key, TomlTable const& table, TomlNode const& node) {
    auto const *const from = table.find("from"), *const to = table.find("to"), *const number = table.find("count");
    auto const* const count = number ? number->as<std::int64_t>() : nullptr;
    if (!count || !from || !to || table.entries.size() != 3 || *count < 2 || *count > 10000)
      return report(
                 node,
                 fmt::format(
                     "a range of '{}' needs from, to and count (2 to 10000): {{ from = \"1 MPa\", to = \"3 MPa\", count = 3 }}",
                     key.name)),
             std::vector<std::string>();
    auto const first = value_of(key, *from), last = value_of(key, *to);
    if (!first || !last) return {};
    auto const a = parts_of(*first), b = parts_of(*last);
    if (!a || !b || a->second != b->second)
      return report(node, fmt::format("a range of '{}' needs two numbers in the same unit, got '{}' and '{}'", key.name, *first,
                                      *last)),
             std::vector<std::string>();
    std::vector<std::string> values;
    for (std::int64_t i = 0; i < *count; ++i) {
      double const part = static_cast<double>(i) / static_cast<double>(*count - 1);
      // Twelve digits: 0.30000000000000004 is what 0.1 three times gives, not what somebody means.
      values.push_back(fmt::format("{:.12g}{}", a->first + part * (b->first - a->first), a->second));
    }
    return values;
  }

  void read_groups(TomlNode const& section) {
    auto const* const groups = section.as<TomlTable>();
    if (!groups) return report(section, "'groups' holds sections: write [groups.NAME] and keys of the scene below");
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
        if (Key const* const key = known(key_name, value_node))
          if (auto value = value_of(*key, value_node)) group.settings.emplace_back(key_name, std::move(*value));
      });
      named_.push_back(std::move(group));
    }
    name_materials();
  }

  /// Groups whose material is not stated and that differ in nothing but the confining stress are tests of one material.
  void name_materials() {
    auto const without_stress = [](StudyGroup const& group) {
      std::map<std::string, std::string> settings(group.settings.begin(), group.settings.end());
      settings.erase(stress_key);
      return settings;
    };
    std::map<std::map<std::string, std::string>, std::string> names;
    for (StudyGroup const& group : named_) {
      if (!group.material.empty()) continue;
      std::string& name = names[without_stress(group)];
      if (name.size() + group.name.size() < most_letters) name += (name.empty() ? "" : "+") + group.name;
    }
    for (StudyGroup& group : named_)
      if (group.material.empty()) group.material = names.at(without_stress(group));
  }

  void read_material(TomlNode const& node, StudyGroup& group) {
    auto const* const text = node.as<std::string>();
    if (!text || text->empty() || text->size() > most_letters)
      return report(node, fmt::format("'material' needs a name in quotes, {} letters at most", most_letters));
    group.material = *text;
  }

  void make_groups() {
    std::size_t count = study_.seeds.size() * std::max<std::size_t>(1, named_.size());
    for (Choices const& choices : matrix_) count = count > most_members ? count : count * choices.values.size();
    if (count > most_members)
      return problems_.push_back({file_, 0, 0, fmt::format("the study has more than {} members", most_members)});
    for (Choices const& choices : matrix_)
      for (StudyGroup const& group : named_)
        if (value_in(group.settings, choices.key)) {
          problems_.push_back({file_, 0, 0, fmt::format("'{}' is in [matrix] and in [groups.{}]", choices.key, group.name)});
          break;  // the first of them says it
        }
    std::vector<StudyGroup> groups = named_.empty() ? std::vector<StudyGroup>(1) : named_;
    for (Choices const& choices : matrix_) {
      std::vector<StudyGroup> finer;
      for (StudyGroup const& group : groups)
        for (std::string const& value : choices.values) finer.push_back(with(group, {choices.key, value}, choices.named));
      groups = std::move(finer);
    }
    for (StudyGroup& group : groups) {
      if (group.name.empty()) group.name = "all";
      if (group.material.empty()) group.material = "all";
      for (Setting const& setting : group.settings) add_key(study_, setting.first);
    }
    std::set<std::string> names;
    for (StudyGroup const& group : groups)
      if (!names.insert(group.name).second)
        problems_.push_back(
            {file_, 0, 0,
             fmt::format("two groups have the name '{}': their values differ in blanks and signs only", group.name)});
    study_.groups = std::move(groups);
  }

  StudyGroup with(StudyGroup group, Setting const& setting, bool named) {
    auto const join = [name = value_name(setting)](std::string& to) { to += (to.empty() ? "" : "_") + name; };
    if (named) join(group.name);
    if (named && setting.first != stress_key) join(group.material);
    group.settings.push_back(setting);
    return group;
  }

  std::string file_;
  Study study_;
  std::vector<StudyGroup> named_;
  std::vector<Choices> matrix_;
  std::vector<Problem> problems_;
};

}  // namespace

Study parse_study(std::string const& text, std::filesystem::path const& path) { return StudyReader(path).read(text); }

Study load_study(std::filesystem::path const& path) { return parse_study(read_text_file(path, largest_scene_file + 1), path); }

}  // namespace clathra
