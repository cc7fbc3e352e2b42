#pragma once
/// Files that can be read once only, for a program that starts itself anew.
#include <cstddef>
#include <filesystem>
#include <string>

namespace clathra {

/// read_text_file(); what came through a pipe stays at hand for this process when it starts itself anew (set_up_threads()), which
/// finds the pipe empty. One file a process.
/// @throws FileProblem as read_text_file(), and where the text cannot be kept
std::string read_once(std::filesystem::path const& path, std::size_t limit);

}  // namespace clathra
