#pragma once
/// The kinds of figures that the page on a paper can show. HTML; empty where there are no tests for one.
#include <map>
#include <string>

#include "domain/measurement/snapshot.hpp"
#include "io/report/group_curves.hpp"
#include "io/report/paper_report.hpp"

namespace clathra {

/// The snapshots of the first member of a group that has some at the paper's strains.
struct ShownTest {
  Snapshot start;
  std::vector<Snapshot> at;  ///< the paper's strains, ascending; empty where there are none
};
ShownTest shown_test(Reproduction const& r, std::string const& group);

/// q, volumetric strain or another column of the tests of a series, laid over each other.
std::string curves_figure(Reproduction const& r, PaperFigure const& f, PaperSeries const& series,
                          std::vector<GroupCurves> const& all);
/// Eq. 3 with the paper's images.
std::string critical_thickness_figure(Reproduction const& r, PaperFigure const& f);
/// Strength in shear or rolling of a bond without gap between grains of d50 over its normal force, by the scenes of a series.
std::string bond_strength_figure(Reproduction const& r, PaperFigure const& f, PaperSeries const& series);
/// Mohr circles with envelopes of the first seed.
std::string mohr_circles(Reproduction const& r);
/// A number of the envelopes over saturation.
std::string envelopes_figure(Reproduction const& r, PaperFigure const& f);
/// What the snapshots of a test show: grading, specimen, bonds, shear_strain or contact_directions.
std::string picture_figure(PaperFigure const& f, ShownTest const& test);

/// The paper's words on a figure with what is ours, as a caption.
std::string beside_words(std::string const& words, std::string const& ours);

}  // namespace clathra
