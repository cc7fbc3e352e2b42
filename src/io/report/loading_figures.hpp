#pragma once
/// Figures of tests that are more than one compression to failure: chosen by what the stages of a run are.
#include <vector>

#include "domain/scene/loading_stage.hpp"
#include "io/report/curves.hpp"
#include "io/report/figure.hpp"
#include "io/results/run_results.hpp"

namespace clathra {

/// The stages that a run was asked for; none where its record has holes.
std::vector<LoadingStage> stages_of_run(RunResults const& run);

/// Of the runs that have them: the response envelope; the stress path q over p; e over the logarithm of the stress that is put
/// on; sigma_3 over sigma_1 without lateral strain; pore pressure and stress ratio over eps_1 at constant volume; strain under a
/// dead load. Empty where all runs are compressions under constant lateral stress.
Piece loading_figures(ShownRuns const& shown);

/// Stress ratio over dilatancy, over stretches of 0.5 % of axial strain that close, of each shear whose volume is free.
Piece dilatancy_figure(ShownRuns const& shown);

/// A table of the stages of each such run: what each ended by, and its numbers. Empty likewise.
Piece stage_tables(std::vector<RunResults> const& runs);

}  // namespace clathra
