#pragma once
/// Curves of runs that differ in their seed only, laid over each other.
#include <algorithm>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "io/results/run_results.hpp"

namespace clathra {

/// A column of history.csv against axial strain, at the same strains for all seeds.
struct SeedBand {
  std::vector<double> eps1;                ///< from 0 to where the first of the seeds ends
  std::vector<std::vector<double>> seeds;  ///< values of each
  std::vector<double> mean, low, high;     ///< over the seeds at each strain; 95 % interval of the mean, which for one seed is it
  bool cut = false;                        ///< low and high end where the values that are possible do
};

/// Values that a quantity can have.
struct PossibleRange {
  double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
  double cut(double value) const { return std::clamp(value, least, most); }
};

/// Of a column of history.csv or a number of study.csv, by its name: shares lie between 0 and 100 %, counts and ratios above 0.
PossibleRange possible_range(std::string_view name);

/// One band for each of curve_columns; empty where a run has no such column. Between records curves are straight.
std::vector<SeedBand> seed_bands(std::vector<RunResults> const& runs);

}  // namespace clathra
