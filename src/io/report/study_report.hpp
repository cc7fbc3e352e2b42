#pragma once
/// The page on a study: means with bands over its seeds, strength with intervals, small multiples.
#include <filesystem>
#include <optional>
#include <vector>

#include "io/report/figure.hpp"
#include "io/results/laboratory_data.hpp"
#include "io/results/study_results.hpp"

namespace clathra {

/// Writes the page, which needs nothing but itself. Members that are not finished or failed are named. @return its figures
/// @param folders  of the members' runs;  @param data  laid over its curves  @throws FileProblem
std::vector<Figure> write_study_report(Study const& study, std::vector<MemberResult> const& members,
                                       std::vector<std::filesystem::path> const& folders, std::filesystem::path const& html,
                                       std::optional<LaboratoryData> const& data = {});

}  // namespace clathra
