#pragma once
/// Specimens dealt out among the ranks in another way.
#include "domain/parallel/ranks.hpp"
#include "domain/scene/specimen.hpp"

namespace clathra {

/// The order of a file: discs to the rank that keeps their block of ids, contacts to that of their
/// smaller id, both sorted by id.
Specimen by_id_blocks(Ranks const& ranks, Specimen share);

/// Spatially together: discs to the rank in whose rectangle they lie, contacts to that of their disc with the smaller id.
Specimen by_place(Ranks const& ranks, Specimen share);

}  // namespace clathra
