#pragma once
/// Groups of tests that differ in their seed only: mean curves with bands, and what follows of their strength.
#include <string>
#include <utility>
#include <vector>

#include "io/report/plot.hpp"
#include "io/report/seed_bands.hpp"
#include "io/results/study_results.hpp"

namespace clathra {

inline constexpr char strain_axis[] = "axial strain ε₁ [%]";

/// What is shown of a band.
struct ShownBand {
  std::size_t column;  ///< in curve_columns
  char const *heading, *axis, *caption;
  double factor;
};
inline constexpr ShownBand shown_bands[] = {
    {0, "Stress and strain", "deviator stress q [MPa]", "Deviator stress on the walls.", 1e-6},
    {1, "Change of volume", "volumetric strain εᵥ [%]", "Compression is positive; a falling curve dilates.", 100},
    {2, "Intact bonds", "intact bonds [% of those installed]", "Bonds that still hold, as a share of those installed.", 1},
    {3, "Contacts", "mechanical coordination number", "Contacts of a particle, without those that carry nothing (Thornton 2000).",
     1},
    {4, "Broken in tension", "bonds broken in tension", "Those of the consolidation included.", 1},
    {5, "Broken in compression", "bonds broken in compression", "Those of the consolidation included.", 1},
    {6, "Broken in shear", "bonds broken in shear", "Those of the consolidation included.", 1},
    {7, "Broken in rolling", "bonds broken in rolling", "Those of the consolidation included.", 1}};

/// Another measure of intact bonds, which pages on papers can show.
inline constexpr ShownBand contacts_band{8, "Intact bonds", "bonded [% of all contacts]", "", 1};

/// A group with the curves of its finished members.
struct GroupCurves {
  std::string name;
  std::vector<Setting> settings;
  std::vector<SeedBand> bands;
  Stroke stroke;
};

/// The groups that have finished members, in the order of the study. @throws FileProblem
std::vector<GroupCurves> curves_of_groups(Study const& study, std::vector<MemberResult> const& members,
                                          std::vector<std::filesystem::path> const& folders);

/// Whether a band of a group says something: a clean sand has no bonds.
bool says_something(GroupCurves const& group, ShownBand const& what);
/// Shares end at 100 %.
Axis axis_of(ShownBand const& what, Range const& values);
Area area_of(GroupCurves const& group, ShownBand const& what);
Curve mean_of(GroupCurves const& group, ShownBand const& what);

/// The means of groups with their bands in one figure; empty where there is nothing. HTML.
/// @param more  further curves, such as points of a laboratory
std::string overlay(std::vector<GroupCurves> const& groups, ShownBand const& what, std::vector<Curve> const& more = {});

/// "3.04 ± 0.12": as many digits as the interval leaves sure.
std::string with_interval(std::vector<double> const& values, double factor);

/// A number of the envelopes against the saturation, with its interval as a vertical line; empty where the materials do not
/// differ in saturation. HTML.
std::string strength_figure(std::vector<GroupNumbers> const& materials, char const* number, std::string const& heading,
                            std::string const& axis, double factor, std::vector<Curve> const& more = {});

}  // namespace clathra
