#pragma once
/// Symmetric tensors of the plane: their principal values and axes.
#include "domain/measurement/snapshot.hpp"

namespace clathra {

/// Eigenvalues of a symmetric tensor and the direction of the axis that belongs to the larger one.
struct PrincipalAxes {
  double major = 0, minor = 0;  ///< major >= minor, in the unit of the tensor
  double direction = 0;         ///< of the major axis [rad], 0 to pi from the horizontal, anticlockwise
};

/// @param xx,yy,xy  components of the tensor
PrincipalAxes principal_axes(double xx, double yy, double xy);

/// Principal values and directions of the mean stress between the walls [Pa], compression positive: the mean stresses in the
/// discs (Snapshot::stress_xx), each weighed by the area of its disc, over the area between the walls.
PrincipalAxes principal_stress(Snapshot const& snapshot);

}  // namespace clathra
