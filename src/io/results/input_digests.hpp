#pragma once
/// Which files a run has read, by their content.
#include <string>

#include "domain/scene/scene.hpp"

namespace clathra {

/// XXH3-128 of the files that a scene reads, "" where it reads none.
struct InputDigests {
  std::string specimen, grading;
};
/// @throws FileProblem
InputDigests input_digests(Scene const& scene);

}  // namespace clathra
