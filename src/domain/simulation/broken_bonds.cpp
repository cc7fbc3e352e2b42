#include "domain/simulation/broken_bonds.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace clathra {

namespace {

std::string name_of_count(int mode) { return "broken_" + std::to_string(mode); }

}  // namespace

BreakEvents sorted(BreakEvents const& events, std::size_t first) {
  BreakEvents all;
  all.detailed = events.detailed;
  if (first >= events.rows.size()) return all;
  std::vector<std::size_t> order(events.rows.size() - first);
  std::iota(order.begin(), order.end(), first);
  std::sort(order.begin(), order.end(),
            [&](std::size_t p, std::size_t q) { return comes_before(events.rows[p], events.rows[q]); });
  for (std::size_t const k : order) all.add(events, k);
  return all;
}

BreakLog const& BrokenBonds::log_of(Field<StepState> const& steps) {
  log_.steps = steps;
  return log_;
}

void BrokenBonds::make_room(std::size_t bonds) {
  std::size_t const room = keeps_events ? bonds : 0;
  if (!has_log() || log_.step.extent(0) < room) log_ = make_break_log(room, detailed());
}

void BrokenBonds::collect() {
  if (detailed() && !events_.detailed) {
    events_.detailed = true;
    events_.details.resize(events_.rows.size());  // of those before there are none
  }
  if (!has_log()) return;
  auto const by_mode = host_copy(log_.by_mode);
  for (std::size_t mode = 0; mode < break_mode_count; ++mode) counts_.number[mode] += by_mode(mode);
  Kokkos::deep_copy(log_.by_mode, 0);
  int const count = host_copy(log_.count)(0);
  if (count == 0) return;
  auto const step = host_copy(log_.step);
  auto const id_a = host_copy(log_.id_a), id_b = host_copy(log_.id_b);
  auto const mode = host_copy(log_.mode);
  auto const x = host_copy(log_.x), y = host_copy(log_.y);
  auto const details = host_copy(log_.details);
  auto const height = host_copy(log_.height);
  for (int k = 0; k < count; ++k) events_.rows.push_back({step(k), id_a(k), id_b(k), mode(k), x(k), y(k)});
  for (int k = 0; detailed() && k < count; ++k) {
    events_.details.push_back(details(k));
    events_.details.back().eps1 = std::log(details_from_height / height(k));
  }
  Kokkos::deep_copy(log_.count, 0);
}

void BrokenBonds::write(SimulationState& state, Ranks const& ranks) const {
  state.broken = events_;
  for (int mode = 0; mode < break_mode_count; ++mode)
    state.numbers[name_of_count(mode)] = static_cast<double>(ranks.sum(counts_.number[mode]));
}

void BrokenBonds::read(SimulationState& state, Ranks const& ranks) {
  events_ = std::move(state.broken);
  for (int mode = 0; mode < break_mode_count; ++mode) {
    auto const counted = static_cast<std::int64_t>(state.numbers.at(name_of_count(mode)));
    counts_.number[mode] = ranks.root() ? counted : 0;
  }
}

BreakEvents gathered(Ranks const& ranks, BreakEvents events) {
  if (ranks.alone()) return events;
  std::vector<double> numbers;
  for (std::size_t k = 0; k < events.rows.size(); ++k) {
    BreakEvent const& e = events.rows[k];
    numbers.insert(numbers.end(), {static_cast<double>(e.step), double(e.id_a), double(e.id_b), double(e.mode), e.x, e.y});
    if (!events.detailed) continue;
    for (BreakDetailColumn const& column : break_detail_columns) numbers.push_back(events.details[k].*column.value);
  }
  numbers = ranks.gather(numbers);
  BreakEvents all;
  all.detailed = events.detailed;
  for (auto n = numbers.begin(); n != numbers.end();) {
    all.rows.push_back(
        {static_cast<std::int64_t>(n[0]), static_cast<int>(n[1]), static_cast<int>(n[2]), static_cast<int>(n[3]), n[4], n[5]});
    n += 6;
    if (!all.detailed) continue;
    BreakDetails& details = all.details.emplace_back();
    for (BreakDetailColumn const& column : break_detail_columns) details.*column.value = *n++;
  }
  return sorted(all);
}

}  // namespace clathra
