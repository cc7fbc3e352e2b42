#include "domain/measurement/shear_band.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clathra {

bool Band::holds(double x, double y) const {
  double const across = std::cos(angle) * x + std::sin(angle) * y;
  return from <= across && across <= to;
}

Band best_band(std::vector<double> const& x, std::vector<double> const& y, double width) {
  Band best;
  std::vector<double> across(x.size());
  for (int degree = 0; degree < 180; ++degree) {
    double const angle = degree * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
    for (std::size_t i = 0; i < x.size(); ++i) across[i] = c * x[i] + s * y[i];
    std::sort(across.begin(), across.end());
    for (std::size_t first = 0, last = 0; last < across.size(); ++last) {
      while (across[last] - across[first] > width) ++first;
      if (last - first + 1 > best.points) best = {angle, across[first], across[last], last - first + 1};
    }
  }
  return best;
}

BandShares band_shares(std::vector<double> const& x, std::vector<double> const& y, double width) {
  if (x.empty()) return {};
  Band const first = best_band(x, y, width);
  std::vector<double> rest_x, rest_y;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (first.holds(x[i], y[i])) continue;
    rest_x.push_back(x[i]);
    rest_y.push_back(y[i]);
  }
  Band const second = best_band(rest_x, rest_y, width);
  double const all = static_cast<double>(x.size());
  return {static_cast<double>(first.points) / all, static_cast<double>(first.points + second.points) / all};
}

}  // namespace clathra
