#include "domain/measurement/strength_fit.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>

namespace clathra {
namespace {

using Design = Eigen::Matrix<double, Eigen::Dynamic, 2>;

/// Errors of c = a / (2 sqrt N) and phi = asin((N - 1) / (N + 1)) from those of the line's coefficients a and N.
EnvelopeErrors errors_of(Design const& design, Eigen::VectorXd const& sigma1, Eigen::Vector2d const& line) {
  double const a = line(0), n = line(1), root = std::sqrt(n);
  double const squares = (sigma1 - design * line).squaredNorm(), freedom = static_cast<double>(sigma1.size()) - 2;
  Eigen::Matrix2d const of_line = squares / freedom * (design.transpose() * design).inverse();
  Eigen::Matrix2d slopes;  // of (c, phi) over (a, N)
  slopes << 1 / (2 * root), -a / (4 * n * root), 0, 1 / (root * (n + 1));
  Eigen::Matrix2d const covariance = slopes * of_line * slopes.transpose();
  double const all = (sigma1.array() - sigma1.mean()).matrix().squaredNorm();
  return {std::sqrt(covariance(0, 0)), std::sqrt(covariance(1, 1)), covariance(0, 1), all > 0 ? 1 - squares / all : 1};
}

/// Twice the last coefficient of a_0 + a_1 s + a_2 s^2, s the confining stress in units of its mean.
std::optional<double> curvature_of(Design const& design, Eigen::VectorXd const& sigma1, double mean) {
  Eigen::Matrix<double, Eigen::Dynamic, 3> powers(design.rows(), 3);
  powers.leftCols<1>().setOnes();
  powers.col(1) = design.col(1) / mean;
  powers.col(2) = powers.col(1).cwiseAbs2();
  constexpr double distinct = 1e-3;  // three stresses are fewer where they are nearer than that
  Eigen::ColPivHouseholderQR<Eigen::Matrix<double, Eigen::Dynamic, 3>> factors(powers);
  factors.setThreshold(distinct);
  if (factors.rank() < 3) return std::nullopt;
  Eigen::Vector3d const parabola = factors.solve(sigma1);
  return 2 * parabola(2) / (mean * mean);
}

}  // namespace

std::optional<Envelope> fitted_envelope(std::vector<FailureStress> const& tests) {
  auto const count = static_cast<Eigen::Index>(tests.size());
  if (count < 2) return std::nullopt;
  Design design(count, 2);
  Eigen::VectorXd sigma1(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    FailureStress const& test = tests[static_cast<std::size_t>(i)];
    design.row(i) << 1, test.sigma3;
    sigma1(i) = test.sigma1;
  }
  double const mean = design.col(1).mean(), spread = (design.col(1).array() - mean).matrix().squaredNorm();
  constexpr double same = 0.01;  // confining stresses that scatter by less are one
  if (!(spread > same * same * mean * mean * static_cast<double>(count)) || !sigma1.allFinite()) return std::nullopt;
  Eigen::Vector2d const line = design.colPivHouseholderQr().solve(sigma1);
  double const slope = line(1);
  if (!(slope > 0)) return std::nullopt;
  Envelope envelope{line(0) / (2 * std::sqrt(slope)), std::asin((slope - 1) / (slope + 1)), {}, {}};
  if (count > 2) envelope.errors = errors_of(design, sigma1, line), envelope.curvature = curvature_of(design, sigma1, mean);
  return envelope;
}

}  // namespace clathra
