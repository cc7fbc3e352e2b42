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
CurveSizes sizes_of(std::vector<double> const& radii, Ranks const& ranks = {});

/// The curve of given discs, to 1 % of the mass. Collective.
Grading grading_of(std::vector<double> const& radii, Ranks const& ranks = {});

/// Area of all discs [m^2], overlaps counted twice. Collective.
double solid_area(std::vector<double> const& radii, Ranks const& ranks = {});

/// The smallest radius [m] that a share of all discs, by number, lies below. Collective.
/// @param radii  of this rank's discs [m];  @param share  0 to 1
double radius_above(std::vector<double> const& radii, double share, Ranks const& ranks = {});

}  // namespace clathra
