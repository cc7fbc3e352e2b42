#pragma once
/// What is likely not meant of hydrate that changes in stages.
#include <string>
#include <vector>

#include "domain/scene/scene.hpp"

namespace clathra {

/// A line for each stage and thing: what changes nothing, and hydrate that is lost where it is stable, or stays where it is not.
std::vector<std::string> hydrate_course_warnings(Scene const& scene, std::vector<LoadingStage> const& stages);

}  // namespace clathra
