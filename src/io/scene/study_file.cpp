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
#include "io/scene/settings_reader.hpp"

namespace clathra {
namespace {

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

class StudyReader : private SettingsReader {
 public:
  explicit StudyReader(std::filesystem::path const& path) : SettingsReader(path) {
    study_.file = path;
    study_.folder = std::filesystem::path("out") / path.stem();
  }

  Study read(std::string const& text) {
    std::optional<TomlTable> const root = parse_guarded(text, file(), problems);
    if (root) read_root(*root);
    if (problems.empty()) make_groups();
    if (!problems.empty()) throw SceneProblems(std::move(problems));
    return std::move(study_);
  }

 private:
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
        named_ = read_groups(node, [](auto const&...) { return false; });
      else if (is_section(name) && node.as<TomlTable>())
        of_a_scene += fmt::format("{}[{}]", of_a_scene.empty() ? "" : ", ", name), first = first.line ? first : node;
      else if (std::string const hint = name_suggestion(name, names); hint.empty())
        report(node, fmt::format("unknown key '{}'; a study has {}", name.substr(0, 60), fmt::join(names, ", ")));
      else
        report(node, fmt::format("unknown key '{}'{}", name.substr(0, 60), hint));
    }
    if (!of_a_scene.empty())
      report(first, study_.scene.empty()
                        ? fmt::format("{} belong to a scene, and this is one: clathra run {}", of_a_scene, file())
                        : of_a_scene + " belong into the scene file, or their keys below [matrix]");
    if (study_.scene.empty() && problems.empty())
      problems.push_back({file(), 0, 0, "'scene' is missing: the scene file that all members share"});
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

  void make_groups() {
    std::size_t count = study_.seeds.size() * std::max<std::size_t>(1, named_.size());
    for (Choices const& choices : matrix_) count = count > most_members ? count : count * choices.values.size();
    if (count > most_members)
      return problems.push_back({file(), 0, 0, fmt::format("the study has more than {} members", most_members)});
    for (Choices const& choices : matrix_)
      for (StudyGroup const& group : named_)
        if (value_in(group.settings, choices.key)) {
          problems.push_back({file(), 0, 0, fmt::format("'{}' is in [matrix] and in [groups.{}]", choices.key, group.name)});
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
        problems.push_back(
            {file(), 0, 0,
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

  Study study_;
  std::vector<StudyGroup> named_;
  std::vector<Choices> matrix_;
};

}  // namespace

Study parse_study(std::string const& text, std::filesystem::path const& path) { return StudyReader(path).read(text); }

Study load_study(std::filesystem::path const& path) { return parse_study(read_text_file(path, largest_scene_file + 1), path); }

}  // namespace clathra
