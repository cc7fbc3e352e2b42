#pragma once
/// What a setting of the solver (loading rate, time step, precision, scaled masses) does to a number of a test, from runs of the
/// same specimens at several settings: the error against the limit of vanishing rate, with its interval.
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace clathra {

/// A number of the runs at one setting, by the seed of their specimens.
using SeedValues = std::map<std::uint64_t, double>;

/// The error of a setting as a part of the limit: `error` -+ `half_width`.
struct SettingError {
  int seeds = 0;         ///< that have a value at the setting and at both rates of the limit
  double error = 0;      ///< mean over the seeds
  double scatter = 0;    ///< standard deviation over them
  double remainder = 0;  ///< part of the slower rate's own error, by extrapolation
  double half_width = 0;

  double farthest() const;  ///< the largest |error| in the interval
  double nearest() const;   ///< the smallest
};

/// Runs at two rates, from whose values the limit of vanishing rate is extrapolated (Richardson) with an error of first order in
/// the rate: y_0 = y_slow - r, r = (y_fast - y_slow) / (ratio - 1), for each seed.
struct RatePair {
  SeedValues const &fast, &slow;
  double ratio = 0;  ///< of the rates, above 1
};

/// The mean of y - y_0 over the seeds, over the mean of y_0. The half width is that of the 95 % interval of the mean over seeds
/// (Student's t), and on top of it |mean r|: the order of the error is not known, and the interval then holds the truth for every
/// order from log((ratio + 1) / 2) / log(ratio) on (0.64 at a ratio of 3.3; compare the safety factor of Roache's grid
/// convergence index). Nothing with fewer than two seeds, or where the limit is 0.
std::optional<SettingError> setting_error(SeedValues const& values, RatePair const& pair);

enum class ErrorVerdict {
  within,   ///< the whole interval lies within the tolerance
  outside,  ///< all of it lies beyond
  open
};
ErrorVerdict verdict_on(SettingError const& error, double tolerance);

/// How many seeds a setting needs until its interval could lie within the tolerance, if mean and scatter stay as they are;
/// nothing where no number of seeds does: the mean and the remainder exceed the tolerance by themselves.
std::optional<int> seeds_needed(SettingError const& error, double tolerance);

}  // namespace clathra
