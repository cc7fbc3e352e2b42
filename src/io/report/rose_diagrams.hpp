#pragma once
/// Polar diagrams of how contacts and their forces are oriented.
#include <string>

#include "domain/measurement/fabric.hpp"

namespace clathra {

/// Two polar diagrams: of `now` as filled petals with the fitted cosine, of `before` as a dashed outline. SVGs.
std::string normal_rose(Rose const& now, Rose const& before, std::string const& label);
std::string force_rose(Rose const& now, Rose const& before, std::string const& label);

}  // namespace clathra
