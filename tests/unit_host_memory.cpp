#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "domain/parallel/host_memory.hpp"

namespace clathra {
namespace {

#ifdef __GLIBC__
TEST(HostMemory, AsksForHugePagesOnceAndNotWhereTheUserHasSaidSomething) {
  constexpr char name[] = "GLIBC_TUNABLES";
  char const* const set = std::getenv(name);
  std::string const before = set ? set : "";
  ::unsetenv(name);
  EXPECT_TRUE(ask_for_huge_pages());
  EXPECT_STREQ(std::getenv(name), "glibc.malloc.hugetlb=1");
  EXPECT_FALSE(ask_for_huge_pages());
  ::setenv(name, "glibc.malloc.check=0", 1);
  EXPECT_FALSE(ask_for_huge_pages());
  EXPECT_STREQ(std::getenv(name), "glibc.malloc.check=0");
  set ? ::setenv(name, before.c_str(), 1) : ::unsetenv(name);
}
#endif

}  // namespace
}  // namespace clathra
