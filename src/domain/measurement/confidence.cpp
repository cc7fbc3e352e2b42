#include "domain/measurement/confidence.hpp"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace clathra {
namespace {

/// Of |T| for n - 1 degrees of freedom.
double students_quantile(int count) {
  return boost::math::quantile(boost::math::students_t(count - 1), 0.5 + 0.5 * confidence_level);
}

}  // namespace

MeanInterval mean_interval(std::vector<double> const& values) {
  MeanInterval result;
  result.count = static_cast<int>(values.size());
  double const n = result.count;
  for (double const value : values) result.mean += value / n;
  if (result.count < 2) return result;
  double squares = 0;
  for (double const value : values) squares += (value - result.mean) * (value - result.mean);
  result.deviation = std::sqrt(squares / (n - 1));
  result.half_width = students_half_width(*result.deviation, result.count);
  return result;
}

double students_half_width(double deviation, int count) {
  return students_quantile(count) * deviation / std::sqrt(static_cast<double>(count));
}

void SequentialMean::look(std::vector<double> const& values) {
  MeanInterval const now = mean_interval(values);
  double const wide =
      now.half_width ? *now.half_width / (width_ * std::fabs(now.mean)) : 2;  // above 1: too wide; no number for 0/0
  narrow_looks_ = wide <= 1 || (now.half_width && *now.half_width == 0) ? narrow_looks_ + 1 : 0;
  double const enough = now.count * wide * wide;
  int const most = now.count + std::max(1, now.count / 4);
  wanted_ = enough < most ? std::max(now.count + 1, static_cast<int>(std::ceil(enough))) : most;
}

}  // namespace clathra
