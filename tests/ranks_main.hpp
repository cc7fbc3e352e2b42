#pragma once
/// The ranks that a test program was started on.
#include "domain/parallel/ranks.hpp"

namespace clathra {

Ranks const& world();

}  // namespace clathra
