#pragma once
/// Specimens in the order of a file: discs by id, each rank one block of ids.
#include "domain/ranks.hpp"
#include "domain/specimen.hpp"

namespace clathra {

/// Brings discs to the rank that keeps their id, and contacts to that of their smaller id, both sorted by id.
Specimen by_id_blocks(Ranks const& ranks, Specimen const& share, std::int64_t discs);

}  // namespace clathra
