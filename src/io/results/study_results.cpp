#include "io/results/study_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <numbers>
#include <set>

#include "io/results/run_results.hpp"

namespace clathra {
namespace {

constexpr char stress_key[] = "test.confining_stress";
constexpr char const* state_names[] = {"waiting", "finished", "failed"};

/// A cell, quoted where it has to be.
std::string cell(std::string const& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (char const c : text) quoted += c == '"' ? "\"\"" : c == '\n' || c == '\r' ? " " : std::string(1, c);
  return quoted + "\"";
}

std::string number_cell(std::map<std::string, double> const& numbers, std::string const& name) {
  auto const found = numbers.find(name);
  return found == numbers.end() ? "" : fmt::format("{}", found->second);
}

/// Takes the envelope of the tests of one seed into the numbers of a material.
void add_envelope(GroupNumbers& to, std::vector<FailureStress> const& tests, std::string const& state, bool& any) {
  std::optional<Envelope> const fit = fitted_envelope(tests);
  if (!fit) return;
  any = true;
  to.values[state + "_cohesion_Pa"].push_back(fit->cohesion);
  to.values[state + "_friction_angle_deg"].push_back(fit->friction_angle * 180 / std::numbers::pi);
  if (fit->errors) to.values[state + "_r_squared"].push_back(fit->errors->r_squared);
  if (fit->curvature) to.values[state + "_curvature_per_Pa"].push_back(*fit->curvature);
}

/// Lines of study.csv.
class Table {
 public:
  Table(Study const& study, std::set<std::string> names) : study_(study), names_(std::move(names)) {
    text_ = "row,group";
    for (std::string const& key : study_.keys) add(key);
    text_ += ",seed,n,state,message";
    for (std::string const& name : names_) add(name);
    text_ += ",state_hash,wall_seconds,disc_steps_per_second\n";
  }

  void add(MemberResult const& member) {
    StudyGroup const& group = study_.groups[member.group];
    begin("member", group.name, group.settings);
    text_ += fmt::format(",{},,{},{}", member.seed, state_names[static_cast<int>(member.state)], cell(member.message));
    numbers(member.numbers);
    bool const finished = member.state == MemberState::finished;
    add(member.state_hash);
    text_ += finished ? fmt::format(",{},{}\n", member.wall_seconds, member.disc_steps_per_second) : ",,\n";
  }

  /// One row for each seed of an envelope.
  void add_seeds(GroupNumbers const& group) {
    for (std::size_t i = 0; i < group.seeds.size(); ++i) {
      begin("envelope", group.name, group.settings);
      text_ += fmt::format(",{},,,", group.seeds[i]);
      std::map<std::string, double> own;
      for (auto const& [name, values] : group.values)
        if (values.size() == group.seeds.size()) own[name] = values[i];
      numbers(own);
      text_ += ",,,\n";
    }
  }

  void add_statistics(GroupNumbers const& group) {
    std::map<std::string, MeanInterval> intervals;
    for (auto const& [name, values] : group.values) intervals[name] = mean_interval(values);
    row_of(group, intervals, "mean", [](MeanInterval const& m) { return std::optional(m.mean); });
    row_of(group, intervals, "standard_deviation", [](MeanInterval const& m) { return m.deviation; });
    row_of(group, intervals, "interval_low",
           [](MeanInterval const& m) { return m.half_width ? std::optional(m.low()) : std::nullopt; });
    row_of(group, intervals, "interval_high",
           [](MeanInterval const& m) { return m.half_width ? std::optional(m.high()) : std::nullopt; });
  }

  std::string text() const { return text_; }

 private:
  void add(std::string const& text) {
    text_ += ',';
    text_ += text;
  }

  void begin(char const* row, std::string const& group, std::vector<Setting> const& settings) {
    text_ += fmt::format("{},{}", row, cell(group));
    for (std::string const& key : study_.keys) {
      auto const found =
          std::find_if(settings.begin(), settings.end(), [&](Setting const& setting) { return setting.first == key; });
      add(found == settings.end() ? "" : cell(found->second));
    }
  }

  void numbers(std::map<std::string, double> const& own) {
    for (std::string const& name : names_) add(number_cell(own, name));
  }

  void row_of(GroupNumbers const& group, std::map<std::string, MeanInterval> const& intervals, char const* row,
              std::function<std::optional<double>(MeanInterval const&)> const& number) {
    begin(row, group.name, group.settings);
    text_ += fmt::format(",,{},,", group.seeds.size());
    std::map<std::string, double> own;
    for (auto const& [name, interval] : intervals)
      if (std::optional<double> const value = number(interval)) own[name] = *value;
    numbers(own);
    text_ += ",,,\n";
  }

  Study const& study_;
  std::set<std::string> names_;
  std::string text_;
};

}  // namespace

void read_member(MemberResult& member, std::filesystem::path const& run_folder) {
  RunResults const run = read_run(run_folder);
  for (char const* const stage : {"prepare", "shear"}) {
    nlohmann::json::json_pointer const at(std::string("/stages/") + stage);
    if (!run.record.contains(at)) continue;
    for (auto const& [name, value] : run.record.at(at).items())
      if (value.is_number()) member.numbers[name] = value.get<double>();
  }
  TestNumbers const n = test_numbers(run.history.curves());
  if (n.passed_peak) {
    member.peak = FailureStress{n.peak_sigma3 + n.peak_q, n.peak_sigma3};
    member.residual = FailureStress{n.residual_sigma3 + n.residual_q, n.residual_sigma3};
  }
  member.state_hash = run.text("/state_hash").value_or("");
  member.wall_seconds = 0;
  if (auto const times = run.record.find("wall_seconds"); times != run.record.end() && times->is_object())
    for (char const* const stage : {"prepare", "shear", "generate"}) member.wall_seconds += times->value(stage, 0.0);
  member.disc_steps_per_second = run.number("/disc_steps_per_second").value_or(0);
  member.state = MemberState::finished;
  member.message.clear();
}

std::vector<GroupNumbers> numbers_by_group(Study const& study, std::vector<MemberResult> const& members) {
  std::vector<GroupNumbers> groups(study.groups.size());
  for (MemberResult const& member : members) {
    if (member.state != MemberState::finished) continue;
    GroupNumbers& group = groups[member.group];
    group.name = study.groups[member.group].name;
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
    GroupNumbers material{first.material, first.settings, {}, {}};
    std::erase_if(material.settings, [](Setting const& setting) { return setting.first == stress_key; });
    std::map<std::uint64_t, std::pair<std::vector<FailureStress>, std::vector<FailureStress>>> by_seed;
    std::vector<std::uint64_t> order;
    for (MemberResult const& member : members) {
      if (study.groups[member.group].material != first.material || !member.peak) continue;
      if (!by_seed.contains(member.seed)) order.push_back(member.seed);
      by_seed[member.seed].first.push_back(*member.peak);
      by_seed[member.seed].second.push_back(*member.residual);
    }
    for (std::uint64_t const seed : order) {
      bool any = false;
      add_envelope(material, by_seed[seed].first, "peak", any);
      add_envelope(material, by_seed[seed].second, "residual", any);
      if (any) material.seeds.push_back(seed);
    }
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
