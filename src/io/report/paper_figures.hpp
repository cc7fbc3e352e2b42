#pragma once
/// The figures of the page on Jiang et al. (2017). Empty where there are no tests for one.
#include <string>

#include "io/report/group_curves.hpp"
#include "io/report/paper_report.hpp"

namespace clathra {

/// Fig. 6: critical thickness over saturation with the three images.
Piece critical_thickness_figure();
/// Fig. 8: strength of a bond without gap in shear and rolling over the normal force, of the first bonded test's scene.
Piece envelope_figure(Reproduction const& r);
/// Figs. 11, 12, 15, 16, 17: q and volumetric strain, by saturation, by stress, by critical thickness.
Piece test_curve_figures(Reproduction const& r, std::vector<GroupCurves> const& curves);
/// Figs. 13, 14: Mohr circles with envelopes of the first seed; c and phi over saturation.
Piece strength_part(Reproduction const& r);
/// Figs. 18a, 19: q, volumetric strain and intact bonds of 55 % at 3 MPa.
Piece one_test_figures(Reproduction const& r);
/// Figs. 9, 10, 18b, 20, 21: grading, specimen, bonds, shear strain and contact directions of 55 % at 3 MPa, first seed.
Piece picture_figures(Reproduction const& r);

/// The paper's words on a figure with what is ours, as a caption.
std::string beside_words(std::string const& words, std::string const& ours);

}  // namespace clathra
