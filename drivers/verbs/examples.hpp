#pragma once
/// The scenes and studies of the folder examples/, built into the program.
#include <span>
#include <string_view>

namespace clathra {

struct Example {
  std::string_view name;  ///< "quick", "paper/s55-1mpa", "studies/saturations"
  std::string_view text;  ///< the file
};

/// Sorted by name. Their source is made by drivers/verbs/examples.cmake.
std::span<Example const> examples();

}  // namespace clathra
