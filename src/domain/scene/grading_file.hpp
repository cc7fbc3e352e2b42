#pragma once
/// Gradings as laboratories have them: the table of a sieve analysis (docs/reference/grading-file.md).
#include <string>
#include <string_view>

#include "domain/scene/grading.hpp"

namespace clathra {

/// @throws std::invalid_argument with file, line, value and what is likely to be wrong
Grading read_grading(std::string const& path);

/// The same for the text of a file. @param name  that of the file, for messages
Grading parse_grading(std::string_view text, std::string const& name);

}  // namespace clathra
