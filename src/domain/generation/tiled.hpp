#pragma once
/// Large specimens from one periodic cell: packed once, replicated, cut by the walls, relaxed near them.
#include "domain/generation/packing.hpp"

namespace clathra {

/// A periodic cell of about `particles` discs at rest under the bonding stress, at the design's void ratio.
PackedSpecimen pack_periodic_cell(Scene const& scene, SampleDesign const& design, std::int64_t particles,
                                  ProgressCallback const& progress);

/// Copies of a periodic cell side by side from (0, 0), with the history of their contacts, keeping the discs that lie inside the
/// box. Contacts across the walls are cut.
/// @return this rank's share: the tiles are dealt out among the ranks
Specimen replicate(Specimen const& cell, double width, double height, Ranks const& ranks = {});

/// The whole specimen: cell (each rank makes the same one: it is small),  replication, and a relaxation in which only the walls'
/// surroundings have to move.
PackedSpecimen pack_by_tiling(Scene const& scene, SampleDesign const& design, ProgressCallback const& progress,
                              Ranks const& ranks = {});

}  // namespace clathra
