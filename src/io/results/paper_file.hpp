#pragma once
/// Paper files: TOML that holds a paper (docs/reference/paper-file.md).
#include "io/results/paper.hpp"

namespace clathra {

/// @throws SceneProblems with all that is wrong in the file, FileProblem if it cannot be read
Paper load_paper(std::filesystem::path const& path);
/// The same from text. @param path  what the file would be called
Paper parse_paper(std::string const& text, std::filesystem::path const& path);

}  // namespace clathra
