#pragma once
/// How a specimen strains under small stress increments of all directions (Gudehus' response envelope).
#include "io/report/curves.hpp"

namespace clathra {

/// Lateral and axial strain after the last increment of each run that puts one stress on both pairs of sides, a closed curve for
/// each seed in the order of the directions of the increments. Empty where no seed has enough of them.
Piece response_envelopes(ShownRuns const& shown);

}  // namespace clathra
