#pragma once
/// Cohesion and friction angle of a material whose tests share specimens: one envelope for each seed, and the mean of them.
#include <cstdint>
#include <optional>
#include <vector>

#include "domain/measurement/confidence.hpp"
#include "domain/measurement/strength_fit.hpp"

namespace clathra {

/// One test that reached what it is asked for, a peak or a residual state.
struct SeedTest {
  std::uint64_t seed = 0;
  double confining_stress = 0;  ///< that was asked for [Pa]
  FailureStress at;
};

/// Tests of one seed are of one specimen, so they are not independent of each other: what scatters is the envelope of a seed.
struct PairedStrength {
  std::vector<std::uint64_t> seeds;            ///< that are complete: with a test at each confining stress that any seed has
  std::vector<Envelope> of_seeds;              ///< of these
  std::vector<std::uint64_t> incomplete;       ///< their envelopes would be of other stresses
  std::optional<Envelope> envelope;            ///< the mean of those of the seeds; of one, or of tests without pairs, their fit
  std::optional<MeanInterval> cohesion;        ///< over the seeds [Pa]; of two or more
  std::optional<MeanInterval> friction_angle;  ///< [rad]
};

/// Where no seed is complete (each test has a seed of its own) the tests are independent: one fit to all of them, with its own
/// standard errors.
PairedStrength paired_strength(std::vector<SeedTest> const& tests);

}  // namespace clathra
