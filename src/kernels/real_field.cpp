#include "kernels/real_field.hpp"

namespace clathra {

namespace {

struct ReadNumbers {
  RealField from;
  Field<double> to;
  KOKKOS_FUNCTION void operator()(int i) const { to(i) = from(i); }
};

struct WriteNumbers {
  Field<double> from;
  RealField to;
  KOKKOS_FUNCTION void operator()(int i) const { to.set(i, from(i)); }
};

using HostNumbers = Kokkos::View<double*, Kokkos::HostSpace, Kokkos::MemoryTraits<Kokkos::Unmanaged>>;

}  // namespace

std::vector<double> on_host(RealField const& field, std::size_t size) {
  Field<double> const numbers = uninitialised<double>("numbers", size);
  Kokkos::parallel_for("read_numbers", Kokkos::RangePolicy<ExecutionSpace>(0, static_cast<int>(size)),
                       ReadNumbers{field, numbers});
  std::vector<double> values(size);
  Kokkos::deep_copy(HostNumbers(values.data(), size), numbers);
  return values;
}

void set_from_host(RealField const& field, std::vector<double> const& values) {
  Field<double> const numbers = uninitialised<double>("numbers", values.size());
  std::vector<double> copy = values;
  Kokkos::deep_copy(numbers, HostNumbers(copy.data(), copy.size()));
  Kokkos::parallel_for("write_numbers", Kokkos::RangePolicy<ExecutionSpace>(0, static_cast<int>(values.size())),
                       WriteNumbers{numbers, field});
  Kokkos::fence();
}

}  // namespace clathra
