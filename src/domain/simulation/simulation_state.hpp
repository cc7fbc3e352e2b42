#pragma once
/// What a simulation needs to go on to the bit: this rank's part of it, for checkpoints.
///
/// Numbers and columns by name, so that a checkpoint says what it holds. Forces and the places of the last neighbour search are
/// part of it, although they follow from the rest: they follow from how it came about, and a search at another instant would sum
/// in another order.
#include <map>
#include <string>

#include "domain/parallel/disc_record.hpp"
#include "domain/simulation/break_event.hpp"

namespace clathra {

/// The rows are kept as they are listed, neighbours out of touch and all: forces are summed in their order, which is that of the
/// last neighbour search.
struct SimulationState {
  std::map<std::string, double> numbers;  ///< clock, walls, loading, sums; the same on all ranks
  DiscColumns discs;
  BreakEvents broken;  ///< since the bonds were installed
};

}  // namespace clathra
