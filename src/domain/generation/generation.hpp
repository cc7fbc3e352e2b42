#pragma once
/// From a scene to a specimen at rest.
#include <functional>
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

/// Makes the specimen of a scene by scene.specimen.generator. Same scene, same bits, for any thread count.
/// @throws Refused where it does not come to rest, VoidRatioMissed at a void ratio that is not that of the scene to 0.001;
/// Diverged, Stopped
/// @return this rank's share of the specimen, and the record of the whole
GeneratedSpecimen make_specimen(Scene const& scene, ProgressCallback const& progress, Ranks const& ranks = {});

using SpecimenMaker = std::function<GeneratedSpecimen(Scene const&)>;

/// What `make` makes of a scene. @throws Refused where it misses the void ratio, with one that it does not miss: some are tried
GeneratedSpecimen made_or_advised(Scene const& scene, SpecimenMaker const& make);

/// make_specimen(), or advice.
GeneratedSpecimen generate_specimen(Scene const& scene, ProgressCallback const& progress, Ranks const& ranks = {});

}  // namespace clathra
