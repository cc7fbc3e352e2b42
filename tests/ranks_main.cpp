/// main() of the tests that run on several ranks. GoogleTest runs the same tests in the same order on each of them.
#include "ranks_main.hpp"

#include <gtest/gtest.h>

#include <Kokkos_Core.hpp>
#include <cstdlib>

namespace clathra {
namespace {
RankSession const* session = nullptr;
}
Ranks const& world() { return session->ranks(); }
}  // namespace clathra

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ::setenv("OMP_PROC_BIND", "false", 0);  // Kokkos warns when it is not set
  clathra::RankSession const ranks;
  clathra::session = &ranks;
  Kokkos::ScopeGuard const kokkos(argc, argv);
  int const failed = RUN_ALL_TESTS();
  return ranks.ranks().any(failed != 0) ? 1 : 0;
}
