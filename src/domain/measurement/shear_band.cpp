#include "domain/measurement/shear_band.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clathra {
namespace {

/// Above 0 a band stands out: the strain inside less twice that beside it.
double excess(BandProfile const& band) { return band.inside - 2 * band.outside; }

bool same_direction(BandProfile const& a, BandProfile const& b) {
  constexpr double near = 10 * std::numbers::pi / 180;
  return std::abs(std::remainder(a.inclination - b.inclination, std::numbers::pi)) <= near;
}

}  // namespace

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

std::optional<double> band_onset(std::vector<BandAt> const& series) {
  auto const directed = [&](BandAt const& at) { return at.band && same_direction(*at.band, *series.back().band); };
  auto const stands_out = [&](BandAt const& at) { return directed(at) && at.band->inside > 0 && excess(*at.band) >= 0; };
  std::size_t first = series.size();
  if (series.empty() || !series.back().band) return {};
  while (first > 0 && stands_out(series[first - 1])) --first;
  if (first == series.size()) return {};
  if (first == 0 || !directed(series[first - 1])) return series[first].eps1;
  BandAt const &before = series[first - 1], &after = series[first];
  double const missing = -excess(*before.band), reached = excess(*after.band);
  return before.eps1 + (after.eps1 - before.eps1) * missing / (missing + reached);
}

}  // namespace clathra
