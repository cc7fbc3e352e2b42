/// Ranks without MPI: there is one.
#include "domain/parallel/ranks.hpp"
#include "domain/scene/stage.hpp"

namespace clathra {

RankSession::RankSession() {
  if (launched_ranks() > 1)
    throw Refused("started as one of " + std::to_string(launched_ranks()) + " ranks, but this program was built without MPI");
}
RankSession::~RankSession() = default;
std::string message_passing_name() { return "none"; }

}  // namespace clathra
