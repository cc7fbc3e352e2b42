#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "domain/measurement/shear_band.hpp"

namespace clathra {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr std::size_t fewest_strains = 50;
constexpr double fewest_in_slice = 5;

/// Discs or cells with a strain, from their middle.
struct Strained {
  std::vector<double> x, y, strain;
  double mean = 0, variance = 0;
};

Strained strained(std::vector<double> const& x, std::vector<double> const& y, std::vector<float> const& strain) {
  Strained s;
  double middle_x = 0, middle_y = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(strain[i])) continue;
    s.x.push_back(x[i]), s.y.push_back(y[i]), s.strain.push_back(double(strain[i]));
    middle_x += x[i], middle_y += y[i], s.mean += double(strain[i]);
  }
  auto const n = std::max(1.0, static_cast<double>(s.x.size()));
  s.mean /= n;
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    s.x[i] -= middle_x / n, s.y[i] -= middle_y / n;
    s.variance += (s.strain[i] - s.mean) * (s.strain[i] - s.mean) / n;
  }
  return s;
}

/// Mean strains of slices across a direction.
struct Profile {
  std::vector<double> place, strain, weight;  ///< [m], mean, discs
  double explained = 0;
};

Profile profile_across(Strained const& s, double normal, double slice) {
  double const c = std::cos(normal), n = std::sin(normal);
  double reach = 0;
  for (std::size_t i = 0; i < s.x.size(); ++i) reach = std::max(reach, std::abs(c * s.x[i] + n * s.y[i]));
  auto const half = static_cast<std::ptrdiff_t>(reach / slice) + 1;
  std::vector<double> sums(static_cast<std::size_t>(2 * half + 1)), counts(sums.size());
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    auto const k = static_cast<std::size_t>(std::lround((c * s.x[i] + n * s.y[i]) / slice) + half);
    sums[k] += s.strain[i], counts[k] += 1;
  }
  Profile p;
  double between = 0;
  for (std::size_t k = 0; k < sums.size(); ++k) {
    if (counts[k] < fewest_in_slice) continue;
    double const mean = sums[k] / counts[k];
    p.place.push_back((static_cast<double>(k) - static_cast<double>(half)) * slice);
    p.strain.push_back(mean);
    p.weight.push_back(counts[k]);
    between += counts[k] * (mean - s.mean) * (mean - s.mean);
  }
  p.explained = s.variance > 0 ? between / (static_cast<double>(s.x.size()) * s.variance) : 0;
  return p;
}

/// base + height * shape, the shape given at each place, by weighted least squares.
struct Fit {
  double base = 0, height = 0, misfit = 0;
};
Fit fit_height(Profile const& p, std::function<double(double)> const& shape) {
  double w = 0, f = 0, y = 0, ff = 0, fy = 0, yy = 0;
  for (std::size_t i = 0; i < p.place.size(); ++i) {
    double const value = shape(p.place[i]), weight = p.weight[i];
    w += weight, f += weight * value, y += weight * p.strain[i];
    ff += weight * value * value, fy += weight * value * p.strain[i], yy += weight * p.strain[i] * p.strain[i];
  }
  double const spread = ff - f * f / w, covariance = fy - f * y / w, total = yy - y * y / w;
  if (!(spread > 1e-12 * w)) return {y / w, 0, total};
  double const height = covariance / spread;
  return {(y - height * f) / w, height, total - height * covariance};
}

/// The middle and the width of the best shape(place - middle, width): a search over a grid that is refined.
struct Best {
  double middle = 0, width = 0;
  Fit fit;
};
Best best_shape(Profile const& p, double narrowest, double widest, std::function<double(double, double)> const& shape) {
  constexpr int steps = 24, rounds = 5;
  Best best;
  best.fit.misfit = HUGE_VAL;
  double from = p.place.front(), to = p.place.back(), low = narrowest, high = widest;
  for (int round = 0; round < rounds; ++round) {
    for (int i = 0; i <= steps; ++i)
      for (int k = 0; k <= steps; ++k) {
        double const middle = from + (to - from) * i / steps, width = low + (high - low) * k / steps;
        Fit const fit = fit_height(p, [&](double place) { return shape(place - middle, width); });
        if (fit.height > 0 && fit.misfit < best.fit.misfit) best = {middle, width, fit};
      }
    double const reach = 2 * (to - from) / steps, range = 2 * (high - low) / steps;
    from = best.middle - reach, to = best.middle + reach;
    low = std::max(narrowest, best.width - range), high = std::min(widest, best.width + range);
  }
  return best;
}

/// The direction of the normal [rad] whose profile explains most, to a tenth of a degree.
double best_normal(Strained const& s, double slice) {
  double best = 0, most = -1;
  auto const look = [&](double normal) {
    double const explained = profile_across(s, normal, slice).explained;
    if (explained > most) most = explained, best = normal;
  };
  for (int k = 0; k < 180; ++k) look(k * degree);
  double const coarse = best;
  for (int k = -10; k <= 10; ++k) look(coarse + 0.1 * k * degree);
  return best;
}

}  // namespace

std::optional<BandProfile> fit_band(std::vector<double> const& x, std::vector<double> const& y, std::vector<float> const& strain,
                                    double d50, double smoothing) {
  Strained const s = strained(x, y, strain);
  if (s.x.size() < fewest_strains || !(s.variance > 0)) return {};
  double const slice = d50 / 2, normal = best_normal(s, slice);
  Profile const p = profile_across(s, normal, slice);
  if (p.place.size() < 5) return {};
  double const length = p.place.back() - p.place.front();
  Best const box = best_shape(p, d50, 0.7 * length, [&](double off, double width) {
    return (std::erf((off + width / 2) / (smoothing * std::numbers::sqrt2)) -
            std::erf((off - width / 2) / (smoothing * std::numbers::sqrt2))) /
           2;
  });
  Best const gaussian =
      best_shape(p, d50 / 2, 0.5 * length, [](double off, double width) { return std::exp(-off * off / (2 * width * width)); });
  if (!(box.fit.height > 0) || !(gaussian.fit.height > 0)) return {};
  double const inclination = std::fmod(normal + 1.5 * std::numbers::pi, std::numbers::pi);
  return BandProfile{inclination,  box.middle, box.width, gaussian.width, box.fit.base + box.fit.height,
                     box.fit.base, p.explained};
}

}  // namespace clathra
