#pragma once
/// The contact laws that a scene asks for: the one way from its keys to their constants.
#include "domain/scene/scene.hpp"
#include "kernels/wall_forces.hpp"

namespace clathra {

inline GrainLaw grain_law(Scene const& scene) {
  return {scene.grains.normal_stiffness, scene.grains.shear_stiffness, scene.grains.friction, scene.grains.rolling_width_factor,
          scene.damping.viscous_ratio};
}

/// Walls are as stiff as grains, without dashpots.
inline WallLaw wall_law(Scene const& scene, double friction) {
  return {scene.grains.normal_stiffness, scene.grains.shear_stiffness, friction, 0};
}

/// What a dense packing loses of its void ratio from an isotropic stress [Pa] to that of the test, elastically, to a fifth.
inline double elastic_loss(Scene const& scene, double void_ratio, double stress) {
  constexpr double bulk_modulus = 0.5;  // over k_n
  return (1 + void_ratio) * (scene.test.confining_stress - stress) / (bulk_modulus * scene.grains.normal_stiffness);
}

}  // namespace clathra
