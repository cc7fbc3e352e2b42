#pragma once
/// The pictures of a run, from its snapshots.
#include <string>
#include <vector>

#include "io/report/plot.hpp"
#include "io/results/run_results.hpp"

namespace clathra {

/// The pictures that one run adds to the page at most; each may take an equal share of what the page has room for.
inline constexpr std::size_t pictures_per_run = 8;

struct MapFigures {
  Piece figures;
  Curve grading;  ///< of the first snapshot
};

/// Specimen, bonds at three strains, force chains, directions of contacts, and the field of shear strain.
/// @param run    has at least one snapshot
/// @param bytes  the most that a picture may have as PNG; it is drawn smaller until that holds
/// @throws FileProblem where a snapshot cannot be read
MapFigures map_figures(RunResults const& run, Stroke const& stroke, std::size_t bytes);

/// The indices of the first snapshot, the one nearest to the peak of q, and the last; without repetition.
std::vector<std::size_t> shown_snapshots(std::vector<std::int64_t> const& steps, std::int64_t peak_step);

}  // namespace clathra
