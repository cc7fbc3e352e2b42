#pragma once
/// Figures of hydrate that changes under load.
#include <string>
#include <vector>

#include "io/report/curves.hpp"

namespace clathra {

/// The rows of a stage in which hydrate changes: from the last one before it does.
struct HydrateStageRows {
  std::string stage;
  std::size_t before = 0, end = 0;
};
std::vector<HydrateStageRows> stages_that_change_hydrate(RunResults const& run);
/// Those of all such stages; none where no hydrate changes.
std::vector<std::size_t> rows_where_hydrate_changes(RunResults const& run);

/// Of the runs whose stages change the hydrate: the path in the plane of temperature and pressure with the boundary of
/// stability; saturation and bonds, stresses, and strains at rest after each increment. Empty where there are none.
Piece hydrate_figures(ShownRuns const& shown);

}  // namespace clathra
