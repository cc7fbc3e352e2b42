#pragma once
/// A periodic cell of discs at rest, and boxes filled with its copies: packings of any size in no time, to measure speed with.
#include "domain/generation/equilibration.hpp"
#include "domain/scene/specimen_design.hpp"

namespace clathra {

/// A periodic cell of about `particles` discs at rest under the bonding stress, at the design's void ratio.
PackedSpecimen pack_periodic_cell(Scene const& scene, SpecimenDesign const& design, std::int64_t particles,
                                  ProgressCallback const& progress);

/// Copies of a periodic cell side by side from (0, 0), with the history of their contacts, keeping the discs that lie inside the
/// box. Contacts across the walls are cut.
/// @return this rank's share: the tiles are dealt out among the ranks
Specimen replicate(Specimen const& cell, double width, double height, Ranks const& ranks = {});

}  // namespace clathra
