#include <gtest/gtest.h>

#include <Kokkos_Core.hpp>
#include <cstdlib>

/// Runs the tests of one program inside one Kokkos session. GoogleTest takes its own options first, Kokkos the rest.
int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (GTEST_FLAG_GET(list_tests)) return RUN_ALL_TESTS();  // ctest reads this list: nothing else may be printed
  setenv("OMP_PROC_BIND", "false", 0);                     // Kokkos warns when it is not set
  Kokkos::ScopeGuard const kokkos(argc, argv);
  return RUN_ALL_TESTS();
}
