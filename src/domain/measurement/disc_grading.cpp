#include "domain/measurement/disc_grading.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace clathra {

namespace {

/// Sum of r^2 of all ranks, in the order of the sizes.
double total_area(std::vector<double> const& sorted, Ranks const& ranks) {
  return ranks.sequential_fold(0, [&](double total) {
    for (double r : sorted) total += r * r;
    return total;
  });
}

template <std::size_t n>
std::array<double, n> diameters_finer(std::vector<double> const& radii, std::array<double, n> const& fractions,
                                      Ranks const& ranks) {
  constexpr double none = 1e300;
  std::vector<double> const sorted = ranks.sorted_part(radii);
  double const total = total_area(sorted, ranks), largest = ranks.max(sorted.empty() ? 0 : sorted.back());
  std::array<double, n> found;
  found.fill(none);
  ranks.sequential_fold(0, [&](double below) {
    for (double r : sorted) {
      below += r * r;
      for (std::size_t k = 0; k < n; ++k)
        if (below >= fractions[k] * total) found[k] = std::min(found[k], r);
    }
    return below;
  });
  for (double& r : found) r = 2 * std::min(ranks.min(r), largest);
  return found;
}

}  // namespace

double grading_distance(Grading const& grading, std::vector<double> const& radii, Ranks const& ranks) {
  std::vector<double> const sorted = ranks.sorted_part(radii);
  double const total = total_area(sorted, ranks);
  double farthest = 0;
  ranks.sequential_fold(0, [&](double below) {
    for (double r : sorted) {
      // Where the curve is a step, as that of equal discs, anything from its foot to its head is on it.
      double const foot = grading.finer_than(2 * r * (1 - 1e-9)), head = grading.finer_than(2 * r * (1 + 1e-9)),
                   middle = (below + 0.5 * r * r) / total;
      farthest = std::max({farthest, foot - middle, middle - head});
      below += r * r;
    }
    return below;
  });
  return ranks.max(farthest);
}

double diameter_finer(std::vector<double> const& radii, double fraction, Ranks const& ranks) {
  return diameters_finer<1>(radii, {fraction}, ranks)[0];
}

CurveSizes sizes_of(std::vector<double> const& radii, Ranks const& ranks) {
  auto const [d10, d49, d50, d51, d90] = diameters_finer<5>(radii, {0.1, 0.49, 0.5, 0.51, 0.9}, ranks);
  return {d10, d49, d50, d51, d90};
}

Grading grading_of(std::vector<double> const& radii, Ranks const& ranks) {
  std::array<double, 101> fractions;
  for (std::size_t k = 0; k < fractions.size(); ++k) fractions[k] = static_cast<double>(k) / 100;
  std::array<double, 101> const sizes = diameters_finer<101>(radii, fractions, ranks);
  if (sizes.front() == sizes.back()) return Grading::uniform(sizes[0]);
  constexpr double step = 1 + 1e-6;  // of a curve where many discs have one size
  std::vector<double> diameters{sizes[0]};
  for (std::size_t k = 1; k < sizes.size(); ++k) diameters.push_back(std::max(sizes[k], step * diameters.back()));
  return {diameters, {fractions.begin(), fractions.end()}};
}

double solid_area(std::vector<double> const& radii, Ranks const& ranks) {
  return std::numbers::pi * total_area(ranks.sorted_part(radii), ranks);
}

double radius_above(std::vector<double> const& radii, double share, Ranks const& ranks) {
  std::vector<double> const sorted = ranks.sorted_part(radii);
  auto const below = static_cast<double>(ranks.sum(static_cast<std::int64_t>(radii.size()))) * share;
  double found = 1e300;
  ranks.sequential_fold(0, [&](double count) {
    for (double r : sorted) {
      if (count >= below) found = std::min(found, r);
      ++count;
    }
    return count;
  });
  found = ranks.min(found);
  return found < 1e300 ? found : ranks.max(sorted.empty() ? 0 : sorted.back());
}

}  // namespace clathra
