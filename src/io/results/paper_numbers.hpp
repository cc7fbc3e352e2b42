#pragma once
/// The numbers behind the claims on Jiang et al. (2017), from the members of a study of its tests.
#include <filesystem>
#include <vector>

#include "io/results/paper_claims.hpp"
#include "io/results/study_results.hpp"

namespace clathra {

/// Numbers of the finished members: of their histories, of the envelopes of each seed, and of the snapshots of 55 % at 3 MPa.
/// Groups are named by paper_cell(). @param folders  of the members' runs  @throws FileProblem
PaperNumbers numbers_of_members(Study const& study, std::vector<MemberResult> const& members,
                                std::vector<std::filesystem::path> const& folders);

}  // namespace clathra
