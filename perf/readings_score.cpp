/// Scores readings of Jiang et al. (2017) by its claims, from the members of studies that perf/readings/screen.py wrote.
///   readings_score MEMBERS...
/// MEMBERS are folders of runs named <reading>_<saturation>pct_<stress>MPa-seed<n>; those of clean sand are named
/// beta<shape factor>_<stress>MPa-seed<n>, and a reading that ends in "beta1" is compared with those of beta1. Prints CSV, best
/// first: the mean over claims 2 to 9 of the share of their parts whose mean lies within the bounds, that of each claim, and
/// the numbers that tell readings apart.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "domain/scene/grading.hpp"
#include "io/results/paper_numbers.hpp"

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

/// The tests of one reading with their sands, as a study whose groups are named by paper_cell().
struct Tests {
  Study study;
  std::vector<MemberResult> members;
  std::vector<fs::path> folders;
  std::set<int> saturations, stresses;

  void add(Run const& run) {
    StudyGroup const group{paper_cell(run.saturation, run.stress), {}, paper_material(run.saturation)};
    auto found =
        std::find_if(study.groups.begin(), study.groups.end(), [&](StudyGroup const& g) { return g.name == group.name; });
    if (found == study.groups.end()) found = study.groups.insert(study.groups.end(), group);
    MemberResult member;
    member.group = static_cast<std::size_t>(found - study.groups.begin());
    member.seed = run.seed;
    read_member(member, run.folder);
    members.push_back(member);
    folders.push_back(run.folder);
    if (run.saturation > 0) saturations.insert(run.saturation);
    stresses.insert(run.stress);
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

Row row_of(std::string const& reading, Tests const& tests) {
  PaperDesign design;
  design.saturations.assign(tests.saturations.begin(), tests.saturations.end());
  design.stresses.assign(tests.stresses.begin(), tests.stresses.end());
  design.thicknesses.clear();
  PaperNumbers const numbers = numbers_of_members(tests.study, tests.members, tests.folders);
  std::vector<Claim> const claims = paper_claims(design, numbers, Grading::toyoura().d50());
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
  for (int const saturation : design.saturations)
    for (char const* const number : {"peak_q_Pa", "top_eps1"})
      for (int const stress : design.stresses) {
        double const value = mean_of(numbers.of(paper_cell(saturation, stress), number));
        std::snprintf(text, sizeof text, ",%.2f", number[0] == 'p' ? value * 1e-6 : value * 100);
        row.text += text;
      }
  for (char const* const number : {"end_of_contraction_eps1", "q_share_at_6.71"}) {
    std::snprintf(text, sizeof text, ",%.3f", mean_of(numbers.of(paper_cell(55, 3), number)));
    row.text += text;
  }
  for (int const saturation : {0, 26, 55}) {
    std::snprintf(text, sizeof text, ",%.1f,%.2f", mean_of(numbers.of(paper_material(saturation), "peak_friction_angle_deg")),
                  mean_of(numbers.of(paper_material(saturation), "peak_cohesion_Pa")) * 1e-6);
    row.text += text;
  }
  return row;
}

int run(int argc, char** argv) {
  std::vector<Run> runs;
  for (int i = 1; i < argc; ++i)
    for (Run& one : runs_in(argv[i])) runs.push_back(std::move(one));
  std::map<std::string, Tests> readings;
  for (Run const& one : runs)
    if (one.saturation > 0) readings[one.reading].add(one);
  for (auto& [reading, tests] : readings)
    for (Run const& one : runs)
      if (one.saturation == 0 && reading.ends_with(one.reading)) tests.add(one);
  std::vector<Row> rows;
  for (auto const& [reading, tests] : readings) rows.push_back(row_of(reading, tests));
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
