#pragma once
/// The contact laws that a scene asks for: the one way from its keys to their constants.
#include "domain/scene/scene.hpp"
#include "kernels/wall_forces.hpp"

namespace clathra {

inline GrainLaw grain_law(Scene const& scene) {
  return {scene.grains.kn, scene.grains.ks, scene.grains.friction, scene.grains.shape_factor, scene.grains.contact_damping};
}

/// Walls are as stiff as grains, without dashpots.
inline WallLaw wall_law(Scene const& scene, double friction) { return {scene.grains.kn, scene.grains.ks, friction, 0}; }

/// What a dense packing loses of its void ratio from an isotropic stress [Pa] to that of the test, elastically, to a fifth.
inline double elastic_loss(Scene const& scene, double void_ratio, double stress) {
  constexpr double bulk_modulus = 0.5;  // over k_n
  return (1 + void_ratio) * (scene.test.confining_stress - stress) / (bulk_modulus * scene.grains.kn);
}

}  // namespace clathra
