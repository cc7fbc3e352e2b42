#pragma once
/// Files that are built into the program: the scenes and studies of the folder examples/ and the paper that `reproduce` makes
/// unless told otherwise.
#include <span>
#include <string_view>

namespace clathra {

struct Example {
  std::string_view name;  ///< "quick", "paper/s55-1mpa", "studies/saturations"
  std::string_view text;  ///< the file
};

/// Sorted by name. The source of both is made by drivers/verbs/examples.cmake.
std::span<Example const> examples();

/// share/papers/jiang-2017.toml
std::string_view built_in_paper();

}  // namespace clathra
