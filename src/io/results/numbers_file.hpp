#pragma once
/// The numbers of runs for other programs: what `clathra report --json` writes.
#include <filesystem>
#include <vector>

#include "io/results/run_results.hpp"

namespace clathra {

/// `runs`: name, folder, hydrate saturation (0 to 1), confining stress [Pa], seed, and `numbers` as in run.json. `strength`, for
/// each material that was tested at several confining stresses: saturation, its tests, and `peak` and `residual` by
/// paired_strength(): c [Pa] and phi [degrees], means over the complete seeds with half of their 95 % intervals; of one seed, or
/// of tests that share no specimen, one fit with its standard errors and r_squared; curvature [1/Pa]; null where there is none of
/// it; the complete and the other seeds, and the tests whose stress still rose. The same numbers as on the page and in study.csv,
/// by the same code.
nlohmann::ordered_json numbers_of(std::vector<RunResults> const& runs);

/// @throws FileProblem cannot_create or io_error
void write_numbers(std::vector<RunResults> const& runs, std::filesystem::path const& path);

}  // namespace clathra
