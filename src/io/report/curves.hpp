#pragma once
/// Figures of the curves in history.csv.
#include <functional>
#include <string>
#include <vector>

#include "io/report/figure.hpp"
#include "io/report/laboratory_overlay.hpp"
#include "io/report/plot.hpp"
#include "io/results/run_results.hpp"

namespace clathra {

/// "s55-1mpa: 55 % hydrate, 1 MPa"
std::string run_label(RunResults const& run);

/// Runs as the figures of a page show them.
struct ShownRuns {
  std::vector<RunResults> const& runs;
  LaboratoryOverlay& data;                  ///< what is laid over them
  std::function<Curve(std::size_t)> style;  ///< name and stroke of the curve of each; runs of one name have one entry in legends
};
/// Each with its label and a stroke of its own.
ShownRuns shown_runs(std::vector<RunResults> const& runs, LaboratoryOverlay& data);

/// q, eps_v, intact share, and for each run with bonds what broke them, against eps_1; e against p in the consolidation, q / p
/// against dilatancy.
Piece curve_figures(ShownRuns const& shown);

/// Where the work went, for each run that kept the ledger; empty where none did.
Piece energy_figures(std::vector<RunResults> const& runs);

}  // namespace clathra
