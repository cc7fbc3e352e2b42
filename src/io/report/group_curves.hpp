#pragma once
/// Groups of tests that differ in their seed only: mean curves with bands, and what follows of their strength.
#include <string>
#include <utility>
#include <vector>

#include "io/report/plot.hpp"
#include "io/report/seed_bands.hpp"
#include "io/results/study_results.hpp"

namespace clathra {

/// What is shown of a band.
struct ShownBand {
  std::size_t column;  ///< in curve_columns
  char const* heading;
  Variable axis;
  char const* caption;
};
inline constexpr ShownBand shown_bands[] = {
    {0, "Stress and strain", {"deviator stress q [MPa]", curve_columns[0], 1e-6}, "Deviator stress on the walls."},
    {1,
     "Change of volume",
     {"volumetric strain εᵥ [%]", curve_columns[1], 100},
     "Compression is positive; a falling curve dilates."},
    {2,
     "Intact bonds",
     {"intact bonds [% of those installed]", curve_columns[2]},
     "Bonds that still hold, as a share of those installed."},
    {3,
     "Contacts",
     {"mechanical coordination number", curve_columns[3]},
     "Contacts of a particle, without those that carry nothing (Thornton 2000)."},
    {4, "Broken in tension", {"bonds broken in tension", curve_columns[4]}, "Those of the consolidation included."},
    {5, "Broken in compression", {"bonds broken in compression", curve_columns[5]}, "Those of the consolidation included."},
    {6, "Broken in shear", {"bonds broken in shear", curve_columns[6]}, "Those of the consolidation included."},
    {7, "Broken in rolling", {"bonds broken in rolling", curve_columns[7]}, "Those of the consolidation included."}};

/// Another measure of intact bonds, which pages on papers can show.
inline constexpr ShownBand contacts_band{8, "Intact bonds", {"bonded [% of all contacts]", curve_columns[8]}, ""};

/// A group with the curves of its finished members.
struct GroupCurves {
  std::string name;
  std::vector<Setting> settings;
  std::vector<SeedBand> bands;
  Stroke stroke;
  std::vector<RunResults> other_tests;  ///< of these members: those that are not one biaxial compression
};

/// The groups that have finished members, in the order of the study. @throws FileProblem
std::vector<GroupCurves> curves_of_groups(Study const& study, std::vector<MemberResult> const& members,
                                          std::vector<std::filesystem::path> const& folders);

/// What is smaller is rounding, in the units that are shown.
inline constexpr double least_shown = 1e-6;

/// Whether a band of a group says something: a clean sand has no bonds.
bool says_something(GroupCurves const& group, ShownBand const& what);
/// Shares end at 100 %.
Axis axis_of(ShownBand const& what, Range const& values);
Area area_of(GroupCurves const& group, ShownBand const& what);
Curve mean_of(GroupCurves const& group, ShownBand const& what);

/// The means of groups with their bands in one figure; empty where there is nothing.
/// @param more  further curves, such as points of a laboratory
Piece overlay(std::vector<GroupCurves> const& groups, ShownBand const& what, std::vector<Curve> const& more = {});

/// "3.04 ± 0.12": as many digits as the interval leaves sure.
std::string with_interval(std::vector<double> const& values, double factor);

/// A number of the envelopes, named by its column, against the saturation, with its interval as a vertical line; empty where the
/// materials do not differ in saturation.
Piece strength_figure(std::vector<GroupNumbers> const& materials, std::string const& heading, Variable const& number,
                      std::vector<Curve> const& more = {});

}  // namespace clathra
