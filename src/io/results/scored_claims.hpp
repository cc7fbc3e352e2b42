#pragma once
/// The claims of a paper with the numbers of our tests.
#include "domain/measurement/claims.hpp"
#include "io/results/paper.hpp"

namespace clathra {

/// All claims, also those of which there are no numbers. @param d50  [m]
std::vector<Claim> scored_claims(Paper const& paper, TestQuantities const& numbers, double d50);

}  // namespace clathra
