#include "domain/measurement/test_numbers.hpp"

#include <limits>

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

}  // namespace

TestNumbers test_numbers(TestCurves const& curves) {
  TestNumbers n;
  std::size_t const last = curves.q.size() - 1;
  n.peak = peak_row(curves.q);
  n.peak_q = curves.q[n.peak];
  n.peak_eps1 = curves.eps1[n.peak];
  n.peak_sigma3 = curves.sigma3[n.peak];
  n.end_eps1 = curves.eps1[last];
  n.residual_from = residual_from(n.end_eps1);
  n.residual_q = mean_from(curves.eps1, curves.q, n.residual_from);
  n.residual_sigma3 = mean_from(curves.eps1, curves.sigma3, n.residual_from);
  n.secant_modulus = secant_modulus(curves.eps1, curves.q, n.peak_q);
  n.eps_v_peak = curves.eps_v[n.peak];
  n.eps_v_end = curves.eps_v[last];
  n.intact_end = curves.intact[last];
  n.passed_peak = n.peak < last;
  return n;
}

}  // namespace clathra
