#include "domain/measurement/disc_grading.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clathra {

namespace {

/// Sum of r^2 of all ranks, in the order of the sizes.
double total_area(std::vector<double> const& sorted, Ranks const& ranks) {
  return ranks.relay(0, [&](double total) {
    for (double r : sorted) total += r * r;
    return total;
  });
}

}  // namespace

double grading_distance(Grading const& grading, std::vector<double> const& radii, Ranks const& ranks) {
  std::vector<double> const sorted = ranks.sorted_part(radii);
  double const total = total_area(sorted, ranks);
  double farthest = 0;
  ranks.relay(0, [&](double below) {
    for (double r : sorted) {
      double const curve = grading.finer_than(2 * r);
      farthest = std::max(farthest, std::abs(curve - (below + 0.5 * r * r) / total));
      below += r * r;
    }
    return below;
  });
  return ranks.max(farthest);
}

double diameter_finer(std::vector<double> const& radii, double fraction, Ranks const& ranks) {
  std::vector<double> const sorted = ranks.sorted_part(radii);
  double const total = total_area(sorted, ranks);
  double found = 1e300;
  ranks.relay(0, [&](double below) {
    for (double r : sorted) {
      below += r * r;
      if (below >= fraction * total) found = std::min(found, r);
    }
    return below;
  });
  found = ranks.min(found);
  if (found < 1e300) return 2 * found;
  return 2 * ranks.max(sorted.empty() ? 0 : sorted.back());
}

double solid_area(std::vector<double> const& radii, Ranks const& ranks) {
  return std::numbers::pi * total_area(ranks.sorted_part(radii), ranks);
}

double radius_above(std::vector<double> const& radii, double share, Ranks const& ranks) {
  std::vector<double> const sorted = ranks.sorted_part(radii);
  auto const below = static_cast<double>(ranks.sum(static_cast<std::int64_t>(radii.size()))) * share;
  double found = 1e300;
  ranks.relay(0, [&](double count) {
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
