#pragma once
/// When the neighbour list of a simulation is searched for anew, and how far that search looks.
#include <algorithm>
#include <cstdint>

#include "kernels/verlet_skin.hpp"

namespace clathra {

/// Verlet skin of a test that asks for none, in d50; discs get 1.2 times that on the average (verlet_skin.hpp). Where bonds break
/// all the time it was the fastest of 0.08, 0.10, 0.12 and 0.16; elsewhere it costs 2 % at most against 0.08
/// (perf/reports/0.1/performance.md).
inline constexpr double chosen_skin = 0.12;

/// The same in metres, but not so far that small discs behind those that touch are listed, which lie 1.46 radii and more beyond.
/// @param smallest  diameter [m]
inline double usual_skin(double d50, double smallest) { return std::min(chosen_skin * d50, 0.5 * smallest); }

/// Whether the discs have moved too far for their list is seen by the device (StepState::at_search).
class NeighbourListUpkeep {
 public:
  /// @param skin  of discs at rest [m], surface to surface; those that fly have more (verlet_skin.hpp)
  explicit NeighbourListUpkeep(Real skin) : skin_(skin) {}

  Real skin() const { return skin_; }
  /// For the searches to come.
  void set_skin(Real skin) { skin_ = skin; }
  /// Lists are outdated whatever the discs do: the next step begins with a search.
  void ask() { asked_ = true; }
  bool is_asked() const { return asked_; }

  /// A periodic cell stays twice as wide as neighbours reach; a row holds all small discs around a large one.
  /// @param by_speed  whether flying discs get more than those at rest
  SkinRange skins(Box const& box, Real smallest_radius, Real largest_radius, bool by_speed) const;
  /// How far the centres of a pair may be apart, in skins.
  Real reach_in_skins(Real largest_radius) const { return 2 * largest_radius / skin_ + 1; }
  /// The farthest neighbours that the last search listed, centre to centre [m].
  Real reach() const { return reach_; }

  /// Whether discs are sorted in space in this search: their order holds for a while where no rank sends or gets discs.
  bool sorting_is_due(bool alone);
  /// @param step  that it belongs to;  @param seconds  that it took
  void after_search(std::int64_t step, Real reach, double seconds);

  std::int64_t searches() const { return searches_; }
  std::int64_t last_search() const { return last_search_; }  ///< its step
  double seconds() const { return seconds_; }                ///< wall time of all searches
  double seconds_of_a_search() const;

  /// Visits the numbers that a checkpoint keeps: (name, number).
  template <class Visit>
  void for_each_number(Visit&& visit) {
    visit("rebuilds", searches_);
    visit("rebuild_pending", asked_);
    visit("skin", skin_);
    visit("reach", reach_);
  }

 private:
  Real skin_, reach_ = 0;
  bool asked_ = true;
  std::int64_t searches_ = 0, last_search_ = 0;
  int searches_until_sorting_ = 0;  // the first one sorts
  double seconds_ = 0;
};

}  // namespace clathra
