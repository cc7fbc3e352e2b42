#pragma once
/// Cells of tables as CSV.
#include <string>

namespace clathra {

/// A cell, quoted where it has to be; a line break becomes a blank.
std::string csv_cell(std::string const& text);

}  // namespace clathra
