#include "tune/setting_error.hpp"

#include <algorithm>
#include <cmath>

#include "domain/measurement/confidence.hpp"

namespace clathra {

double SettingError::farthest() const { return std::fabs(error) + half_width; }
double SettingError::nearest() const { return std::max(0.0, std::fabs(error) - half_width); }

std::optional<SettingError> setting_error(SeedValues const& values, RatePair const& pair) {
  std::vector<double> limits, errors, remainders;
  for (auto const& [seed, value] : values) {
    auto const fast = pair.fast.find(seed), slow = pair.slow.find(seed);
    if (fast == pair.fast.end() || slow == pair.slow.end()) continue;
    remainders.push_back((fast->second - slow->second) / (pair.ratio - 1));
    limits.push_back(slow->second - remainders.back());
    errors.push_back(value - limits.back());
  }
  if (errors.size() < 2) return {};
  double const limit = std::fabs(mean_interval(limits).mean);
  if (!(limit > 0)) return {};
  MeanInterval const mean = mean_interval(errors);
  SettingError result;
  result.seeds = mean.count;
  result.error = mean.mean / limit;
  result.scatter = *mean.deviation / limit;
  result.remainder = mean_interval(remainders).mean / limit;
  result.half_width = *mean.half_width / limit + std::fabs(result.remainder);
  return result;
}

ErrorVerdict verdict_on(SettingError const& error, double tolerance) {
  if (error.farthest() <= tolerance) return ErrorVerdict::within;
  return error.nearest() > tolerance ? ErrorVerdict::outside : ErrorVerdict::open;
}

std::optional<int> seeds_needed(SettingError const& error, double tolerance) {
  double const room = tolerance - std::fabs(error.error) - std::fabs(error.remainder);
  if (!(room > 0)) return {};
  constexpr int most = 100000;
  int least = 2, enough = most;
  while (least < enough) {  // the width falls with the number of seeds
    int const middle = least + (enough - least) / 2;
    if (students_half_width(error.scatter, middle) <= room)
      enough = middle;
    else
      least = middle + 1;
  }
  return least;
}

}  // namespace clathra
