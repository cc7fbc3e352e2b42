#pragma once
/// Whether several ranks can share a run, before they try.
#include <functional>
#include <string>
#include <vector>

#include "domain/parallel/ranks.hpp"
#include "io/errors/problems.hpp"
#include "io/scene/scene_file.hpp"

namespace clathra {

/// Makes what one rank has to refuse (its machine lacks memory, say) a refusal of all.
void share_refusals(Ranks const& ranks, std::vector<std::string>& refusals);

/// Does the work of a verb. A fault of one rank that the others cannot know of ends all of them.
ExitCode guarded_on_all_ranks(Ranks const& ranks, std::function<ExitCode()> const& work);

/// @throws Refused on all ranks where some run another program or another scene than rank 0
void require_same_everywhere(Ranks const& ranks, LoadedScene const& input);

/// @throws Refused where the ranks are more than the discs can be cut into
void require_enough_discs(int ranks, std::int64_t discs);

}  // namespace clathra
