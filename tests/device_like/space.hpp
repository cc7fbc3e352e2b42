#pragma once
/// A memory space that acts like that of a device on a processor: the host can reach it, but is not meant to, and
/// host_access.hpp sees to it. Needs the logical spaces of Kokkos 3.
#include <Kokkos_Core.hpp>
#include <Kokkos_LogicalSpaces.hpp>

namespace clathra::device_like {

inline constexpr char const* space_name = "DeviceLike";

/// Memory whose header, which Kokkos reads on the host, has a page of its own in front of the data.
void* allocate(char const* label, std::size_t size);
void deallocate(void* memory, std::size_t size);
/// That the host waits for the reduction that was launched last.
void note_wait_for_reduction();

/// What gives the memory.
struct Pages {
  using memory_space = Pages;
  using size_type = std::size_t;
  using execution_space = Kokkos::DefaultExecutionSpace;
  using device_type = Kokkos::Device<execution_space, memory_space>;
  static constexpr char const* name() { return space_name; }
  void* impl_allocate(char const* label, std::size_t size, std::size_t, Kokkos::Tools::SpaceHandle) const {
    return allocate(label, size);
  }
  void impl_deallocate(char const*, void* memory, std::size_t size, std::size_t, Kokkos::Tools::SpaceHandle) const {
    deallocate(memory, size);
  }
};
struct Name {
  static constexpr char const* get_name() { return space_name; }
};
using MemorySpace = Kokkos::Experimental::LogicalMemorySpace<Pages, Kokkos::DefaultExecutionSpace, Name,
                                                             Kokkos::Experimental::LogicalSpaceSharesAccess::no_shared_access>;

}  // namespace clathra::device_like

namespace Kokkos::Impl {

template <>
struct MemorySpaceAccess<HostSpace, clathra::device_like::MemorySpace> {
  enum { assignable = false, accessible = true, deepcopy = true };
};
template <>
struct MemorySpaceAccess<clathra::device_like::MemorySpace, HostSpace> {
  enum { assignable = false, accessible = true, deepcopy = true };
};

/// The host waits for what is reduced into its own memory, and for no other reduction: noted for host_access.hpp.
template <class Result>
struct ParallelReduceFence<Kokkos::DefaultExecutionSpace, Result> {
  template <class Space, class Into>
  static void fence(Space const&, Into const&) {
    if constexpr (Kokkos::is_view<Result>::value) {
      if (std::is_same<typename Result::memory_space, clathra::device_like::MemorySpace>::value) return;
    }
    clathra::device_like::note_wait_for_reduction();
  }
};

/// Copies as between places of the host.
template <class Execution>
struct CopyOfHost {
  template <class... Arguments>
  explicit CopyOfHost(Arguments... arguments) {
    DeepCopy<HostSpace, HostSpace, Execution>(arguments...);
  }
};
template <class Execution>
struct DeepCopy<clathra::device_like::MemorySpace, clathra::device_like::MemorySpace, Execution> : CopyOfHost<Execution> {
  using CopyOfHost<Execution>::CopyOfHost;
};
template <class Execution>
struct DeepCopy<HostSpace, clathra::device_like::MemorySpace, Execution> : CopyOfHost<Execution> {
  using CopyOfHost<Execution>::CopyOfHost;
};
template <class Execution>
struct DeepCopy<clathra::device_like::MemorySpace, HostSpace, Execution> : CopyOfHost<Execution> {
  using CopyOfHost<Execution>::CopyOfHost;
};

}  // namespace Kokkos::Impl
