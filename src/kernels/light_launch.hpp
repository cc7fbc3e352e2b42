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

/// A functor whose fields do not count that it refers to them, some hundred counts a step: small specimens feel these. It must
/// not outlive the fields. Kokkos makes its own copies of functors in the same way.
/// @param make  returns the functor
template <class Make>
auto uncounted(Make const& make) {
  Kokkos::Impl::shared_allocation_tracking_disable();
  auto functor = make();
  Kokkos::Impl::shared_allocation_tracking_enable();
  return functor;
}

}  // namespace clathra
