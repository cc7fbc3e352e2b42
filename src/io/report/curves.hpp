#pragma once
/// Figures of the curves in history.csv.
#include <string>
#include <vector>

#include "io/report/figure.hpp"
#include "io/results/run_results.hpp"

namespace clathra {

/// "s55-1mpa: 55 % hydrate, 1 MPa"
std::string run_label(RunResults const& run);

/// q, eps_v, intact share, and for each run with bonds what broke them, against eps_1; e against p in the consolidation, q / p
/// against dilatancy.
Piece curve_figures(std::vector<RunResults> const& runs);

/// Where the work went, for each run that kept the ledger; empty where none did.
Piece energy_figures(std::vector<RunResults> const& runs);

}  // namespace clathra
