#pragma once
/// The strength of materials, from tests at several confining stresses.
#include <optional>
#include <string>
#include <vector>

#include "domain/measurement/paired_strength.hpp"
#include "io/results/run_results.hpp"
#include "io/results/tested_material.hpp"

namespace clathra {

/// Principal stresses of the tests of a group in one state, the peak or the residual one.
struct TestStresses {
  std::vector<FailureStress> all;   ///< each a circle
  std::vector<SeedTest> reached;    ///< those whose q has passed its peak: only they say what the strength is
  std::vector<std::string> rising;  ///< the names of the others
};

/// Tests of one material (tested_material.hpp), which differ in confining stress and seed only, and what they say of its
/// strength.
struct StrengthGroup {
  SceneValues material;              ///< without the confining stress
  std::vector<std::size_t> members;  ///< places in the list of runs
  double saturation = 0;             ///< [%]
  TestStresses peaks, residuals;     ///< in the order of the members
  PairedStrength at_peak, residual;  ///< of those that reached their peak

  /// Whether there is something to compare.
  bool at_several_stresses() const { return fitted_envelope(peaks.all) || fitted_envelope(residuals.all); }
};

/// By saturation, then in the order of the runs. Runs whose history has no lateral stress are in none.
std::vector<StrengthGroup> strength_groups(std::vector<RunResults> const& runs);

}  // namespace clathra
