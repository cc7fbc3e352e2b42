#include "io/report/test_numbers.hpp"

#include <limits>

#include "domain/measurement/test_phases.hpp"

namespace clathra {
namespace {

/// Over the rows with at least this axial strain.
double mean_from(HistoryTable const& history, char const* column, double eps1) {
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < history.rows(); ++i)
    if (history["eps1"][i] >= eps1) sum += history[column][i], ++count;
  return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

/// E50, between the two rows where q passes half of its peak.
std::optional<double> secant_modulus(HistoryTable const& history, double peak_q) {
  std::vector<double> const &q = history["q_Pa"], &eps1 = history["eps1"];
  double const half = peak_q / 2;
  for (std::size_t i = 1; i < q.size(); ++i) {
    if (!(q[i] >= half && q[i - 1] < half)) continue;
    double const strain = eps1[i - 1] + (half - q[i - 1]) / (q[i] - q[i - 1]) * (eps1[i] - eps1[i - 1]);
    if (strain > 0) return half / strain;
  }
  return std::nullopt;
}

}  // namespace

TestNumbers test_numbers(HistoryTable const& history) {
  TestNumbers n;
  std::size_t const last = history.rows() - 1;
  n.peak = peak_row(history["q_Pa"]);
  n.peak_q = history["q_Pa"][n.peak];
  n.peak_eps1 = history["eps1"][n.peak];
  n.peak_sigma3 = history["sigma3_Pa"][n.peak];
  n.end_eps1 = history["eps1"][last];
  n.residual_from = residual_from(n.end_eps1);
  n.residual_q = mean_from(history, "q_Pa", n.residual_from);
  n.residual_sigma3 = mean_from(history, "sigma3_Pa", n.residual_from);
  n.secant_modulus = secant_modulus(history, n.peak_q);
  n.eps_v_peak = history["eps_v"][n.peak];
  n.eps_v_end = history["eps_v"][last];
  n.intact_end = history["intact_initial_pct"][last];
  n.passed_peak = n.peak < last;
  return n;
}

}  // namespace clathra
