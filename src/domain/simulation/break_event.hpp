#pragma once
/// What is known of a bond that broke.
#include <cstdint>

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

}  // namespace clathra
