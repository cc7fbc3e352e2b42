#pragma once
/// What is known of a bond that broke.
#include <cstdint>
#include <vector>

#include "kernels/break_details.hpp"

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

/// Broken bonds and, where they were asked for, the details of each.
struct BreakEvents {
  bool detailed = false;  ///< the same on all ranks
  std::vector<BreakEvent> rows;
  std::vector<BreakDetails> details;  ///< as many as rows where detailed, else none

  /// Adds the k-th of others, which are detailed if these are.
  void add(BreakEvents const& others, std::size_t k) {
    rows.push_back(others.rows[k]);
    if (detailed) details.push_back(others.details[k]);
  }
  void add(BreakEvents const& others) {
    for (std::size_t k = 0; k < others.rows.size(); ++k) add(others, k);
  }
};
/// Those from the first-th on, in the order of events.
BreakEvents sorted(BreakEvents const& events, std::size_t first = 0);

}  // namespace clathra
