#pragma once
/// Figures as files, for publications.
#include <filesystem>
#include <string>
#include <vector>

#include "io/report/figure.hpp"

namespace clathra {

/// Writes each figure into the folder as SVG, CSV and, where librsvg's program rsvg-convert is installed, PDF.
/// @return what is written, as a line, and why there are no PDFs  @throws FileProblem
std::string write_figure_files(std::vector<Figure> const& figures, std::filesystem::path const& folder);

}  // namespace clathra
