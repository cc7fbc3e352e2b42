#pragma once
/// What a few runs that differ in their random numbers say of the mean of all such runs.
#include <optional>
#include <vector>

namespace clathra {

/// Mean, standard deviation (over n - 1) and the 95 % confidence interval of the mean, mean -+ half_width, with
/// half_width = t deviation / sqrt(n) and t Student's quantile for n - 1 degrees of freedom (values taken as normally
/// distributed).
struct MeanInterval {
  int count = 0;
  double mean = 0;
  std::optional<double> deviation, half_width;  ///< of two values or more

  double low() const { return mean - half_width.value_or(0); }
  double high() const { return mean + half_width.value_or(0); }
};

inline constexpr double confidence_level = 0.95;

/// @param values  one at least
MeanInterval mean_interval(std::vector<double> const& values);

/// Half of the 95 % interval of the mean of `count` values (two at least) with this standard deviation.
double students_half_width(double deviation, int count);

/// Decides how many values a mean needs that shall be known to a part of itself, looking after each few of them. To stop at the
/// first narrow interval would favour those that are narrow by chance: they then hold the truth less often than they say. So two
/// looks in a row must find it narrow.
class SequentialMean {
 public:
  /// @param width  half of the interval over the mean at which it is narrow
  explicit SequentialMean(double width) : width_(width) {}
  /// @param values  all so far, in the order in which they were asked for
  void look(std::vector<double> const& values);
  bool done() const { return narrow_looks_ >= 2; }
  /// How many values to have at the next look: as many as the deviation asks for, but at most a quarter more than now.
  int wanted() const { return wanted_; }

 private:
  double width_;
  int narrow_looks_ = 0, wanted_ = 0;
};

}  // namespace clathra
