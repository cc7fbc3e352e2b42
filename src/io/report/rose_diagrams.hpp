#pragma once
/// Polar diagrams of how contacts and their forces are oriented.
#include <string>

#include "domain/measurement/fabric.hpp"
#include "io/report/figure.hpp"

namespace clathra {

/// Two polar diagrams: of `now` as filled petals with the fitted cosine, of `before` as a dashed outline.
Piece normal_rose(Rose const& now, Rose const& before, std::string const& label);
Piece force_rose(Rose const& now, Rose const& before, std::string const& label);

}  // namespace clathra
