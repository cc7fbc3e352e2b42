#pragma once
/// Mohr circles of tests at several confining stresses with their envelope, and what comes of it against the saturation.
#include <string>
#include <vector>

#include "io/report/figure.hpp"
#include "io/results/run_results.hpp"

namespace clathra {

/// Circles at the peak and in the residual state for each material (see tested_material.hpp) that was tested at two confining
/// stresses or more, with the envelope of the tests whose q has passed its peak; what comes of it against the saturation; and why
/// runs are not joined. Empty where there is nothing of that.
Piece strength_figures(std::vector<RunResults> const& runs);

}  // namespace clathra
