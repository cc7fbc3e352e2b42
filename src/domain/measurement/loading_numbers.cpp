#include "domain/measurement/loading_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clathra {

namespace {

constexpr double isotropic = 0.05;  // q over p, at most

double mean_stress(LoadingCurves const& c, std::size_t i) { return 0.5 * (c.sigma1[i] + c.sigma3[i]); }
double deviator(LoadingCurves const& c, std::size_t i) { return c.sigma1[i] - c.sigma3[i]; }

void add_one_dimensional(LoadingCurves const& c, StageRecord& numbers) {
  std::size_t const last = c.eps1.size() - 1, half = last / 2;
  if (double const strain = c.eps1[last] - c.eps1[0]; strain != 0)
    numbers["constrained_modulus_Pa"] = (c.sigma1[last] - c.sigma1[0]) / strain;
  numbers["k0"] = c.sigma3[last] / c.sigma1[last];
  if (double const vertical = c.sigma1[last] - c.sigma1[half]; vertical != 0)
    numbers["k0_of_increments"] = (c.sigma3[last] - c.sigma3[half]) / vertical;
}

/// Rows at which the axial strain turns round, the first row among them.
std::vector<std::size_t> turns_of(LoadingCurves const& c) {
  std::vector<std::size_t> turns{0};
  for (std::size_t i = 1; i + 1 < c.eps1.size(); ++i) {
    double const before = c.eps1[i] - c.eps1[turns.back()], after = c.eps1[i + 1] - c.eps1[i];
    if (before * after < 0) turns.push_back(i);
  }
  return turns;
}

/// Of the last loop, from one turn to the next but one.
void add_loops(LoadingCurves const& c, StageRecord& numbers) {
  std::vector<std::size_t> turns = turns_of(c);
  turns.push_back(c.eps1.size() - 1);
  if (turns.size() < 4) return;
  std::size_t const to = turns[turns.size() - 1], from = turns[turns.size() - 3];
  double area = 0;
  for (std::size_t i = from; i < to; ++i) area += 0.5 * (deviator(c, i) + deviator(c, i + 1)) * (c.eps1[i + 1] - c.eps1[i]);
  double least = HUGE_VAL, most = -HUGE_VAL, lowest = HUGE_VAL, highest = -HUGE_VAL;
  for (std::size_t i = from; i <= to; ++i) {
    least = std::min(least, c.eps1[i]), most = std::max(most, c.eps1[i]);
    lowest = std::min(lowest, deviator(c, i)), highest = std::max(highest, deviator(c, i));
  }
  double const stored = 0.5 * (0.5 * (highest - lowest)) * (0.5 * (most - least));
  if (stored > 0) numbers["damping_ratio"] = std::abs(area) / (4 * std::numbers::pi * stored);
  std::size_t const cycles = turns.size() / 2;  // of one upper turn each
  if (cycles < 2) return;
  numbers["strain_per_cycle"] = (c.eps1[turns[2 * cycles - 1]] - c.eps1[turns[1]]) / static_cast<double>(cycles - 1);
}

void add_undrained(LoadingCurves const& c, StageRecord& numbers) {
  double largest = 0;
  for (double const lateral : c.sigma3) largest = std::max(largest, c.sigma3[0] - lateral);
  numbers["largest_pore_pressure_Pa"] = largest;
  numbers["largest_pore_pressure_ratio"] = largest / c.sigma3[0];
  constexpr double again = 1.01;
  std::size_t least = 0;
  for (std::size_t i = 1; i < c.eps1.size(); ++i) {
    if (mean_stress(c, i) < mean_stress(c, least)) least = i;
    if (least == 0 || mean_stress(c, i) <= again * mean_stress(c, least)) continue;
    numbers["phase_transformation_p_Pa"] = mean_stress(c, least);
    numbers["phase_transformation_eps1"] = c.eps1[least];
    return;
  }
}

}  // namespace

StageRecord loading_numbers(LoadingStage const& stage, LoadingCurves const& c) {
  StageRecord numbers;
  if (c.eps1.size() < 2) return numbers;
  std::size_t const last = c.eps1.size() - 1;
  numbers["start_void_ratio"] = c.void_ratio[0];
  numbers["end_void_ratio"] = c.void_ratio[last];
  if (stage.vertical.has_stress() && stage.lateral.hold) add_one_dimensional(c, numbers);
  constexpr double least_change = 0.02;  // of p: less is the trembling of walls that hold a stress
  if (double const strain = c.eps_v[last] - c.eps_v[0]; stage.vertical.has_stress() &&
                                                        stage.vertical.stress == stage.lateral.stress && strain != 0 &&
                                                        std::abs(mean_stress(c, last) / mean_stress(c, 0) - 1) > least_change &&
                                                        std::abs(deviator(c, 0)) < isotropic * mean_stress(c, 0))
    numbers["bulk_modulus_Pa"] = (mean_stress(c, last) - mean_stress(c, 0)) / strain;
  if (double const strain = c.eps1[last] - c.eps1[0];
      stage.vertical.has_rate() && stage.vertical.sense() < 0 && !stage.turn.any() && strain != 0)
    numbers["secant_stiffness_Pa"] = std::abs((deviator(c, last) - deviator(c, 0)) / strain);
  if (stage.turn.any()) add_loops(c, numbers);
  if (stage.lateral.follow == Follow::constant_volume) add_undrained(c, numbers);
  return numbers;
}

}  // namespace clathra
