#pragma once
/// Figures of hydrate that changes under load.
#include <vector>

#include "io/report/curves.hpp"

namespace clathra {

/// The rows of a run from the one before its hydrate first changes; none where it does not.
std::vector<std::size_t> rows_where_hydrate_changes(RunResults const& run);

/// Of the runs whose stages change the hydrate: the path in the plane of temperature and pressure with the boundary of
/// stability; saturation and bonds, stresses, and strains at rest after each increment. Empty where there are none.
Piece hydrate_figures(ShownRuns const& shown);

}  // namespace clathra
