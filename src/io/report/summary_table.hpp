#pragma once
/// The head of the report: one sentence, the table over all runs, and their warnings.
#include <string>
#include <vector>

#include "io/results/run_results.hpp"

namespace clathra {

/// What was tested and what came out, in plain words.
std::string summary_sentence(std::vector<RunResults> const& runs);

/// A row a quantity, a column a run. HTML.
std::string summary_table(std::vector<RunResults> const& runs);

/// What the runs warned of, and runs that ended before their time; empty where there is nothing. HTML.
std::string warning_list(std::vector<RunResults> const& runs);

/// Which columns histories lack, so that something is left out; empty where nothing is. HTML.
std::string note_on_missing_columns(std::vector<RunResults> const& runs);

}  // namespace clathra
