#include "io/results/paper_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "domain/measurement/strength_fit.hpp"
#include "io/results/run_results.hpp"

namespace clathra {
namespace {

/// Tests of one material and seed at their peaks and in their residual state.
struct SeedTests {
  std::vector<FailureStress> peaks, residuals;
};

void add_envelope(std::map<std::string, double>& numbers, std::vector<FailureStress> const& tests, std::string const& state) {
  std::optional<Envelope> const fit = fitted_envelope(tests);
  if (!fit) return;
  numbers[state + "_cohesion_Pa"] = fit->cohesion;
  numbers[state + "_friction_angle_deg"] = fit->friction_angle * 180 / std::numbers::pi;
}

void add_envelopes(PaperNumbers& numbers, Study const& study, std::vector<MemberResult> const& members) {
  std::map<std::pair<std::string, std::uint64_t>, SeedTests> tests;
  for (MemberResult const& member : members) {
    if (member.state != MemberState::finished || !member.peak) continue;
    SeedTests& of = tests[{study.groups[member.group].material, member.seed}];
    of.peaks.push_back(*member.peak);
    if (member.residual) of.residuals.push_back(*member.residual);
  }
  for (auto const& [key, of] : tests) {
    std::map<std::string, double> fits;
    add_envelope(fits, of.peaks, "peak");
    add_envelope(fits, of.residuals, "residual");
    numbers.add(key.first, key.second, fits);
  }
}

}  // namespace

PaperNumbers numbers_of_members(Study const& study, std::vector<MemberResult> const& members,
                                std::vector<std::filesystem::path> const& folders) {
  PaperNumbers numbers;
  for (std::size_t i = 0; i < members.size(); ++i) {
    if (members[i].state != MemberState::finished) continue;
    std::string const& cell = study.groups[members[i].group].name;
    numbers.add(cell, members[i].seed, numbers_of_history(HistoryTable(folders[i] / "history.csv")));
  }
  add_envelopes(numbers, study, members);
  return numbers;
}

}  // namespace clathra
