#pragma once
/// Multi-layer under-compaction (Jiang, Konrad, Leroueil 2003) to a target void ratio, and the proof of what came out.
#include "domain/generation/equilibration.hpp"
#include "domain/parallel/ranks.hpp"
#include "domain/scene/specimen.hpp"
#include "domain/scene/specimen_design.hpp"
#include "domain/scene/stage.hpp"

namespace clathra {

/// Void ratio to which the first i of n layers are compacted together: e_(i) = e_t + De (1 - (i-1)/(n-1))^m. As layers are closed
/// here, De = 0.003 is what makes all alike: with 0.02, usual where a plate tamps them, the lowest stay looser by 0.02.
/// @param layer 1 .. layers;  m = 2
double under_compaction_void_ratio(double target, int layer, int layers, double excess = 0.003, double exponent = 2);

/// Layer by layer: discs of the whole grading are placed loosely above the ones below and closed by the height, evenly, until all
/// have e_(i) + 0.04; then the whole closes to the void ratio of the design (compress()).
PackedSpecimen pack_by_under_compaction(Scene const& scene, SpecimenDesign const& design, ProgressCallback const& progress,
                                        Ranks const& ranks = {});

/// All discs at once, for specimens of any size: the same process everywhere (compress()).
PackedSpecimen pack_by_compression(Scene const& scene, SpecimenDesign const& design, ProgressCallback const& progress,
                                   Ranks const& ranks = {});

/// Nominal void ratio of `layers` horizontal bands of equal height; discs on a border are shared by their exact area.
std::vector<double> layer_void_ratios(Specimen const& specimen, int layers, Ranks const& ranks = {});

/// Area of the part of a disc below a horizontal line [m^2]; `offset` = line - centre [m].
double disc_area_below(double radius, double offset);

}  // namespace clathra
