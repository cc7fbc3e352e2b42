#pragma once
/// Launches of kernels that hold many fields.
#include "kernels/real.hpp"

namespace clathra {

/// What goes along with a launch of CUDA is no larger.
inline constexpr std::size_t most_bytes_of_a_light_kernel = 4096;

/// For 0 .. n. On a GPU of NVIDIA the kernel goes along with its launch: one of more than 512 bytes would else be put into a
/// buffer that the host waits for until the kernel before it has ended.
inline auto light_launch(ExecutionSpace const& space, int n) {
  return Kokkos::Experimental::require(Kokkos::RangePolicy<ExecutionSpace>(space, 0, n),
                                       Kokkos::Experimental::WorkItemProperty::HintLightWeight);
}
inline auto light_launch(int n) { return light_launch(ExecutionSpace(), n); }

}  // namespace clathra
