#include "domain/simulation/broken_bonds.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clathra {

namespace {

template <class T>
auto download(Field<T> const& field) {
  return Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), field);
}

std::string name_of_count(int mode) { return "broken_" + std::to_string(mode); }

}  // namespace

void BrokenBonds::make_room(std::size_t bonds) {
  std::size_t const room = keeps_events ? bonds : 0;
  if (!has_log() || log_.step.extent(0) < room) log_ = make_break_log(room);
}

void BrokenBonds::collect() {
  if (!has_log()) return;
  auto const by_mode = download(log_.by_mode);
  for (std::size_t mode = 0; mode < break_mode_count; ++mode) counts_.number[mode] += by_mode(mode);
  Kokkos::deep_copy(log_.by_mode, 0);
  int const count = download(log_.count)(0);
  if (count == 0) return;
  auto const step = download(log_.step);
  auto const id_a = download(log_.id_a), id_b = download(log_.id_b);
  auto const mode = download(log_.mode);
  auto const x = download(log_.x), y = download(log_.y);
  for (int k = 0; k < count; ++k) events_.push_back({step(k), id_a(k), id_b(k), mode(k), x(k), y(k)});
  Kokkos::deep_copy(log_.count, 0);
}

std::vector<BreakEvent> BrokenBonds::sorted_events(int first) const {
  std::vector<BreakEvent> sorted;
  if (static_cast<std::size_t>(first) < events_.size()) sorted.assign(events_.begin() + first, events_.end());
  std::sort(sorted.begin(), sorted.end(), comes_before);
  return sorted;
}

void BrokenBonds::write(SimulationState& state, Ranks const& ranks) const {
  state.broken = events_;
  for (int mode = 0; mode < break_mode_count; ++mode)
    state.numbers[name_of_count(mode)] = static_cast<double>(ranks.sum(counts_.number[mode]));
}

void BrokenBonds::read(SimulationState& state, Ranks const& ranks) {
  events_ = std::move(state.broken);
  for (int mode = 0; mode < break_mode_count; ++mode) {
    auto const counted = state.numbers.find(name_of_count(mode));
    if (counted != state.numbers.end())
      counts_.number[mode] = ranks.root() ? std::llround(counted->second) : 0;
    else  // the first checkpoints have no counts, and all events
      counts_.number[mode] = std::count_if(events_.begin(), events_.end(), [&](BreakEvent const& e) { return e.mode == mode; });
  }
}

std::vector<BreakEvent> gathered(Ranks const& ranks, std::vector<BreakEvent> events) {
  if (ranks.alone()) return events;
  std::vector<double> numbers;
  for (BreakEvent const& e : events)
    numbers.insert(numbers.end(), {static_cast<double>(e.step), double(e.id_a), double(e.id_b), double(e.mode), e.x, e.y});
  numbers = ranks.gather(numbers);
  events.clear();
  for (std::size_t k = 0; k < numbers.size(); k += 6) {
    double const* const n = &numbers[k];
    events.push_back(
        {static_cast<std::int64_t>(n[0]), static_cast<int>(n[1]), static_cast<int>(n[2]), static_cast<int>(n[3]), n[4], n[5]});
  }
  std::sort(events.begin(), events.end(), comes_before);
  return events;
}

}  // namespace clathra
