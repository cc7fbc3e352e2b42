#pragma once
/// report.html: one page that explains one run or several, with everything in it: it opens without a network, and needs no
/// script.
#include <filesystem>
#include <vector>

#include "io/report/figure.hpp"

namespace clathra {

/// Writes the report on the runs in these folders, in their order; under 5 MB. @return its figures
/// @throws FileProblem file_missing or bad_input where a run cannot be read, cannot_create or io_error where the page cannot be
/// written
std::vector<Figure> write_report(std::vector<std::filesystem::path> const& run_folders, std::filesystem::path const& html);

}  // namespace clathra
