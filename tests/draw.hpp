#pragma once
#include <array>
#include <cmath>
#include <random>

#include "kernels/lane.hpp"

namespace clathra {

/// Numbers for one test: drawn at random, the same in every run.
class Draw {
 public:
  explicit Draw(unsigned seed) : engine_(seed) {}
  double between(double low, double high) { return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53); }
  /// Uniform in the logarithm.
  double of_size(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
  double either_sign(double value) { return (engine_() & 1) != 0 ? value : -value; }

 private:
  std::mt19937_64 engine_;
};

/// As many states as there are lanes, and one number of each of them as a lane value.
template <class State>
using LaneStates = std::array<State, static_cast<std::size_t>(lane_count)>;

template <class State, class Number>
Lanes side_by_side(LaneStates<State> const& states, Number number) {
  Lanes lanes(0);
  for (int l = 0; l < lane_count; ++l) set_lane(lanes, l, number(states[static_cast<std::size_t>(l)]));
  return lanes;
}

}  // namespace clathra
