#include "domain/measurement/surroundings.hpp"

#include <cmath>

namespace clathra {
namespace {

/// The items of a list whose places are kept, in their order.
template <class T>
std::vector<T> kept(std::vector<T> const& list, std::vector<std::size_t> const& places) {
  std::vector<T> result;
  for (std::size_t const place : places) result.push_back(list[place]);
  return result;
}

}  // namespace

Snapshot surroundings(Snapshot const& snapshot, double x, double y, double distance, Ranks const& ranks) {
  std::vector<std::size_t> discs, pairs;
  std::vector<std::int64_t> number(snapshot.id.size(), -1);
  for (std::size_t i = 0; i < snapshot.id.size(); ++i) {
    if (!(std::hypot(snapshot.x[i] - x, snapshot.y[i] - y) <= distance)) continue;
    number[i] = static_cast<std::int64_t>(discs.size());
    discs.push_back(i);
  }
  std::int64_t const first = ranks.sum_before(static_cast<std::int64_t>(discs.size()));
  auto const number_of = [&](std::int32_t disc) {
    std::int64_t const place = disc - snapshot.first_disc;
    return place >= 0 && place < static_cast<std::int64_t>(number.size()) ? number[static_cast<std::size_t>(place)] : -1;
  };
  Snapshot part = snapshot;
  part.first_disc = first;
  part.id = kept(snapshot.id, discs);
  for_each_disc_column([&](auto const& column) {
    for (auto const list : column.parts) part.*list = kept(snapshot.*list, discs);
  });
  part.a.clear();
  part.b.clear();
  for (std::size_t k = 0; k < snapshot.a.size(); ++k) {
    std::int64_t const a = number_of(snapshot.a[k]), b = number_of(snapshot.b[k]);
    if (a < 0 || b < 0) continue;
    pairs.push_back(k);
    part.a.push_back(static_cast<std::int32_t>(first + a));
    part.b.push_back(static_cast<std::int32_t>(first + b));
  }
  part.state = kept(snapshot.state, pairs);
  for_each_pair_column([&](auto const& column) {
    for (auto const list : column.parts) part.*list = kept(snapshot.*list, pairs);
  });
  part.events = {};
  return part;
}

}  // namespace clathra
