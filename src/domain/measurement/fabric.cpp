#include "domain/measurement/fabric.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "domain/measurement/principal_axes.hpp"

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

/// Whether the discs of a pair hold or press each other. That is why contacts and bonds are listed at all, however weak: their
/// force may be rounded to 0. A pair whose bond broke is listed in any case; it presses where the discs overlap, and the sign of
/// the gap says that also of one that is rounded to -0.
bool carries(Snapshot const& s, std::size_t pair) {
  auto const state = static_cast<ContactState>(s.state[pair]);
  return state == ContactState::contact || state == ContactState::bonded || std::signbit(s.gap[pair]);
}

}  // namespace

Rose rose_of(Snapshot const& s) {
  Rose rose;
  std::array<double, Rose::bins> counts{}, sums{};
  double xx = 0, yy = 0, xy = 0, force = 0;
  for (std::size_t k = 0; k < s.a.size(); ++k) {
    if (!carries(s, k)) continue;
    auto const a = static_cast<std::size_t>(s.a[k]), b = static_cast<std::size_t>(s.b[k]);
    double angle = std::atan2(s.y[b] - s.y[a], s.x[b] - s.x[a]);
    if (angle < 0) angle += half_turn;
    auto const bin = std::min(static_cast<std::size_t>(angle / bin_angle), Rose::bins - 1);
    counts[bin] += 1, sums[bin] += s.normal_force[k];
    double const nx = std::cos(angle), ny = std::sin(angle);
    xx += nx * nx, yy += ny * ny, xy += nx * ny, force += s.normal_force[k];
    ++rose.pairs;
  }
  if (rose.pairs == 0) return rose;
  double const pairs = static_cast<double>(rose.pairs);
  for (std::size_t i = 0; i < Rose::bins; ++i) {
    rose.normals[i] = counts[i] * static_cast<double>(Rose::bins) / pairs;
    rose.forces[i] = counts[i] > 0 && force > 0 ? sums[i] / counts[i] / (force / pairs) : 0;
  }
  PrincipalAxes const fabric = principal_axes(xx / pairs, yy / pairs, xy / pairs);
  rose.normal_anisotropy = 2 * (fabric.major - fabric.minor);
  rose.normal_direction = fabric.direction;
  fit_forces(rose);
  return rose;
}

}  // namespace clathra
