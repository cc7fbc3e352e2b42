#pragma once
/// report.html: one page that explains one run or several, with everything in it: it opens without a network, and needs no
/// script.
#include <filesystem>
#include <optional>
#include <vector>

#include "io/report/figure.hpp"
#include "io/results/laboratory_data.hpp"

namespace clathra {

/// Writes the report on the runs in these folders, in their order; under 5 MB. @param data  laid over its
/// curves  @return its figures
/// @throws FileProblem file_missing or bad_input where a run cannot be read, cannot_create or io_error where the page cannot be
/// written
std::vector<Figure> write_report(std::vector<std::filesystem::path> const& run_folders, std::filesystem::path const& html,
                                 std::optional<LaboratoryData> const& data = {});

}  // namespace clathra
