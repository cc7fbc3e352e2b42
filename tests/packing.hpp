#pragma once
/// A packing of the paper's grading for tests of what depends on it.
#include "domain/generation/generation.hpp"
#include "domain/scene/scene.hpp"
#include "domain/scene/specimen.hpp"

namespace clathra {

/// 400 discs at rest under 50 kPa, made once a program.
inline Specimen const& packing() {
  static Specimen const specimen = [] {
    Scene scene;
    scene.specimen.particles = 400;
    scene.specimen.void_ratio = 0.3;
    scene.specimen.compaction_layers = 2;
    return generate_specimen(scene, {}).specimen;
  }();
  return specimen;
}

}  // namespace clathra
