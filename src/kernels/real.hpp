#pragma once
/// Number roles and signs, stated once for the whole code.
///
/// Signs: compression is positive, anticlockwise is positive, a contact normal points from disc a to disc b.
/// Units: SI, per metre of out-of-plane thickness (length m, force N/m, stiffness N/m per m, moment N m/m).
#include <Kokkos_Core.hpp>
#include <cstdint>
#include <string>

#include "kernels/precision.hpp"

namespace clathra {

using Coord = double;  ///< positions and angles
using Real = double;   ///< forces and laws, off the hot path
using Accum = double;  ///< sums handed to the host

/// The number types of the contact kernel, which is compiled once for each. All other kernels work in double precision on what
/// either keeps (real_field.hpp).
struct FullPrecision {
  static constexpr Precision precision = Precision::full;
  using Real = double;
};
struct MixedPrecision {
  static constexpr Precision precision = Precision::mixed;
  using Real = float;
};

using ExecutionSpace = Kokkos::DefaultExecutionSpace;
using MemorySpace = ExecutionSpace::memory_space;
template <class T>
using Field = Kokkos::View<T*, MemorySpace>;

inline constexpr Real pi = 3.14159265358979323846;

/// A field whose old contents are not wanted: allocated without the zero fill.
template <class T>
Field<T> uninitialised(char const* label, std::size_t size) {
  return Field<T>(Kokkos::view_alloc(std::string(label), Kokkos::WithoutInitializing), size);
}

}  // namespace clathra
