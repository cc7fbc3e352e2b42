/// Memory that neighbour searches keep for each other.
#include <gtest/gtest.h>

#include "kernels/scratch.hpp"

namespace clathra {
namespace {

TEST(Scratch, GivesTheSameMemoryAgainOnceNobodyHoldsIt) {
  Scratch scratch;
  Field<int> first = scratch.take<int>("first", 1000);
  EXPECT_EQ(first.extent(0), 1000u);
  int const* const memory = first.data();
  Field<int> const second = scratch.take<int>("second", 1000);
  EXPECT_NE(second.data(), memory);
  first = Field<int>();
  EXPECT_EQ(scratch.take<int>("third", 1010).data(), memory);  // a little larger
  EXPECT_EQ(scratch.take<int>("third", 990).data(), memory);
  EXPECT_NE(scratch.take<int>("third", 2000).data(), memory);
  EXPECT_NE(scratch.take<int>("third", 500).data(), memory);  // which would waste half of it
}

TEST(Scratch, KeepsFieldsOfEachTypeApart) {
  Scratch scratch;
  EXPECT_EQ(scratch.take<int>("none", 0).extent(0), 0u);
  EXPECT_EQ(scratch.bytes(), 0u);
  (void)scratch.take<int>("ints", 64);
  (void)scratch.take<double>("doubles", 64);
  EXPECT_EQ(scratch.bytes(), 64 * (sizeof(int) + sizeof(double)));
  RealField const reals = scratch.take_reals("reals", 64, {Storage::as_float});
  EXPECT_EQ(reals.extent(0), 64u);
  EXPECT_EQ(reals.bytes(), 64 * sizeof(float));
  EXPECT_EQ(scratch.bytes(), 64 * (sizeof(int) + sizeof(double))) << "what is held counts where it is held";
}

TEST(Scratch, GivesUpWhatTwoSearchesHaveNotTaken) {
  Scratch scratch;
  Field<int> const held = scratch.take<int>("held", 64);
  (void)scratch.take<int>("small", 100);
  scratch.tidy();
  for (int n = 0; n < 2; ++n) {
    (void)scratch.take<int>("large", 10000);
    EXPECT_EQ(scratch.bytes(), (128 + 10240) * sizeof(int));
    scratch.tidy();
  }
  EXPECT_EQ(scratch.bytes(), 10240 * sizeof(int));
  Kokkos::deep_copy(held, 1);  // is not the pool's any more, but still there
}

}  // namespace
}  // namespace clathra
