#pragma once
/// How much the specimen was sheared, place by place.
#include <vector>

#include "domain/measurement/snapshot.hpp"

namespace clathra {

/// Width of the window over which the strain is averaged, in mean diameters.
inline constexpr double strain_window = 7.5;

/// Natural shear strain since the shear began at each disc: ln(l1 / l2), the difference of the principal natural strains. In a
/// homogeneous test it is eps_1 - eps_3. The gradient of the displacements is a least-squares fit over the 3 x 3 cells around the
/// disc where it was at first, so that the motion of single grains averages out and rigid rotation does not count. NaN where
/// fewer than six discs are near, or these do not fix a gradient.
std::vector<float> shear_strain(Snapshot const& snapshot);

}  // namespace clathra
