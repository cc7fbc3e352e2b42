#pragma once
/// Files that are built into the program: the scenes and studies of the folder examples/ and the paper that `reproduce` makes
/// unless told otherwise.
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace clathra {

struct Example {
  std::string_view name;  ///< "quick", "paper/s55-1mpa", "studies/saturations"
  std::string_view text;  ///< the file
};

/// Sorted by name. The source of both is made by drivers/study/examples.cmake.
std::span<Example const> examples();
/// Nothing where there is no such example.
Example const* example_named(std::string_view name);
/// A line each: its name and the first sentence of its comment.
std::string listed_examples();
/// Writes a scene with all keys and comments, or a study with its scene beside it, where no file is. @return what was written, in
/// words  @throws FileProblem
std::string write_example(Example const& example, std::filesystem::path const& path);

/// share/papers/jiang-2017.toml
std::string_view built_in_paper();

}  // namespace clathra
