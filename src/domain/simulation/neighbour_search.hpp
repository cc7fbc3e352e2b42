#pragma once
/// What an assembly does when its rows are outdated: discs get their owners, their order and their neighbours anew.
#include "domain/simulation/assembly.hpp"
#include "kernels/rebuild_inputs.hpp"

namespace clathra {

/// What a search has to know of the discs of all ranks. @throws Diverged where there are faults
RebuildInputs rebuild_inputs_of_all(Assembly const& a);
/// The same of what each rank has found of its own.
RebuildInputs rebuild_inputs_of_all(Assembly const& a, RebuildInputs of_this_rank);

/// Fields of the assembly that go with discs: accounts of losses, where the test began, what boundaries keep of discs.
AuxiliaryFields auxiliary_fields(Assembly& a, std::vector<BoundaryHistory>& histories);
/// What its boundaries keep of discs.
std::vector<BoundaryHistory> boundary_histories(Assembly& a);
/// Its forces, which a search at an instant that the test does not know of must not lose.
AuxiliaryFields force_fields(Assembly& a);

/// @param all  of the present discs, by rebuild_inputs_of_all(), which finds those that are nowhere and have no cell
/// @param skin_by_speed  whether flying discs get more than those at rest
/// @param also  what goes with the discs beside auxiliary_fields()
/// @throws Refused where mixed precision cannot tell places apart as far as is searched
void search_neighbours(Assembly& a, RebuildInputs const& all, bool skin_by_speed = true, AuxiliaryFields const& also = {});

}  // namespace clathra
