#pragma once
/// The strength of the clean sand that a page shows, and what it says of tests whose hydrate changes.
#include <optional>
#include <vector>

#include "io/report/curves.hpp"
#include "io/results/study_results.hpp"

namespace clathra {

struct SandStrength {
  double cohesion = 0;        ///< c [Pa]
  double friction_angle = 0;  ///< phi [rad]

  double flow_value() const;                     ///< N = tan^2(45 deg + phi / 2)
  double lateral_stress(double deviator) const;  ///< at which it just bears q: (q - 2 c sqrt(N)) / (N - 1) [Pa]
  double deviator_at_mean(double mean) const;    ///< 2 c cos(phi) + 2 p sin(phi) [Pa]
};

/// That of the peaks of the first clean sand that was sheared at two lateral stresses or more; nothing where there is none.
std::optional<SandStrength> strength_of_sand(std::vector<RunResults> const& runs);
std::optional<SandStrength> strength_of_sand(std::vector<GroupNumbers> const& materials);

/// The paths q over p of runs whose hydrate changes, where they failed, and the strength of the sand where it is known. Empty
/// where no hydrate changes.
Piece failure_figure(ShownRuns const& shown, std::optional<SandStrength> const& sand);
/// For the runs of each name the lateral stress at which the sand bears their load no more beside that at which they failed.
/// Empty likewise.
Piece failure_table(ShownRuns const& shown, std::optional<SandStrength> const& sand);

/// All that a page shows of hydrate that changes.
Piece hydrate_part(ShownRuns const& shown, std::optional<SandStrength> const& sand);

}  // namespace clathra
