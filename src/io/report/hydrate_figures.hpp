#pragma once
/// Figures of hydrate that changes under load.
#include "io/report/curves.hpp"

namespace clathra {

/// Of the runs whose stages change the hydrate: the path in the plane of temperature and pressure with the boundary of
/// stability; saturation and bonds, stresses, and strains at rest after each increment. Empty where there are none.
Piece hydrate_figures(ShownRuns const& shown);

}  // namespace clathra
