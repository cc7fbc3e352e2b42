#include <gtest/gtest.h>

#include <Kokkos_Core.hpp>

/// Runs the tests of one program inside one Kokkos session. GoogleTest takes its own options first, Kokkos the rest.
int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  Kokkos::ScopeGuard const kokkos(argc, argv);
  return RUN_ALL_TESTS();
}
