#pragma once
/// What a simulation needs to go on to the bit: this rank's part of it, by value, for checkpoints.
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "domain/parallel/disc_record.hpp"

namespace clathra {

/// A broken bond.
struct BreakEvent {
  std::int64_t step;
  int id_a, id_b, mode;  ///< id_a < id_b; mode as in BreakMode
  double x, y;           ///< midpoint of the branch [m]
};
/// The order of events: by step, then by the ids.
inline bool comes_before(BreakEvent const& p, BreakEvent const& q) {
  return p.step != q.step ? p.step < q.step : p.id_a != q.id_a ? p.id_a < q.id_a : p.id_b < q.id_b;
}

/// The rows are kept as they are listed, neighbours out of touch and all: forces are summed in their order, which is that of the
/// last neighbour search.
struct SimulationState {
  std::map<std::string, double> numbers;     ///< clock, walls, loading, sums; the same on all ranks
  std::vector<std::string> disc_columns;     ///< names of the numbers of a record between its id and the length of its row
  std::vector<std::string> history_columns;  ///< names of the numbers behind each neighbour's id
  DiscRecords discs;
  std::vector<BreakEvent> broken;  ///< since the bonds were installed
};

}  // namespace clathra
