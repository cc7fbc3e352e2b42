#pragma once
/// The grading curve of specimens.
#include <optional>
#include <string>
#include <vector>

#include "io/report/plot.hpp"
#include "io/results/run_results.hpp"

namespace clathra {

/// Percent finer by mass against diameter [m] of discs, from the smallest to the largest.
Curve grading_curve(std::vector<float> const& radii, std::string const& name, Stroke const& stroke);

/// The curve that the scene asks for; nothing where it is in a file of its own, which may have changed since.
std::optional<Curve> target_curve(RunResults const& run);

/// The curves over a logarithmic diameter, under a title.
Piece grading_figure(std::string const& title, std::vector<Curve> const& curves);

}  // namespace clathra
