#pragma once
/// Cohesion and friction angle of tests at several confining stresses.
#include <optional>
#include <vector>

namespace clathra {

/// Principal stresses at failure [Pa].
struct FailureStress {
  double sigma1 = 0, sigma3 = 0;
};

/// How far an envelope can be trusted: what the scatter of the tests about it says, which needs three tests or more.
struct EnvelopeErrors {
  double cohesion = 0, friction_angle = 0;  ///< standard errors [Pa, rad], to first order in those of the line
  double covariance = 0;                    ///< of c and phi [Pa rad]
  double r_squared = 1;                     ///< of the line
};

/// A Mohr-Coulomb envelope: tau = c + sigma tan(phi).
struct Envelope {
  double cohesion = 0;        ///< [Pa]
  double friction_angle = 0;  ///< [rad]
  std::optional<EnvelopeErrors> errors;
  std::optional<double> curvature;  ///< of sigma_1 over sigma_3 [1/Pa]: 2 a_2 of the least-squares parabola, negative where the
                                    ///< envelope flattens; only for three confining stresses or more
};

/// The straight line sigma_1 = 2 c sqrt(N) + N sigma_3 with N = (1 + sin phi) / (1 - sin phi) through the tests, by least
/// squares. Exact for two. Nothing where all have the same sigma_3, or sigma_1 falls with sigma_3. The errors follow from the
/// covariance s^2 (X^T X)^-1 of the line's two coefficients, s^2 the squared residuals over n - 2.
std::optional<Envelope> fitted_envelope(std::vector<FailureStress> const& tests);

}  // namespace clathra
