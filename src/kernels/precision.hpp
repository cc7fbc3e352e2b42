#pragma once
/// In what numbers discs are stepped: for scenes as well as for kernels.
#include <cstdint>

namespace clathra {

/// `full`: all in double precision. `mixed`: the forces of contacts and bonds, and velocities, in single precision, from
/// differences of places that are exact to some picometres, with histories that are no sums (reference_configuration.hpp); places
/// and sums in double precision.
enum class Precision : std::int8_t { full, mixed };
inline constexpr char const* precision_names[] = {"double", "mixed"};

/// k_n over the stress up to which mixed precision resolves the overlaps. Round-off of 15 pm lets forces of 1 nm of overlap rest
/// at an unbalanced ratio of 5e-3 (8e-3 was measured at 3e5), and rest is below 1e-3. Discs that turn slowly rested higher
/// still: 1.1e-3 to 1.6e-3 at 2e4 in three of six specimens with the usual inertia_scaling, below 1e-3 in all of them at 1.4e4.
/// That was measured when all overlaps were rounded so; now only those of pairs without a reference are.
inline constexpr double stiffness_resolved = 1e4;
/// @param normal_stiffness [N/m per m];  @param stress [Pa] of the assembly
inline bool mixed_precision_resolves(double normal_stiffness, double stress) {
  return normal_stiffness <= stiffness_resolved * stress;
}

}  // namespace clathra
