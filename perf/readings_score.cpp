/// Scores readings of Jiang et al. (2017) by its claims, from the members of studies that perf/readings/screen.py wrote.
///   readings_score share/papers/jiang-2017.toml MEMBERS...
/// MEMBERS are folders of runs named <reading>_<saturation>pct_<stress>MPa-seed<n>; those of clean sand are named
/// beta<shape factor>_<stress>MPa-seed<n>, and a reading that ends in "beta1" is compared with those of beta1. Prints CSV, best
/// first: the mean over claims 2 to 9 of the share of their parts whose mean lies within the bounds, that of each claim, and
/// the numbers that tell readings apart.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "domain/scene/grading.hpp"
#include "io/results/paper_file.hpp"
#include "io/results/scored_claims.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

struct Run {
  std::string reading;
  int saturation = 0, stress = 0;
  std::uint64_t seed = 0;
  fs::path folder;
};

std::vector<Run> runs_in(fs::path const& members) {
  static std::regex const name("(.*?)_(?:(\\d+)pct_)?(\\d+)MPa-seed(\\d+)");
  std::vector<Run> runs;
  for (fs::directory_entry const& entry : fs::directory_iterator(members)) {
    std::smatch match;
    std::string const text = entry.path().filename().string();
    if (!std::regex_match(text, match, name) || !fs::exists(entry.path() / "final.h5")) continue;
    runs.push_back(
        {match[1], match[2].matched ? std::stoi(match[2]) : 0, std::stoi(match[3]), std::stoull(match[4]), entry.path()});
  }
  return runs;
}

/// The paper's group of a saturation [%] and a stress [MPa].
StudyGroup const* group_at(Paper const& paper, int saturation, int stress) {
  for (StudyGroup const& group : paper.groups) {
    Scene const scene = stated_scene(paper, group);
    if (std::lround(100 * scene.hydrate.saturation) == saturation && std::lround(1e-6 * scene.test.confining_stress) == stress)
      return &group;
  }
  return nullptr;
}

/// The tests of one reading with their sands, as a study of the paper's groups.
struct Tests {
  Study study;
  std::vector<MemberResult> members;
  std::vector<fs::path> folders;

  void add(Paper const& paper, Run const& run) {
    StudyGroup const* const group = group_at(paper, run.saturation, run.stress);
    if (!group) throw std::runtime_error(run.folder.string() + ": the paper has no such test");
    auto found =
        std::find_if(study.groups.begin(), study.groups.end(), [&](StudyGroup const& g) { return g.name == group->name; });
    if (found == study.groups.end()) found = study.groups.insert(study.groups.end(), *group);
    MemberResult member;
    member.group = static_cast<std::size_t>(found - study.groups.begin());
    member.seed = run.seed;
    read_member(member, run.folder);
    members.push_back(member);
    folders.push_back(run.folder);
  }
};

struct Row {
  double score = 0;
  std::string text;
};

double mean_of(SeedNumbers const& values) {
  double sum = 0;
  for (auto const& [seed, value] : values) sum += value;
  return values.empty() ? NAN : sum / static_cast<double>(values.size());
}

Row row_of(Paper paper, std::string const& reading, Tests const& tests) {
  TestQuantities const numbers = quantities_of_members(tests.study, tests.members, tests.folders, paper.strains);
  std::vector<std::string> made;
  for (StudyGroup const& group : tests.study.groups) made.push_back(group.name);
  keep_only(paper, made);
  std::vector<Claim> const claims = scored_claims(paper, numbers, Grading::toyoura().d50());
  Row row{0, reading};
  std::string shares;
  char text[64];
  for (std::size_t i = 0; i < claims.size(); ++i) {
    if (1 <= i && i <= 8) row.score += claims[i].share_inside() / 8;
    std::snprintf(text, sizeof text, ",%.2f", claims[i].share_inside());
    shares += text;
  }
  std::snprintf(text, sizeof text, ",%.3f", row.score);
  row.text += text + shares;
  for (int const saturation : {26, 55})
    for (char const* const number : {"peak_q_Pa", "top_eps1"})
      for (int const stress : {1, 3}) {
        StudyGroup const* const group = group_at(paper, saturation, stress);
        double const value = group ? mean_of(numbers.of(group->name, number)) : NAN;
        std::snprintf(text, sizeof text, ",%.2f", number[0] == 'p' ? value * 1e-6 : value * 100);
        row.text += text;
      }
  for (char const* const number : {"end_of_contraction_eps1", "q_share_at_6.71"}) {
    StudyGroup const* const group = group_at(paper, 55, 3);
    std::snprintf(text, sizeof text, ",%.3f", group ? mean_of(numbers.of(group->name, number)) : NAN);
    row.text += text;
  }
  for (int const saturation : {0, 26, 55}) {
    StudyGroup const* const group = group_at(paper, saturation, 1);
    std::string const material = group ? group->material : "";
    std::snprintf(text, sizeof text, ",%.1f,%.2f", mean_of(numbers.of(material, "peak_friction_angle_deg")),
                  mean_of(numbers.of(material, "peak_cohesion_Pa")) * 1e-6);
    row.text += text;
  }
  return row;
}

int run(int argc, char** argv) {
  if (argc < 3) return std::fputs("usage: readings_score PAPER MEMBERS...\n", stderr), 64;
  Paper const paper = load_paper(argv[1]);
  std::vector<Run> runs;
  for (int i = 2; i < argc; ++i)
    for (Run& one : runs_in(argv[i])) runs.push_back(std::move(one));
  std::map<std::string, Tests> readings;
  for (Run const& one : runs)
    if (one.saturation > 0) readings[one.reading].add(paper, one);
  for (auto& [reading, tests] : readings)
    for (Run const& one : runs)
      if (one.saturation == 0 && reading.ends_with(one.reading)) tests.add(paper, one);
  std::vector<Row> rows;
  for (auto const& [reading, tests] : readings) rows.push_back(row_of(paper, reading, tests));
  std::stable_sort(rows.begin(), rows.end(), [](Row const& a, Row const& b) { return a.score > b.score; });
  std::puts(
      "reading,score,c1,c2,c3,c4,c5,c6,c7,c8,c9,c10,c11a,c11b,c12,c13,c14,c15,c16,q and strain [MPa, %] of each saturation,"
      "end of contraction and q(6.71 %)/peak of 55 % at 3 MPa, phi and c of sand, 26, 55 %");
  for (Row const& row : rows) std::puts(row.text.c_str());
  return 0;
}

}  // namespace
}  // namespace clathra

int main(int argc, char** argv) { return clathra::run(argc, argv); }
