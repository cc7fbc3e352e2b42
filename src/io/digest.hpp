#pragma once
/// XXH3-128 digests in hexadecimal: which input a result came from.
#include <filesystem>
#include <string>
#include <string_view>

namespace clathra {

std::string text_digest(std::string_view text);

/// @throws FileProblem file_missing or io_error
std::string file_digest(std::filesystem::path const& path);

}  // namespace clathra
