#pragma once
/// Mohr circles, and the cohesion and friction angle of tests at several confining stresses.
#include <optional>
#include <string>
#include <vector>

#include "io/results/run_results.hpp"

namespace clathra {

/// Principal stresses at failure [Pa].
struct FailureStress {
  double sigma1 = 0, sigma3 = 0;
};

/// A Mohr-Coulomb envelope: tau = c + sigma tan(phi).
struct Envelope {
  double cohesion = 0;        ///< [Pa]
  double friction_angle = 0;  ///< [rad]
};

/// The straight line sigma_1 = 2 c sqrt(N) + N sigma_3 with N = (1 + sin phi) / (1 - sin phi) through the tests, by least
/// squares. Exact for two. Nothing where all have the same sigma_3, or sigma_1 falls with sigma_3.
std::optional<Envelope> fitted_envelope(std::vector<FailureStress> const& tests);

/// Circles at the peak and in the residual state for each material (see likeness.hpp) that was tested at two confining stresses
/// or more, with the envelope of the tests whose q has passed its peak; what comes of it against the saturation; and why runs are
/// not joined. Empty where there is nothing of that. HTML.
std::string strength_figures(std::vector<RunResults> const& runs);

}  // namespace clathra
