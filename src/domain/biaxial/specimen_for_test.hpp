#pragma once
/// The specimen that a scene asks for.
#include "domain/generation/generation.hpp"

namespace clathra {

/// Generates the specimen of a scene. Where the void ratio is that at the start of the test (`specimen.void_ratio_at`), specimens
/// are made, and consolidated as the test does it, until one has it then to 0.001; its record says `void_ratio_at_test`.
/// @throws Refused, with a void ratio that was tried and works; Diverged, Stopped
/// @return this rank's share of the specimen as it was made, and the record of the whole
GeneratedSpecimen specimen_for_test(Scene const& scene, ProgressCallback const& progress, Ranks const& ranks = {});

}  // namespace clathra
