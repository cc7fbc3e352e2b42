#include "domain/simulation/neighbour_list_upkeep.hpp"

#include <algorithm>

#include "domain/scene/specimen_design.hpp"

namespace clathra {

namespace {

constexpr int searches_a_sorting = 16;  // of discs that no rank sends or gets

}  // namespace

SkinRange NeighbourListUpkeep::skins(Box const& box, Real smallest_radius, Real largest_radius, bool by_speed) const {
  constexpr Real times = 5;
  Real const least = skin_ / 2;
  if (!by_speed) return {least, least};
  Real most = std::min(times * least, 0.5 * smallest_radius * reach_of_a_full_row(largest_radius / smallest_radius));
  if (box.periodic) most = std::min(most, 0.49 * (0.5 * box.narrowest() - 2 * largest_radius));
  return {least, std::max(most, least)};
}

bool NeighbourListUpkeep::sorting_is_due(bool alone) {
  bool const due = !alone || searches_until_sorting_ == 0;
  searches_until_sorting_ = due ? searches_a_sorting - 1 : searches_until_sorting_ - 1;
  return due;
}

void NeighbourListUpkeep::after_search(std::int64_t step, Real reach, double seconds) {
  asked_ = false;
  reach_ = reach;
  ++searches_;
  last_search_ = step;
  seconds_ += seconds;
}

double NeighbourListUpkeep::seconds_of_a_search() const {
  return seconds_ / static_cast<double>(std::max<std::int64_t>(searches_, 1));
}

}  // namespace clathra
