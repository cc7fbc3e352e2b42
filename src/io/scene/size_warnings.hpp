#pragma once
/// What the sizes of the grains make of a test that nobody might expect.
#include <string>
#include <vector>

#include "domain/scene/grading.hpp"

namespace clathra {

/// Warnings of a curve, or of the discs of a specimen: a median on a plateau, grains as good as equal.
std::vector<std::string> size_warnings(CurveSizes const& sizes);

}  // namespace clathra
