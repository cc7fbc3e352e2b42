#pragma once
/// Where steps stop: what the box and the stresses of its walls must stay between.
#include "kernels/walls.hpp"

namespace clathra {

/// An open interval. Without bounds nothing leaves it.
struct OpenRange {
  Real low = -1e300, high = 1e300;

  KOKKOS_INLINE_FUNCTION bool holds(Real value) const { return low < value && value < high; }
};

/// Stresses are those of the walls, sigma_1 the vertical one, compression positive [Pa].
struct StepLimits {
  OpenRange height, area;  ///< of the box [m], [m^2]
  OpenRange deviator;      ///< q = sigma_1 - sigma_3
  OpenRange mean;          ///< p = (sigma_1 + sigma_3) / 2
  OpenRange ratio;         ///< q / p
  bool of_stress = false;  ///< whether any of the last three is bounded

  KOKKOS_INLINE_FUNCTION bool hold(Box const& box, Walls const& walls, WallReactions const& reactions) const {
    if (!height.holds(box.height()) || !area.holds(box.area())) return false;
    if (!of_stress) return true;
    WallStress const stress = wall_stress(walls, reactions);
    Real const q = stress.y - stress.x, p = 0.5 * (stress.y + stress.x);
    return deviator.holds(q) && mean.holds(p) && ratio.low * p < q && q < ratio.high * p;
  }
};

}  // namespace clathra
