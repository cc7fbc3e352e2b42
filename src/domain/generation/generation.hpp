#pragma once
/// From a scene to a specimen at rest.
#include <string>
#include <vector>

#include "domain/parallel/ranks.hpp"
#include "domain/scene/scene.hpp"
#include "domain/scene/specimen.hpp"
#include "domain/scene/stage.hpp"

namespace clathra {

/// A generated specimen with the proof of its quality: void ratio (whole, each layer, standard deviation), distance to the
/// grading, d50, friction used, stress and unbalanced ratio.
struct GeneratedSpecimen {
  Specimen specimen;
  StageRecord record;
  std::vector<double> layer_void_ratios;
  std::vector<std::string> warnings;
};

/// Generates by scene.sample.generator (not `file`). Same scene, same bits, for any thread count.
/// @throws Refused where it does not come to rest, or at a void ratio that is not that of the scene to 0.001, with one that it
/// does come to rest at;
/// Diverged, Stopped
/// @return this rank's share of the specimen, and the record of the whole
GeneratedSpecimen generate_specimen(Scene const& scene, ProgressCallback const& progress, Ranks const& ranks = {});

}  // namespace clathra
