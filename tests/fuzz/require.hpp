#pragma once
/// What a fuzzer holds to be true of every input.
#include <cstdlib>

namespace clathra {

/// Ends the program, which libFuzzer reports with the input, where it is not.
inline void require(bool truth) {
  if (!truth) std::abort();
}

}  // namespace clathra
