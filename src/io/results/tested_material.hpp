#pragma once
/// Which runs are tests of the same material, by the scenes that run.json keeps.
#include <map>
#include <string>
#include <vector>

#include "io/results/run_results.hpp"

namespace clathra {

/// Values of a scene by key ("grains.friction"), as a scene file states them.
using SceneValues = std::map<std::string, std::string>;

/// The values that can matter to the strength of a run's material, its saturation and confining stress among them; a key that
/// run.json does not have yet has its default. Left out is what only chooses how it is computed or written: run.seed,
/// run.threads, run.ignore_guards, run.verlet_skin, [output], and specimen.file, instead of which the
/// discs and the void ratio of the specimen that was read stand here (to 0.001). Without bonds at the start there is no
/// saturation, and of [hydrate] and [bond] only specimen.preparation_stress counts.
SceneValues material_of(RunResults const& run);

/// Keys that are not the same in all.
std::vector<std::string> differing_keys(std::vector<SceneValues> const& materials);

/// "friction 0.3, void ratio 0.22": these keys of a material as people say them.
std::string in_words(SceneValues const& material, std::vector<std::string> const& keys);

}  // namespace clathra
