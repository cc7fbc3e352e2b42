#pragma once
/// Number roles and signs, stated once for the whole code.
///
/// Signs: compression is positive, anticlockwise is positive, a contact normal points from disc a to disc b.
/// Units: SI, per metre of out-of-plane thickness (length m, force N/m, stiffness N/m per m, moment N m/m).
#include <Kokkos_Core.hpp>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

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
#ifdef CLATHRA_MEMORY_SPACE  // of tests, instead of the memory that kernels have (tests/device_like)
using MemorySpace = CLATHRA_MEMORY_SPACE;
#else
using MemorySpace = ExecutionSpace::memory_space;
#endif
template <class T>
using Field = Kokkos::View<T*, MemorySpace>;

inline constexpr Real pi = 3.14159265358979323846;

/// Before a function template that kernels and the host call alike with something to call in turn: what they give belongs to
/// their side, which nvcc does not know and would warn of.
#ifdef __NVCC__
#define CLATHRA_OF_THE_CALLERS_SIDE _Pragma("nv_exec_check_disable")
#else
#define CLATHRA_OF_THE_CALLERS_SIDE
#endif

/// A field whose old contents are not wanted: allocated without the zero fill.
template <class T>
Field<T> uninitialised(char const* label, std::size_t size) {
  return Field<T>(Kokkos::view_alloc(std::string(label), Kokkos::WithoutInitializing), size);
}

/// A view as the host may read it: itself where that is so, else a copy.
template <class View>
auto host_copy(View const& view) {
  return Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), view);
}
/// The first numbers of a field.
template <class T>
std::vector<T> on_host(Field<T> const& field, std::size_t size) {
  auto const host = host_copy(Kokkos::subview(field, std::pair<std::size_t, std::size_t>(0, size)));
  return {host.data(), host.data() + size};
}

}  // namespace clathra
