#pragma once
/// The page on a reproduction of a paper: its figures from our tests beside its words, and the scorecard.
#include <filesystem>
#include <optional>
#include <vector>

#include "domain/scene/scene.hpp"
#include "io/results/laboratory_data.hpp"
#include "io/results/paper.hpp"
#include "io/results/scorecard.hpp"
#include "io/results/study_results.hpp"

namespace clathra {

/// What the page shows. The study's groups are those of the paper.
struct Reproduction {
  Study const& study;
  std::vector<MemberResult> const& members;
  std::vector<std::filesystem::path> const& folders;  ///< of the members' runs
  Paper const& paper;
  Scorecard const& card;
  Scene const& scene;  ///< of one of the tests, for tables
  double d50 = 0;      ///< [m]
  std::optional<LaboratoryData> data;
};

/// Writes the page, which needs nothing but itself. Figures of which there are no tests are left out. @throws FileProblem
void write_paper_report(Reproduction const& reproduction, std::filesystem::path const& html);

}  // namespace clathra
