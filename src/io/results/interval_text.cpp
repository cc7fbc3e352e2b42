#include "io/results/interval_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace clathra {
namespace {

/// @param decimals  behind the point; negative ones are in front of it
std::string rounded(double value, int decimals) {
  double const unit = std::pow(10.0, std::max(0, -decimals));
  std::string const text = fmt::format("{:.{}f}", decimals < 0 ? std::round(value / unit) * unit : value, std::max(0, decimals));
  return text.find_first_not_of("-0.") == std::string::npos && text.front() == '-' ? text.substr(1) : text;
}

/// Decimals of the second digit of an error, which rounding may move: 0.0996 is 0.10.
int decimals_of(double error) {
  int const decimals = 1 - static_cast<int>(std::floor(std::log10(error)));
  double const rounded_up = std::round(error * std::pow(10.0, decimals));
  return rounded_up >= 100 ? decimals - 1 : decimals;
}

}  // namespace

std::string with_error(double value, double error) {
  constexpr int most = 12;
  if (!(error > 0) || !std::isfinite(error)) return fmt::format("{:.4g} ± {:g}", value, error);
  int const decimals = std::min(most, decimals_of(error));
  return rounded(value, decimals) + " ± " + rounded(error, decimals);
}

std::string interval_text(MeanInterval const& mean, double factor) {
  return mean.half_width ? with_error(mean.mean * factor, *mean.half_width * factor) : fmt::format("{:.4g}", mean.mean * factor);
}

}  // namespace clathra
