#include "io/scene/study_members.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "io/scene/scene_value.hpp"
#include "io/scene/schema.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

/// Keys that each member has its own value of, or that say nothing of what is tested; with what to write instead.
constexpr std::pair<std::string_view, char const*> other_keys[] = {
    {"run.seed", "'seeds' of the study gives the seeds, or --seeds"},
    {"output.folder", "'folder' of the study names the folder of all members, or --output"},
    {"run.threads", "--threads gives the threads of a member"}};

/// A value as a scene would echo it, so that "50 %" and "0.5" are one.
std::string echoed(std::string const& key_name, std::string const& text) {
  Key const* const key = find_key(key_name);
  Scene scene;
  try {
    set_stated(*key, scene, text);
  } catch (std::invalid_argument const&) {
    return text;
  }
  return value_text(*key, scene);
}

std::string key_in(std::string const& override) { return override.substr(0, override.find('=')); }

/// What is wrong with an override of a study, or nothing.
std::string problem_of(Study const& study, std::string const& text) {
  auto const equals = text.find('=');
  std::string const name = text.substr(0, equals);
  if (equals == std::string::npos) return fmt::format("'{}' needs the form section.key=value", text.substr(0, 100));
  if (char const* const instead = key_of_each_run(name))
    return fmt::format("'{}' cannot be set for all members: {}", name, instead);
  Key const* const key = find_key(name);
  if (!key) return fmt::format("unknown key '{}'{}", name.substr(0, 100), key_suggestion(name));
  if (groups_differ_in(study, name))
    return fmt::format("'{}' is what the groups of {} differ in: change it there, or leave it out here", name,
                       study.file.string());
  try {
    Scene scratch;
    set_stated(*key, scratch, text.substr(equals + 1));
  } catch (std::invalid_argument const& problem) {
    return fmt::format("'{}' {}", name, problem.what());
  }
  return {};
}

std::string absolute_text(fs::path const& path) { return fs::absolute(path).lexically_normal().string(); }

}  // namespace

std::string const* value_in(std::vector<Setting> const& settings, std::string_view key) {
  auto const found = std::find_if(settings.begin(), settings.end(), [&](Setting const& setting) { return setting.first == key; });
  return found == settings.end() ? nullptr : &found->second;
}

void add_key(Study& study, std::string const& key) {
  if (key != "run.ignore_guards" && std::find(study.keys.begin(), study.keys.end(), key) == study.keys.end())
    study.keys.push_back(key);
}

char const* key_of_each_run(std::string_view name) {
  for (auto const& [other, instead] : other_keys)
    if (name == other) return instead;
  return nullptr;
}

/// A basic string of TOML is one of JSON.
std::string in_quotes(std::string const& text) {
  using Json = nlohmann::json;
  return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
}

bool groups_differ_in(Study const& study, std::string const& key) {
  std::set<std::string> values;
  for (StudyGroup const& group : study.groups) {
    std::string const* const value = value_in(group.settings, key);
    values.insert(value ? echoed(key, *value) : "");
  }
  return values.size() > 1;
}

void override_study(Study& study, std::vector<std::string> const& overrides) {
  std::vector<Problem> problems;
  for (std::string const& text : overrides)
    if (std::string problem = problem_of(study, text); !problem.empty())
      problems.push_back({"--set " + text.substr(0, 100), 0, 0, std::move(problem)});
  if (!problems.empty()) throw SceneProblems(std::move(problems));
  for (std::string const& text : overrides) {
    std::string const name = key_in(text);
    std::string value = text.substr(name.size() + 1);
    study.overridden.emplace_back(name, value);
    if (find_key(name)->kind == Kind::path && !value.empty()) value = absolute_text(value);
    for (StudyGroup& group : study.groups) {
      std::erase_if(group.settings, [&](Setting const& setting) { return setting.first == name; });
      group.settings.emplace_back(name, value);
    }
    add_key(study, name);
  }
}

void ignore_guards(Study& study) {
  for (StudyGroup& group : study.groups) {
    std::erase_if(group.settings, [](Setting const& setting) { return setting.first == "run.ignore_guards"; });
    group.settings.emplace_back("run.ignore_guards", "true");
  }
}

std::vector<std::string> member_overrides(StudyGroup const& group, std::uint64_t seed) {
  std::vector<std::string> overrides;
  for (auto const& [key, value] : group.settings) overrides.push_back(key + "=" + value);
  overrides.push_back(fmt::format("run.seed={}", seed));
  return overrides;
}

LoadedScene member_scene(Study const& study, StudyGroup const& group, std::uint64_t seed) {
  try {
    return load_scene(study.scene, member_overrides(group, seed));
  } catch (SceneProblems const& problems) {
    std::vector<Problem> named = problems.problems;
    for (Problem& problem : named) {
      constexpr std::string_view option = "--set ";  // which is how a member is told what the study file says
      bool const of_file =
          problem.file.starts_with(option) && !value_in(study.overridden, key_in(problem.file.substr(option.size())));
      if (of_file) {
        std::string const stated = problem.file.substr(option.size());
        if (!problem.text.starts_with("'" + key_in(stated) + "'")) problem.text = stated + ": " + problem.text;
        problem.file = study.file.string();
      }
      problem.text += fmt::format(" (in the group {}{})", group.name, of_file ? "" : " of " + study.file.string());
    }
    throw SceneProblems(std::move(named));
  }
}

std::string member_name(StudyGroup const& group, std::uint64_t seed) { return fmt::format("{}-seed{}", group.name, seed); }

std::string group_label(Study const& study, StudyGroup const& group) {
  std::string label;
  for (std::string const& key : study.keys) {
    std::string const* const value = value_in(group.settings, key);
    if (!value || !groups_differ_in(study, key)) continue;
    bool const bare = value->find_first_not_of("0123456789.eE+-") == std::string::npos || *value == "true" || *value == "false";
    std::string leaf = key.substr(key.find('.') + 1);
    std::replace(leaf.begin(), leaf.end(), '_', ' ');
    label += (label.empty() ? "" : ", ") + (bare ? leaf + " " : "") + *value;
  }
  return label.empty() ? group.name : label;
}

std::string si_text(Setting const& setting) {
  Key const* const key = find_key(setting.first);
  auto const* const number = key ? std::get_if<double& (*)(Scene&)>(&key->field) : nullptr;
  if (!number) return setting.second;
  Scene scene;
  set_stated(*key, scene, setting.second);
  return fmt::format("{}", (*number)(scene));
}

std::string resolved_study(Study const& study) {
  std::string text = fmt::format("# {} with what the command line said.\n", study.file.filename().string());
  text += fmt::format("scene = {}\nfolder = {}\nseeds = [", in_quotes(absolute_text(study.scene)),
                      in_quotes(absolute_text(study.folder)));
  for (std::size_t i = 0; i < study.seeds.size(); ++i) text += fmt::format("{}{}", i == 0 ? "" : ", ", study.seeds[i]);
  text += "]\n";
  if (study.precision_target)
    text += fmt::format("precision_target = \"{}={}\"\nmax_seeds = {}\n", study.precision_target->number,
                        study.precision_target->width, study.max_seeds);
  for (StudyGroup const& group : study.groups) {
    text += fmt::format("\n[groups.{}]\nmaterial = {}\n", in_quotes(group.name), in_quotes(group.material));
    for (auto const& [key, value] : group.settings) {
      bool const path = find_key(key)->kind == Kind::path && !value.empty();
      text += fmt::format("{} = {}\n", in_quotes(key), in_quotes(path ? absolute_text(value) : value));
    }
  }
  return text;
}

}  // namespace clathra
