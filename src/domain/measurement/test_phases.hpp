#pragma once
/// Peak and residual state of a biaxial test, defined once for its record, the report and our tables.
#include <cmath>
#include <cstddef>
#include <vector>

namespace clathra {

/// The axial strain from which on a test that ends at `end_eps1` is in its residual state: 12 % of a test to about 15 %, else the
/// last fifth. Residual numbers are means over the records from there on.
inline double residual_from(double end_eps1) {
  constexpr double long_test = 0.14, residual_strain = 0.12, last_fifth = 0.8;
  return end_eps1 > long_test ? residual_strain : last_fifth * end_eps1;
}

/// Whether a deviator stress takes the place of the largest one before it: the first of equal ones is the peak.
inline bool is_new_peak(double q, double peak_q) { return std::isfinite(q) && !(q <= peak_q); }

/// Row of the peak; 0 where no q is finite.
inline std::size_t peak_row(std::vector<double> const& q) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < q.size(); ++i)
    if (is_new_peak(q[i], q[best])) best = i;
  return best;
}

}  // namespace clathra
