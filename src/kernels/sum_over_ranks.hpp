#pragma once
/// How the kernels' sums reach the other ranks, of which kernels know nothing.
#include <cstdint>
#include <functional>

namespace clathra {

/// Adds integers to those of the other ranks that hold parts of the specimen; empty where there are none.
using SumOverRanks = std::function<void(std::int64_t*, int)>;

}  // namespace clathra
