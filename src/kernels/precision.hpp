#pragma once
/// In what numbers discs are stepped: for scenes as well as for kernels.
#include <cstdint>

namespace clathra {

/// `full`: all in double precision. `mixed`: the forces of contacts and bonds, and velocities, in single precision, from
/// differences of places that are exact to some picometres, with histories in fixed point; places and sums in double precision.
enum class Precision : std::int8_t { full, mixed };
inline constexpr char const* precision_names[] = {"double", "mixed"};

}  // namespace clathra
