#pragma once
/// Problems that all ranks learn of together, so that none waits for one that has gone.
#include <functional>

#include "domain/parallel/ranks.hpp"
#include "io/errors/problems.hpp"

namespace clathra {

/// Does something on rank 0 alone. A FileProblem there is thrown on all ranks.
void on_root(Ranks const& ranks, std::function<void()> const& action);

/// Does something on every rank, without collective calls. A FileProblem on any of them is thrown on all.
void on_each(Ranks const& ranks, std::function<void()> const& action);

/// Says what went wrong on this rank and ends all of them.
[[noreturn]] void end_all_ranks(Ranks const& ranks, FileProblem const& problem);

}  // namespace clathra
