#include "domain/measurement/fabric.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "domain/measurement/principal_axes.hpp"
#include "kernels/exact_sum.hpp"

namespace clathra {
namespace {

constexpr double half_turn = std::numbers::pi, bin_angle = half_turn / Rose::bins;

double direction_of(double cosine, double sine) {
  double const angle = std::atan2(sine, cosine) / 2;
  return angle < 0 ? angle + half_turn : angle;
}

void fit_forces(Rose& rose) {
  double sum = 0, cosine = 0, sine = 0;
  for (std::size_t i = 0; i < Rose::bins; ++i) {
    double const angle = (static_cast<double>(i) + 0.5) * bin_angle;
    sum += rose.forces[i], cosine += rose.forces[i] * std::cos(2 * angle), sine += rose.forces[i] * std::sin(2 * angle);
  }
  rose.force_anisotropy = sum > 0 ? 2 * std::hypot(cosine, sine) / sum : 0;
  rose.force_direction = direction_of(cosine, sine);
}

/// The line through the centres of a pair, of length 1, in the upper half of the plane whichever disc comes first.
struct Normal {
  double x, y;
  Normal(Snapshot const& s, std::size_t pair) {
    auto const a = static_cast<std::size_t>(s.a[pair]), b = static_cast<std::size_t>(s.b[pair]);
    double const dx = s.x[b] - s.x[a], dy = s.y[b] - s.y[a], length = std::hypot(dx, dy);
    double const sign = dy < 0 || (dy == 0 && dx < 0) ? -1 : 1;
    x = sign * dx / length, y = sign * dy / length;
  }
  /// Not of discs at the same place or nowhere.
  bool known() const { return std::isfinite(x) && std::isfinite(y); }
  std::size_t bin() const { return std::min(static_cast<std::size_t>(std::atan2(y, x) / bin_angle), Rose::bins - 1); }
};

/// Sums over the pairs of a set, in fixed point, so that their order does not matter.
struct PairSums {
  explicit PairSums(double force_unit) : force(force_unit), forces(Rose::bins, ExactSum(force_unit)) {}
  void add(Normal const& n, double normal_force) {
    std::size_t const bin = n.bin();
    counts[bin] += 1, pairs += 1;
    xx.add(n.x * n.x), yy.add(n.y * n.y), xy.add(n.x * n.y);
    force.add(normal_force), forces[bin].add(normal_force);
  }

  ExactSum xx{1}, yy{1}, xy{1}, force;
  std::vector<ExactSum> forces;
  std::array<double, Rose::bins> counts{};
  std::size_t pairs = 0;
};

Fabric fabric_of(PairSums& sums) {
  double const pairs = static_cast<double>(sums.pairs);
  Fabric f{sums.xx.over({}) / pairs, sums.yy.over({}) / pairs, sums.xy.over({}) / pairs};
  PrincipalAxes const axes = principal_axes(f.xx, f.yy, f.xy);
  f.deviator = axes.major - axes.minor, f.direction = axes.direction;
  return f;
}

}  // namespace

bool belongs(Snapshot const& s, std::size_t pair, ContactSet set) {
  auto const state = static_cast<ContactState>(s.state[pair]);
  bool const bonded = state == ContactState::bonded;
  // A pair that was never bonded is listed because it touches, and the sign of the gap says it also of one rounded to -0.
  bool const touching = state == ContactState::contact || std::signbit(s.gap[pair]);
  return (set != ContactSet::bonded && touching) || (set != ContactSet::touching && bonded);
}

Rose rose_of(Snapshot const& s, ContactSet set) {
  double largest = 0;
  for (double const force : s.normal_force) largest = std::max(largest, std::abs(force));
  PairSums sums(SumUnits::near(largest));
  for (std::size_t k = 0; k < s.a.size(); ++k)
    if (Normal const n(s, k); belongs(s, k, set) && n.known() && std::isfinite(s.normal_force[k])) sums.add(n, s.normal_force[k]);
  Rose rose;
  rose.pairs = sums.pairs;
  if (rose.pairs == 0) return rose;
  double const pairs = static_cast<double>(rose.pairs), force = sums.force.over({});
  for (std::size_t i = 0; i < Rose::bins; ++i) {
    rose.normals[i] = sums.counts[i] * static_cast<double>(Rose::bins) / pairs;
    rose.forces[i] = sums.counts[i] > 0 && force > 0 ? sums.forces[i].over({}) / sums.counts[i] / (force / pairs) : 0;
  }
  rose.fabric = fabric_of(sums);
  fit_forces(rose);
  return rose;
}

}  // namespace clathra
