#include "domain/measurement/test_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "domain/measurement/curve_features.hpp"

namespace clathra {
namespace {

/// Over the rows with at least this axial strain.
double mean_from(std::vector<double> const& eps1, std::vector<double> const& values, double from) {
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (eps1[i] >= from) sum += values[i], ++count;
  return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

/// E50, between the two rows where q passes half of its peak.
std::optional<double> secant_modulus(std::vector<double> const& eps1, std::vector<double> const& q, double peak_q) {
  double const half = peak_q / 2;
  for (std::size_t i = 1; i < q.size(); ++i) {
    if (!(q[i] >= half && q[i - 1] < half)) continue;
    double const strain = eps1[i - 1] + (half - q[i - 1]) / (q[i] - q[i - 1]) * (eps1[i] - eps1[i - 1]);
    if (strain > 0) return half / strain;
  }
  return std::nullopt;
}

/// The largest of all steps up to each row since the row before; of a history that has rows alone, theirs.
std::vector<double> largest_by_row(TestCurves const& curves) {
  std::vector<double> largest = curves.q;
  for (std::size_t i = 0; i < largest.size(); ++i) largest[i] = std::fmax(largest[i], curves.largest_q[i]);
  return largest;
}

/// That of the stretches that were followed step by step; of a history without them, by its rows.
std::optional<double> dilation_angle_of(TestCurves const& curves) {
  double largest = -std::numeric_limits<double>::infinity();
  for (double const psi : curves.dilation_deg) largest = std::fmax(largest, psi);
  return std::isfinite(largest) ? largest * std::numbers::pi / 180 : dilation_angle(curves.eps1, curves.eps_v);
}

}  // namespace

std::optional<double> dilation_angle_of(double eps1, double eps_v) {
  double const shear = 2 * eps1 - eps_v;
  return shear > 0 ? std::optional(std::asin(std::clamp(-eps_v / shear, -1.0, 1.0))) : std::nullopt;
}

std::optional<double> dilation_angle(std::vector<double> const& eps1, std::vector<double> const& eps_v) {
  double largest = -std::numeric_limits<double>::infinity();
  for (std::size_t from = 0, to = 0; to < eps1.size(); ++to) {
    while (from < to && eps1[to] - eps1[from + 1] >= dilation_window) ++from;  // the shortest stretch that is long enough
    if (!(eps1[to] - eps1[from] >= dilation_window)) continue;
    if (auto const psi = dilation_angle_of(eps1[to] - eps1[from], eps_v[to] - eps_v[from])) largest = std::fmax(largest, *psi);
  }
  return std::isfinite(largest) ? std::optional(largest) : std::nullopt;
}

TestNumbers test_numbers(TestCurves const& curves) {
  TestNumbers n;
  std::size_t const last = curves.q.size() - 1;
  std::vector<double> const largest_q = largest_by_row(curves);
  n.peak = peak_row(largest_q);
  n.peak_q = largest_q[n.peak];
  n.peak_eps1 = n.peak_q > curves.q[n.peak] ? curves.largest_q_eps1[n.peak] : curves.eps1[n.peak];
  auto const at_peak = [&](std::vector<double> const& values) { return value_at(curves.eps1, values, n.peak_eps1); };
  n.peak_sigma3 = at_peak(curves.sigma3);
  n.end_eps1 = curves.eps1[last];
  n.residual_from = residual_from(n.end_eps1);
  n.residual_q = mean_from(curves.eps1, curves.q, n.residual_from);
  n.residual_sigma3 = mean_from(curves.eps1, curves.sigma3, n.residual_from);
  n.secant_modulus = secant_modulus(curves.eps1, curves.q, n.peak_q);
  n.eps_v_peak = at_peak(curves.eps_v);
  n.eps_v_end = curves.eps_v[last];
  std::size_t const densest = peak_row(curves.eps_v);
  n.largest_eps_v = curves.eps_v[densest];
  n.largest_eps_v_eps1 = curves.eps1[densest];
  n.dilation_angle = dilation_angle_of(curves);
  n.intact_peak = at_peak(curves.intact);
  n.intact_end = curves.intact[last];
  n.passed_peak = std::any_of(curves.q.begin() + static_cast<std::ptrdiff_t>(n.peak), curves.q.end(),
                              [&](double q) { return q <= share_past_peak * n.peak_q; });
  return n;
}

StageRecord record_of(TestNumbers const& n) {
  StageRecord record{{"peak_q_Pa", n.peak_q},
                     {"peak_eps1", n.peak_eps1},
                     {"peak_passed", n.passed_peak ? 1.0 : 0.0},
                     {"peak_eps_v", n.eps_v_peak},
                     {"peak_bonds_intact_pct", n.intact_peak},
                     {"residual_q_Pa", n.residual_q},
                     {"residual_from_eps1", n.residual_from},
                     {"largest_eps_v", n.largest_eps_v},
                     {"largest_eps_v_eps1", n.largest_eps_v_eps1},
                     {"end_eps1", n.end_eps1},
                     {"end_eps_v", n.eps_v_end},
                     {"end_bonds_intact_pct", n.intact_end}};
  if (n.secant_modulus) record["secant_modulus_Pa"] = *n.secant_modulus;
  if (n.dilation_angle) record["dilation_angle_deg"] = *n.dilation_angle * 180 / std::numbers::pi;
  std::erase_if(record, [](auto const& entry) { return !std::isfinite(entry.second); });
  return record;
}

}  // namespace clathra
