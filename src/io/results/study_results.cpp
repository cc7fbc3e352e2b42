#include "io/results/study_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <numbers>
#include <set>

#include "io/formats/csv_text.hpp"
#include "io/formats/digest.hpp"
#include "io/results/run_record.hpp"
#include "io/results/run_results.hpp"
#include "io/scene/schema.hpp"

namespace clathra {
namespace {

constexpr char const* state_names[] = {"waiting", "finished", "failed", "refused"};

std::string number_cell(std::map<std::string, double> const& numbers, std::string const& name) {
  auto const found = numbers.find(name);
  return found == numbers.end() ? "" : fmt::format("{}", found->second);
}

std::string joined(std::vector<std::string> const& texts) {
  std::string text;
  for (std::string const& each : texts) text += (text.empty() ? "" : "; ") + each;
  return text;
}

/// Takes the envelopes of a material in one state into its numbers.
void add_envelopes(GroupNumbers& to, PairedStrength const& strength, std::string const& state) {
  for (Envelope const& fit : strength.of_seeds) {
    to.values[state + "_cohesion_Pa"].push_back(fit.cohesion);
    to.values[state + "_friction_angle_deg"].push_back(fit.friction_angle * 180 / std::numbers::pi);
    if (fit.errors) to.values[state + "_r_squared"].push_back(fit.errors->r_squared);
    if (fit.curvature) to.values[state + "_curvature_per_Pa"].push_back(*fit.curvature);
  }
}

/// A number of a record, 0 where it is missing or null (which is how infinities are written).
/// @throws FileProblem where something else stands there
double number_at(nlohmann::json const& section, std::string const& name, std::filesystem::path const& run_folder) {
  auto const found = section.find(name);
  if (found == section.end() || found->is_null()) return 0;
  if (!found->is_number())
    throw FileProblem(ExitCode::bad_input, run_folder / "run.json",
                      fmt::format("{} is {}, which is no number", name, found->dump().substr(0, 40)));
  return found->get<double>();
}

/// A section of a record by its path, empty where there is none. @throws FileProblem where it is no section
nlohmann::json section_of(nlohmann::json const& record, std::vector<std::string> const& path,
                          std::filesystem::path const& run_folder) {
  nlohmann::json section = record;
  for (std::string const& name : path) {
    if (section.is_object() && !section.contains(name)) return nlohmann::json::object();
    if (section.is_object()) section = nlohmann::json(section.at(name));
    if (!section.is_object()) throw FileProblem(ExitCode::bad_input, run_folder / "run.json", name + " is no section");
  }
  return section;
}

/// Lines of study.csv.
class Table {
 public:
  Table(Study const& study, std::set<std::string> names) : study_(study), names_(std::move(names)) {
    text_ = "row,group,label";
    for (std::string const& key : study_.keys) add(key);
    text_ += ",seed,n,state,message,warnings";
    for (std::string const& name : names_) add(name);
    text_ += ",program,specimen_digest,state_hash,wall_seconds,particle_steps_per_second\n";
  }

  void add(MemberResult const& member) {
    StudyGroup const& group = study_.groups[member.group];
    begin("member", group.name, group_label(study_, group), group.settings);
    text_ += fmt::format(",{},,{},{},{}", member.seed, state_names[static_cast<int>(member.state)], csv_cell(member.message),
                         csv_cell(joined(member.warnings)));
    numbers(member.numbers);
    bool const finished = member.state == MemberState::finished;
    for (std::string const& text : {member.program, member.specimen_digest, member.state_hash}) add(csv_cell(text));
    text_ += finished ? fmt::format(",{},{}\n", member.wall_seconds, member.disc_steps_per_second) : ",,\n";
  }

  /// One row for each seed of an envelope.
  void add_seeds(GroupNumbers const& group) {
    for (std::size_t i = 0; i < group.seeds.size(); ++i) {
      begin("envelope", group.name, group.label, group.settings);
      text_ += fmt::format(",{},,,,", group.seeds[i]);
      std::map<std::string, double> own;
      for (auto const& [name, values] : group.values)
        if (values.size() == group.seeds.size()) own[name] = values[i];
      numbers(own);
      text_ += ",,,,,\n";
    }
  }

  /// The four rows, once for the numbers of all seeds, then for those that fewer have.
  void add_statistics(GroupNumbers const& group) {
    std::map<std::size_t, std::map<std::string, MeanInterval>, std::greater<>> by_count;
    for (auto const& [name, values] : group.values) by_count[values.size()][name] = mean_interval(values);
    for (auto const& [count, intervals] : by_count) {
      auto const row = [&, n = count, &of = intervals](char const* kind, auto const& number) {
        row_of(group, n, of, kind, number);
      };
      row("mean", [](MeanInterval const& m) { return std::optional(m.mean); });
      row("standard_deviation", [](MeanInterval const& m) { return m.deviation; });
      row("interval_low", [](MeanInterval const& m) { return m.half_width ? std::optional(m.low()) : std::nullopt; });
      row("interval_high", [](MeanInterval const& m) { return m.half_width ? std::optional(m.high()) : std::nullopt; });
    }
  }

  std::string text() const { return text_; }

 private:
  void add(std::string const& text) {
    text_ += ',';
    text_ += text;
  }

  void begin(char const* row, std::string const& group, std::string const& label, std::vector<Setting> const& settings) {
    text_ += fmt::format("{},{},{}", row, csv_cell(group), csv_cell(label));
    for (std::string const& key : study_.keys) {
      std::string const* const value = value_in(settings, key);
      add(value ? csv_cell(si_text({key, *value})) : "");
    }
  }

  void numbers(std::map<std::string, double> const& own) {
    for (std::string const& name : names_) add(number_cell(own, name));
  }

  void row_of(GroupNumbers const& group, std::size_t count, std::map<std::string, MeanInterval> const& intervals, char const* row,
              std::function<std::optional<double>(MeanInterval const&)> const& number) {
    begin(row, group.name, group.label, group.settings);
    text_ += fmt::format(",,{},,,", count);
    std::map<std::string, double> own;
    for (auto const& [name, interval] : intervals)
      if (std::optional<double> const value = number(interval)) own[name] = *value;
    numbers(own);
    text_ += ",,,,,\n";
  }

  Study const& study_;
  std::set<std::string> names_;
  std::string text_;
};

/// "prepare", and the stages of the loading.
std::vector<std::string> loading_stages(nlohmann::json const& record) {
  std::vector<std::string> names{"prepare"};
  auto const loading = record.find("loading");
  if (loading == record.end()) return {"prepare", shear_stage};
  for (auto const& end : *loading) names.push_back(end.at("stage").get<std::string>());
  return names;
}

}  // namespace

std::size_t GroupNumbers::without_peak() const {
  auto const passed = values.find("peak_passed");
  if (passed == values.end()) return 0;
  return static_cast<std::size_t>(std::count(passed->second.begin(), passed->second.end(), 0.0));
}

void read_member(MemberResult& member, std::filesystem::path const& run_folder) {
  RunResults const run = read_run(run_folder);
  std::filesystem::path const history = run_folder / "history.csv";
  if (run.text("/result_digests_xxh3_128/history.csv").value_or("") != file_digest(history))
    throw FileProblem(ExitCode::bad_input, history,
                      "is not the one that its run.json says the run wrote; without the folder the study runs this member anew");
  std::map<std::string, double> numbers;
  std::vector<std::string> const stages = loading_stages(run.record);
  for (std::string const& stage : stages) {
    nlohmann::json const section = section_of(run.record, {"stages", stage}, run_folder);
    bool const is_main = stage == "prepare" || stage == shear_stage || stages.size() == 2;
    for (auto const& [name, value] : section.items())
      if (!value.is_null()) numbers[is_main ? name : stage + "." + name] = number_at(section, name, run_folder);
  }
  nlohmann::json const seconds = section_of(run.record, {"wall_seconds"}, run_folder);
  double wall_seconds = 0;
  for (char const* const stage : {"prepare", "shear", "generate"}) wall_seconds += number_at(seconds, stage, run_folder);
  member.disc_steps_per_second = number_at(run.record, "particle_steps_per_second", run_folder);
  member.wall_seconds = wall_seconds;
  member.numbers = std::move(numbers);
  TestNumbers const n = run.has_peak() ? test_numbers(run.history.curves()) : TestNumbers();
  if (n.passed_peak) {
    member.peak = FailureStress{n.peak_sigma3 + n.peak_q, n.peak_sigma3};
    member.residual = FailureStress{n.residual_sigma3 + n.residual_q, n.residual_sigma3};
  }
  member.confining_stress = run.number("/scene/test/confining_stress").value_or(0);
  member.state_hash = run.text("/state_hash").value_or("");
  member.program = version_text(run.text("/program/version").value_or("?"), run.text("/program/git_hash").value_or("?"));
  member.specimen_digest = run.text("/input/specimen_digest_xxh3_128").value_or("");
  member.warnings.clear();
  if (auto const warnings = run.record.find("warnings"); warnings != run.record.end() && warnings->is_array())
    for (nlohmann::json const& text : *warnings)
      if (text.is_string()) member.warnings.push_back(text.get<std::string>());
  member.state = MemberState::finished;
  member.message.clear();
}

std::vector<GroupNumbers> numbers_by_group(Study const& study, std::vector<MemberResult> const& members) {
  std::vector<GroupNumbers> groups(study.groups.size());
  for (MemberResult const& member : members) {
    if (member.state != MemberState::finished) continue;
    GroupNumbers& group = groups[member.group];
    group.name = study.groups[member.group].name;
    group.label = group_label(study, study.groups[member.group]);
    group.settings = study.groups[member.group].settings;
    group.seeds.push_back(member.seed);
    for (auto const& [name, value] : member.numbers) group.values[name].push_back(value);
  }
  std::erase_if(groups, [](GroupNumbers const& group) { return group.seeds.empty(); });
  return groups;
}

std::vector<GroupNumbers> envelopes_by_material(Study const& study, std::vector<MemberResult> const& members) {
  std::vector<GroupNumbers> materials;
  for (StudyGroup const& first : study.groups) {
    if (std::any_of(materials.begin(), materials.end(), [&](GroupNumbers const& m) { return m.name == first.material; }))
      continue;
    GroupNumbers material{first.material, first.material, first.settings, {}, {}};
    std::erase_if(material.settings, [](Setting const& setting) { return setting.first == stress_key; });
    std::vector<SeedTest> peaks, residuals;
    for (MemberResult const& member : members) {
      if (study.groups[member.group].material != first.material || !member.peak) continue;
      peaks.push_back({member.seed, member.confining_stress, *member.peak});
      residuals.push_back({member.seed, member.confining_stress, *member.residual});
    }
    PairedStrength const at_peak = paired_strength(peaks);
    material.seeds = at_peak.seeds;
    add_envelopes(material, at_peak, "peak");
    add_envelopes(material, paired_strength(residuals), "residual");
    materials.push_back(std::move(material));
  }
  std::erase_if(materials, [](GroupNumbers const& material) { return material.seeds.empty(); });
  return materials;
}

std::string study_csv(Study const& study, std::vector<MemberResult> const& members) {
  std::vector<GroupNumbers> const groups = numbers_by_group(study, members), materials = envelopes_by_material(study, members);
  std::set<std::string> names;
  for (MemberResult const& member : members)
    for (auto const& entry : member.numbers) names.insert(entry.first);
  for (GroupNumbers const& material : materials)
    for (auto const& entry : material.values) names.insert(entry.first);
  Table table(study, std::move(names));
  for (MemberResult const& member : members) table.add(member);
  for (GroupNumbers const& group : groups) table.add_statistics(group);
  for (GroupNumbers const& material : materials) {
    table.add_seeds(material);
    table.add_statistics(material);
  }
  return table.text();
}

}  // namespace clathra
