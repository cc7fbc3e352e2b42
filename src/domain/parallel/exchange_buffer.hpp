#pragma once
/// Numbers that kernels write or read and that go to other ranks or come from them. Memory is kept and grows when needed.
#include "kernels/real.hpp"

namespace clathra {

/// Where messages begin and end: in the memory of the device, which MPI then has to know (the option CLATHRA_GPU_AWARE_MPI), or
/// in memory of the host, pinned where Kokkos has such.
#if defined(CLATHRA_GPU_AWARE_MPI)
using MessageSpace = MemorySpace;
#elif defined(KOKKOS_HAS_SHARED_HOST_PINNED_SPACE)
using MessageSpace = Kokkos::SharedHostPinnedSpace;
#else
using MessageSpace = Kokkos::HostSpace;
#endif

class ExchangeBuffer {
 public:
  /// Room for `size` numbers; what stands in them is lost.
  void reserve(std::size_t size) {
    if (numbers_.extent(0) >= size) return;
    numbers_ = uninitialised<double>("exchanged", size + size / 8);
    message_ = Kokkos::create_mirror_view(MessageSpace(), numbers_);
  }
  /// For kernels.
  Field<double> const& numbers() const { return numbers_; }
  /// For MPI.
  double* message() const { return message_.data(); }
  /// Makes the message of the first numbers, once kernels have written them,
  void finish(std::size_t size) const {
    copy(numbers_, message_, size);
    Kokkos::fence();
  }
  /// and the numbers of a message that has come.
  void take(std::size_t size) const { copy(message_, numbers_, size); }
  std::size_t bytes() const { return numbers_.span() * sizeof(double); }

 private:
  template <class From, class To>
  static void copy(From const& from, To const& to, std::size_t size) {
    if (from.data() == to.data()) return;
    std::pair<std::size_t, std::size_t> const first(0, size);
    Kokkos::deep_copy(Kokkos::subview(to, first), Kokkos::subview(from, first));
  }

  Field<double> numbers_;
  decltype(Kokkos::create_mirror_view(MessageSpace(), Field<double>())) message_;
};

}  // namespace clathra
