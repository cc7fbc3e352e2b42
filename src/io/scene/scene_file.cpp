#include "io/scene/scene_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>

#include "domain/biaxial/quasi_static.hpp"
#include "io/formats/text_file.hpp"
#include "io/scene/guarded_toml.hpp"
#include "io/scene/presets.hpp"
#include "io/scene/scene_checks.hpp"
#include "io/scene/scene_guard.hpp"
#include "io/scene/scene_value.hpp"
#include "io/scene/stage_keys.hpp"

namespace clathra {
namespace {

constexpr std::size_t most_problems = 50;  // of hostile files; nobody reads more

/// Where a key was stated.
struct Place {
  std::string file;
  int line = 0, column = 0;
};

/// A list as text, its items as they were stated. @throws std::invalid_argument
std::string list_text(TomlList const& list) {
  std::string text;
  for (TomlNode const& item : list) {
    if (!text.empty()) text += ',';
    auto const* const quoted = item.as<std::string>();
    if (quoted && quoted->find(',') != std::string::npos)
      throw std::invalid_argument(
          fmt::format("needs one quantity in each item of its list, with a decimal point, got '{}'", quoted->substr(0, 40)));
    if (quoted)
      text += *quoted;
    else if (auto const* const whole = item.as<std::int64_t>())
      text += fmt::format("{}", *whole);
    else if (auto const* const number = item.as<double>())
      text += fmt::format("{}", *number);
    else
      throw std::invalid_argument("needs quantities in its list");
  }
  return text;
}

/// One side alone fixes the other by the aspect ratio, unless the number of discs does.
void complete_box(SpecimenScene& specimen) {
  if (specimen.particles > 0) return;
  if (specimen.height == 0) specimen.height = specimen.width * specimen.aspect_ratio;
  if (specimen.width == 0) specimen.width = specimen.height / specimen.aspect_ratio;
}

/// Collects a Scene from the file and the overrides, with all problems.
class SceneReader {
 public:
  SceneReader(std::string file, std::filesystem::path folder) : file_(std::move(file)), folder_(std::move(folder)) {}

  void read_file(std::string const& source) {
    std::size_t const before = problems_.size();
    std::optional<TomlTable> const root = parse_guarded(source, file_, problems_);
    readable_ = problems_.size() == before;
    if (root) read_table(*root, "");
  }

  void read_override(std::string const& text) {
    Place const place{"--set " + text.substr(0, 100)};
    auto const equals = text.find('=');
    if (equals == std::string::npos) return report(place, "needs the form key=value, as in --set run.threads=2");
    std::string const name = text.substr(0, equals);
    std::string value = text.substr(equals + 1);
    if (value.size() >= 2 && value.front() == '"' && value.back() == '"') value = value.substr(1, value.size() - 2);
    if (std::optional<StageSetting> const setting = stage_setting(name)) return override_stage(*setting, place, value);
    Key const* const key = find_key(name);
    if (!key)
      return report(place, fmt::format("unknown key '{}'{}", name.substr(0, 100),
                                       name.starts_with("stage.") ? stage_setting_suggestion(name) : key_suggestion(name)));
    overridden_.push_back(key->name);
    if (takes_back(*key, value)) return take_back(*key);
    replace_rates(name);
    if (name == "specimen.file" && !value.empty()) leave_out_sizes();
    set(*key, place, true, [&] { set_from_text(*key, scene_, value); });
  }

  /// Cross-checks, then the scene; throws if anything is wrong.
  LoadedScene finish() {
    complete_presets();
    // Stating a strain rate replaces the default inertial number.
    if (scene_.test.strain_rate > 0 && !given("test.inertial_number")) scene_.test.inertial_number = 0;
    complete_box(scene_.specimen);
    complete_stages();
    SceneFindings found = check_scene(scene_, [this](std::string_view name) { return given(name); });
    for (Finding& finding : found.problems) {
      // What is said of a key that could not even be read would only confuse.
      if (!readable_ || std::any_of(finding.keys.begin(), finding.keys.end(), [this](auto key) { return is_spoilt(key); }))
        continue;
      Place const place = place_of(finding.keys);
      problems_.push_back({place.file, place.line, place.column, std::move(finding.text), finding.severity});
    }
    if (!problems_.empty()) {
      std::stable_sort(problems_.begin(), problems_.end(), [](Problem const& a, Problem const& b) {
        return std::pair(a.line == 0, std::pair(a.line, a.column)) < std::pair(b.line == 0, std::pair(b.line, b.column));
      });
      if (problems_.size() > most_problems) problems_.resize(most_problems);
      throw SceneProblems(std::move(problems_));
    }
    std::vector<std::string_view> stated;
    for (auto const& place : places_) stated.push_back(place.first);
    return {scene_, {}, {}, std::move(found.warnings), std::move(stated)};
  }

 private:
  void report(Place const& place, std::string text) {
    problems_.push_back({place.file, place.line, place.column, std::move(text)});
  }

  bool given(std::string_view name) const { return places_.count(name) != 0 && !is_zero(*find_key(name), scene_); }
  /// Its value is wrong, or its section has a misspelt key, which may be this one.
  bool is_spoilt(std::string_view name) const {
    return std::any_of(spoilt_.begin(), spoilt_.end(),
                       [name](auto const& spoilt) { return spoilt == name || spoilt == name.substr(0, name.find('.')); });
  }

  Place place_of(std::vector<std::string_view> const& keys) const {
    for (std::string_view const key : keys)
      if (auto const found = places_.find(key); found != places_.end()) return found->second;
    return {file_};
  }

  /// What the presets say of keys that are not stated. A stated rate is kept: no preset bounds its W. Grains that are too
  /// stiff for mixed precision get double from any. A bond that replaces the contact, stated on its own, forms at the bonding
  /// stress, whatever the preset has: it would drop the force of the contact.
  void complete_presets() {
    bool const states_rate = given("test.strain_rate") || places_.count("test.inertial_number") != 0;
    if (states_rate && places_.count("test.max_platen_wave_stress") == 0) scene_.test.max_platen_wave_stress = 0;
    auto const stated = [&](std::string_view key) {
      bool const of_rate = key == "test.inertial_number" || key == "test.max_platen_wave_stress";
      return places_.count(key) != 0 || (of_rate && states_rate);
    };
    apply_preset(bond_presets().of(scene_.bond.preset), scene_, stated);
    apply_preset(run_presets().of(scene_.run.preset), scene_, stated);
    if (places_.count("run.precision") == 0 && !mixed_precision_resolves(scene_)) scene_.run.precision = Precision::full;
    if (places_.count("output.snapshots") == 0)
      scene_.output.snapshots = std::min(scene_.output.snapshots, scene_.output.records);
    if (scene_.bond.contact_coupling == ContactCoupling::replaces && places_.count("bond.after_consolidation") == 0)
      scene_.bond.after_consolidation = false;
  }

  /// An override of one rate takes the place of the other one in the file, and of its bound; two overrides contradict each other.
  void replace_rates(std::string const& name) {
    auto const drop = [this](std::string_view other, double& value) {
      if (std::find(overridden_.begin(), overridden_.end(), other) != overridden_.end()) return;
      places_.erase(other);
      value = 0;
    };
    if (name == "test.inertial_number") drop("test.strain_rate", scene_.test.strain_rate);
    if (name != "test.strain_rate") return;
    drop("test.inertial_number", scene_.test.inertial_number);
    drop("test.max_platen_wave_stress", scene_.test.max_platen_wave_stress);
  }

  /// A specimen that is read takes the place of the one that the file describes.
  void leave_out_sizes() {
    for (std::string_view const name :
         {"specimen.particles", "specimen.void_ratio", "specimen.void_ratio_at", "specimen.width", "specimen.height",
          "specimen.generator", "specimen.compaction_layers", "grading.d50", "grading.file", "grading.table"})
      if (std::find(overridden_.begin(), overridden_.end(), name) == overridden_.end()) take_back(*find_key(name));
  }

  /// As if the file had not stated the key.
  void take_back(Key const& key) {
    places_.erase(key.name);
    set_stated(key, scene_, "");
  }

  template <class Set>
  void set(Key const& key, Place const& place, bool from_override, Set const& assign) {
    places_.insert_or_assign(key.name, place);
    try {
      assign();
      if (is_not_given(key, scene_)) throw std::invalid_argument(zero_problem(key));
    } catch (std::invalid_argument const& problem) {
      spoilt_.emplace_back(key.name);
      return report(place, fmt::format("'{}' {}", from_override ? key.name : key.leaf(), problem.what()));
    }
    if (key.kind != Kind::path || from_override) return;
    std::string& path = std::get<std::string& (*)(Scene&)>(key.field)(scene_);
    if (!path.empty()) path = (folder_ / path).lexically_normal().string();
  }

  void read_table(TomlTable const& table, std::string const& prefix) {
    for (auto const& [name, line, column, node] : table.entries) {
      std::string const dotted = prefix.empty() ? name : prefix + "." + name;
      Place const key_place{file_, line, column};
      auto const* const inner = node.as<TomlTable>();
      bool const is_section = prefix.empty() && std::any_of(schema().begin(), schema().end(),
                                                            [&](Key const& key) { return key.section() == dotted; });
      if (dotted == "stage")
        read_stages(node, key_place);
      else if (is_section && inner)
        read_table(*inner, dotted);
      else if (Key const* const key = find_key(dotted))
        read_value(*key, node);
      else if (is_section)
        report(key_place, fmt::format("'{}' is a section: write [{}] and its keys below", dotted, dotted));
      else
        report_unknown(key_place, prefix, dotted, inner != nullptr);
    }
  }

  void report_unknown(Place const& place, std::string const& section, std::string const& dotted, bool is_table) {
    std::string const leaf = section.empty() ? dotted : dotted.substr(section.size() + 1);
    bool const of_a_study = section.empty() && (leaf == "scene" || leaf == "seeds" || leaf == "matrix" || leaf == "groups");
    std::string const hint = of_a_study                    ? "; a file with it is a study: clathra study " + file_
                             : is_table && section.empty() ? section_suggestion(dotted)
                             : section.empty()             ? key_suggestion(dotted)
                                                           : key_suggestion_in(section, leaf);
    if (is_table && section.empty())
      report(place, fmt::format("unknown section [{}]{}", leaf.substr(0, 60), hint));
    else if (section.empty())
      report(place, fmt::format("unknown key '{}' outside any section{}", leaf.substr(0, 60), hint));
    else
      report(place, fmt::format("unknown key '{}' in [{}]{}", leaf.substr(0, 60), section, hint)), spoilt_.push_back(section);
  }

  static std::string section_suggestion(std::string const& name) {
    std::vector<std::string_view> sections;
    for (Key const& key : schema())
      if (sections.empty() || sections.back() != key.section()) sections.push_back(key.section());
    return name_suggestion(name, sections);
  }

  void read_value(Key const& key, TomlNode const& node) {
    set(key, {file_, node.line, node.column}, false, [&] { assign(key, node); });
  }

  /// @throws std::invalid_argument
  void assign(Key const& key, TomlNode const& node) {
    if (auto const* const text = node.as<std::string>())
      set_from_text(key, scene_, *text);
    else if (auto const* const whole = node.as<std::int64_t>())
      set_from_integer(key, scene_, *whole);
    else if (auto const* const number = node.as<double>())
      set_from_number(key, scene_, *number);
    else if (auto const* const truth = node.as<bool>())
      set_from_boolean(key, scene_, *truth);
    else if (auto const* const list = node.as<TomlList>(); list && key.kind == Kind::quantities)
      set_from_text(key, scene_, list_text(*list));
    else
      throw std::invalid_argument(node.as<TomlTable>() ? "is one value, not a section" : "needs one value, not a list or a date");
  }

  void read_stages(TomlNode const& node, Place const& place) {
    auto const* const list = node.as<TomlList>();
    if (!list) return report(place, "'stage' is a list of sections: write [[stage]] above the keys of each");
    for (TomlNode const& item : *list) {
      auto const* const table = item.as<TomlTable>();
      Place const own{file_, item.line, item.column};
      if (!table) return report(own, "a stage needs keys below its [[stage]]");
      scene_.stages.emplace_back();
      stage_places_.push_back(own);
      read_stage(*table, "");
    }
  }

  /// Of the last stage.
  void read_stage(TomlTable const& table, std::string const& prefix) {
    for (TomlEntry const& entry : table.entries) {
      TomlNode const& node = entry.node;
      std::string const dotted = prefix.empty() ? entry.name : prefix + "." + entry.name;
      auto const* const inner = node.as<TomlTable>();
      if (Key const* const key = find_stage_key(dotted))
        set_in_stage(*key, {file_, node.line, node.column}, [&] { assign(*key, node); });
      else if (inner && prefix.empty() && is_stage_section(dotted))
        read_stage(*inner, dotted);
      else
        spoil_stage(scene_.stages.size() - 1, {file_, entry.line, entry.column},
                    fmt::format("unknown key '{}' in [[stage]]{}", dotted.substr(0, 60), stage_key_suggestion(dotted)));
    }
  }

  template <class Set>
  void set_in_stage(Key const& key, Place const& place, Set const& assign) {
    try {
      assign();
      if (is_not_given(key, scene_)) throw std::invalid_argument("must not be 0: leave it out");
    } catch (std::invalid_argument const& problem) {
      spoil_stage(scene_.stages.size() - 1, place, fmt::format("'{}' {}", key.name, problem.what()));
    }
  }

  /// @param stage  its place; its rules are not looked at then
  void spoil_stage(std::size_t stage, Place const& place, std::string text) {
    report(place, std::move(text));
    stages_spoilt_.push_back(stage);
  }

  static std::string names_of(std::vector<LoadingStage> const& stages) {
    std::string names;
    for (LoadingStage const& stage : stages) names += fmt::format("{}'{}'", names.empty() ? "" : ", ", stage.name.substr(0, 60));
    return names.empty() ? "none" : names;
  }

  void override_stage(StageSetting const& setting, Place const& place, std::string const& value) {
    std::vector<LoadingStage>& stages = scene_.stages;
    auto found = std::find_if(stages.begin(), stages.end(), [&](LoadingStage const& one) { return one.name == setting.stage; });
    for (std::size_t i = 0; i < stages.size() && found == stages.end(); ++i)
      if (setting.stage == std::to_string(i + 1)) found = stages.begin() + static_cast<std::ptrdiff_t>(i);
    if (found == stages.end())
      return report(place,
                    fmt::format("there is no stage '{}'; [[stage]] has {}", setting.stage.substr(0, 60), names_of(stages)));
    std::iter_swap(found, stages.end() - 1);
    try {
      set_stated(*setting.key, scene_, value);
    } catch (std::invalid_argument const& problem) {
      spoil_stage(static_cast<std::size_t>(found - stages.begin()), place,
                  fmt::format("'{}' {}", setting.key->name, problem.what()));
    }
    std::iter_swap(found, stages.end() - 1);
  }

  /// Sections [[stage]] make the test a list; then test.kind needs not be stated.
  void complete_stages() {
    bool const is_list = scene_.test.kind == TestKind::list;
    if (scene_.stages.empty()) {
      if (is_list) report(place_of({"test.kind"}), "'test.kind' = \"list\" needs sections [[stage]]");
      if (is_list) scene_.test.kind = TestKind::biaxial;  // for the checks that follow
      return;
    }
    if (!is_list && places_.count("test.kind") != 0)
      report(stage_places_.front(), "'test.kind' names a list of stages of its own: leave it out, or the sections [[stage]]");
    scene_.test.kind = TestKind::list;
    for (StageProblem const& problem : stage_problems(scene_.stages))
      if (std::find(stages_spoilt_.begin(), stages_spoilt_.end(), problem.stage) == stages_spoilt_.end())
        report(stage_places_[problem.stage], problem.text);
  }

  std::string file_;
  std::filesystem::path folder_;
  Scene scene_;
  std::vector<Problem> problems_;
  std::map<std::string_view, Place> places_;
  std::vector<std::string> spoilt_;  ///< keys and sections
  std::vector<std::string_view> overridden_;
  std::vector<Place> stage_places_;
  std::vector<std::size_t> stages_spoilt_;
  bool readable_ = true;
};

}  // namespace

LoadedScene parse_scene(std::string const& source, std::string const& file, std::filesystem::path const& folder,
                        std::vector<std::string> const& overrides) {
  SceneReader reader(file, folder);
  reader.read_file(source);
  for (std::string const& text : overrides) reader.read_override(text);
  LoadedScene loaded = reader.finish();
  loaded.source = source;
  loaded.overrides = overrides;
  return loaded;
}

LoadedScene load_scene(std::filesystem::path const& path, std::vector<std::string> const& overrides) {
  return parse_scene(read_text_file(path, largest_scene_file + 1), path.string(), path.parent_path(), overrides);
}

std::string resolved_scene(Scene const& scene, std::filesystem::path const& folder) {
  std::string text = "# The scene as it is run, with every key; what is not given says what holds instead.\n";
  std::string_view section;
  Scene relative = scene;
  for (std::string* const path : {&relative.specimen.file, &relative.grading.file})
    if (!path->empty()) *path = std::filesystem::proximate(*path, folder).string();
  for (Key const& key : schema()) {
    if (key.section() != section) text += fmt::format("\n[{}]\n", section = key.section());
    if (is_not_given(key, scene))
      text += fmt::format("# {} is not given: {}\n", key.leaf(), key.zero);
    else
      text += fmt::format("{} = {}\n", key.leaf(), value_text(key, relative));
  }
  if (scene.test.kind == TestKind::list) return text + stages_toml(scene.stages);
  return text + "\n# The stages that test.kind stands for:\n" + stages_toml(stages_of(scene), "# ");
}

}  // namespace clathra
