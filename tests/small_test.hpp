#pragma once
/// A biaxial test of a few seconds.
#include "domain/biaxial/biaxial_test.hpp"
#include "domain/generation/generation.hpp"
#include "domain/measurement/history_row.hpp"
#include "domain/scene/scene.hpp"
#include "domain/scene/specimen.hpp"

namespace clathra {

/// A small hydrate-bearing specimen, sheared well past its peak.
inline Scene small_test() {
  Scene scene;
  scene.specimen.particles = 400;
  scene.specimen.void_ratio = 0.24;
  scene.specimen.compaction_layers = 2;
  scene.hydrate.saturation = 0.55;
  scene.test.axial_strain = 0.04;
  scene.output.records = 40;
  scene.run.precision = Precision::full;
  return scene;
}

inline Specimen const& small_specimen() {
  static Specimen const specimen = generate_specimen(small_test(), {}).specimen;
  return specimen;
}

}  // namespace clathra
