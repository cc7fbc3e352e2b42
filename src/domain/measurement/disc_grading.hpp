#pragma once
/// The grading of the discs that there are.
#include <vector>

#include "domain/parallel/ranks.hpp"
#include "domain/scene/grading.hpp"

namespace clathra {

/// The largest distance between the grading of discs (by area) and a curve, as a fraction of mass.
double grading_distance(Grading const& grading, std::vector<double> const& radii, Ranks const& ranks = {});

/// d_x [m] of given discs by area fraction.
double diameter_finer(std::vector<double> const& radii, double fraction, Ranks const& ranks = {});

}  // namespace clathra
