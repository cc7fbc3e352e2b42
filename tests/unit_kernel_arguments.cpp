/// What a kernel is given arrives on the device as the host has it: their compilers agree on where its members stand.
#include <gtest/gtest.h>

#include "kernels/particles.hpp"
#include "on_host.hpp"

namespace clathra {
namespace {

struct WriteArguments {
  enum { extent, rows, columns, first_of_cells, owned, last, count };
  Field<double> values;
  Kokkos::View<int**, MemorySpace> cells;
  ParticleSoA particles;
  double number;
  Field<double> out;

  KOKKOS_FUNCTION void operator()(int) const {
    out(extent) = static_cast<double>(values.extent(0));
    out(rows) = static_cast<double>(cells.extent(0));
    out(columns) = static_cast<double>(cells.extent(1));
    out(first_of_cells) = cells(1, 2);
    out(owned) = particles.owned;
    out(last) = number;
  }
};

TEST(KernelArguments, StandOnTheDeviceWhereTheHostPutsThem) {
  Kokkos::View<int**, MemorySpace> const cells("cells", 7, 9);
  Kokkos::deep_copy(cells, 41);
  ParticleSoA particles;
  particles.owned = 23;
  Field<double> const out("out", WriteArguments::count);
  Kokkos::parallel_for("write_arguments", 1, WriteArguments{Field<double>("values", 5), cells, particles, 0.125, out});
  auto const read = host_copy(out);
  EXPECT_EQ(read(WriteArguments::extent), 5);
  EXPECT_EQ(read(WriteArguments::rows), 7);
  EXPECT_EQ(read(WriteArguments::columns), 9);
  EXPECT_EQ(read(WriteArguments::first_of_cells), 41);
  EXPECT_EQ(read(WriteArguments::owned), 23);
  EXPECT_EQ(read(WriteArguments::last), 0.125);
}

}  // namespace
}  // namespace clathra
