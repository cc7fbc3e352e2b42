#include "domain/measurement/curve_features.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "domain/measurement/test_phases.hpp"

namespace clathra {

double value_at(std::vector<double> const& x, std::vector<double> const& y, double place) {
  auto const after = std::lower_bound(x.begin(), x.end(), place);
  if (after == x.begin()) return y.front();
  if (after == x.end()) return y.back();
  auto const i = static_cast<std::size_t>(after - x.begin());
  double const part = (place - x[i - 1]) / (x[i] - x[i - 1]);
  return y[i - 1] + part * (y[i] - y[i - 1]);
}

double middle_of_top(std::vector<double> const& x, std::vector<double> const& y, double share) {
  double const level = share * y[peak_row(y)];
  double first = std::numeric_limits<double>::infinity(), last = -first;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (y[i] >= level) first = std::min(first, x[i]), last = x[i];
  return (first + last) / 2;
}

std::optional<double> slope_over(std::vector<double> const& x, std::vector<double> const& y, double from, double to) {
  double count = 0, sum_x = 0, sum_y = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (from <= x[i] && x[i] <= to) count += 1, sum_x += x[i], sum_y += y[i];
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!(from <= x[i] && x[i] <= to)) continue;
    double const off = x[i] - sum_x / count;
    xx += off * off, xy += off * (y[i] - sum_y / count);
  }
  return xx > 0 ? std::optional(xy / xx) : std::nullopt;
}

std::optional<Parabola> fitted_parabola(std::vector<double> const& x, std::vector<double> const& y) {
  auto const n = static_cast<double>(x.size());
  double mean = 0, mean_y = 0;
  for (std::size_t i = 0; i < x.size(); ++i) mean += x[i] / n, mean_y += y[i] / n;
  // Orthogonal polynomials 1, u and u^2 - a u - b over the places u = x - mean.
  double s2 = 0, s3 = 0;
  for (double const place : x) s2 += std::pow(place - mean, 2), s3 += std::pow(place - mean, 3);
  if (!(s2 > 0)) return {};
  double const a = s3 / s2, b = s2 / n;
  double along = 0, across = 0, norm = 0, scale = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    double const u = x[i] - mean, v = u * u - a * u - b;
    along += u * (y[i] - mean_y), across += v * (y[i] - mean_y), norm += v * v, scale += u * u * u * u;
  }
  if (!(norm > 1e-12 * scale)) return {};
  double const bend = across / norm;
  return Parabola{mean_y - bend * b, along / s2 - bend * a, bend};
}

std::optional<double> fastest_growth(std::vector<double> const& x, std::vector<double> const& y, double width) {
  std::optional<double> place;
  double most = 0;
  for (std::size_t from = 0, to = 0; to < x.size(); ++to) {
    while (from < to && x[to] - x[from + 1] >= width) ++from;  // the shortest stretch that is wide enough
    if (!(x[to] - x[from] >= width)) continue;
    double const rate = (y[to] - y[from]) / (x[to] - x[from]);
    if (rate > most) most = rate, place = (x[from] + x[to]) / 2;
  }
  return place;
}

std::optional<double> end_of_fall(std::vector<double> const& x, std::vector<double> const& y, double level, double share) {
  std::size_t const top = peak_row(y);
  for (std::size_t i = top; i < x.size(); ++i)
    if (y[i] <= y[top] - share * (y[top] - level)) return x[i];
  return {};
}

}  // namespace clathra
