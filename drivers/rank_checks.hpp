#pragma once
/// Whether several ranks can share a run, before they try.
#include "domain/ranks.hpp"
#include "io/scene_file.hpp"

namespace clathra {

/// @throws Refused on all ranks where some run another program or another scene than rank 0
void require_same_everywhere(Ranks const& ranks, LoadedScene const& input);

/// @throws Refused where the ranks are more than the discs can be cut into
void require_enough_discs(Ranks const& ranks, std::int64_t discs);

}  // namespace clathra
