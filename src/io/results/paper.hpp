#pragma once
/// A paper: which tests it made, what it claims of them and which of its figures are drawn.
#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/results/test_quantities.hpp"
#include "io/scene/study_file.hpp"

namespace clathra {

/// Groups of tests, or materials, in an order, with where they stand on an axis.
struct PaperSeries {
  std::string label, unit;  ///< the unit of `at`
  std::vector<std::string> groups;
  std::vector<double> at;              ///< ascending; one for each group, or none
  std::vector<std::string> names;      ///< of the places; one for each group, or none
  bool by_critical_thickness = false;  ///< `at` follows from the scenes [um]
};

/// A number to be looked at: of each of several groups.
struct WantedNumber {
  Quantity const* quantity = nullptr;
  double strain = 0;
  std::string unit;
  double factor = 1;  ///< to that unit
  std::string name() const { return number_name(*quantity, strain); }
};

/// What a part of a claim makes of the numbers of a series. value: each; step: each less the one before; rise: each less the
/// first; slope, bend: of the line and the parabola through them; bow: of the parabola, over the last number;
/// critical_thickness: Eq. 3 over what images show.
enum class PartKind { value, step, rise, slope, bend, bow, critical_thickness };
inline constexpr std::array<std::string_view, 7> part_kinds = {
    "value", "step", "rise", "slope", "bend", "bow", "critical_thickness"};

struct PaperPart {
  PartKind kind = PartKind::value;
  std::string what;                       ///< with {group}, {series}, {from} and {to} for their names
  WantedNumber number, less, only_where;  ///< those without quantity are not asked for
  double divided_by = 1;                  ///< of `less`
  double below = 0;                       ///< `only_where` must be
  double per = 1;                         ///< of a slope: for so much of the series' unit
  double low = -no_bound, high = no_bound;
  std::vector<PaperSeries> series;
};

struct PaperClaim {
  std::string id, words, where;
  bool ours = false;  ///< what we read from the paper, not what it states
  std::vector<PaperPart> parts;
};

enum class FigureKind {
  curves,
  table,
  critical_thickness,
  bond_shear_strength,
  bond_rolling_strength,
  mohr_circles,
  envelopes,
  grading,
  specimen,
  bonds,
  shear_strain,
  contact_directions
};
inline constexpr std::array<std::string_view, 12> figure_kinds = {"curves",
                                                                  "table",
                                                                  "critical_thickness",
                                                                  "bond_shear_strength",
                                                                  "bond_rolling_strength",
                                                                  "mohr_circles",
                                                                  "envelopes",
                                                                  "grading",
                                                                  "specimen",
                                                                  "bonds",
                                                                  "shear_strain",
                                                                  "contact_directions"};

struct PaperFigure {
  FigureKind kind = FigureKind::table;
  std::string title;        ///< with {series} for its label
  std::string words, ours;  ///< what the paper says and what is shown, for the caption
  std::string axis;
  std::size_t column = 0;                      ///< of curves: in curve_columns
  WantedNumber number;                         ///< of envelopes
  std::vector<PaperSeries> series;             ///< each makes a figure of its own
  bool only_complete = false;                  ///< left out where a test of it is not made
  std::vector<std::vector<std::string>> rows;  ///< of a table, the first of them its head
};

struct PaperSection {
  std::string heading;  ///< may be empty
  std::vector<PaperFigure> figures;
};

/// Saturation and mean thickness of hydrate between grains in an image.
struct ThicknessImage {
  double saturation = 0, thickness = 0, d50 = 0;  ///< SI
};

struct PaperSize {
  std::int64_t particles = 0;
  int seeds = 0;
};

struct Paper {
  std::filesystem::path file;
  std::string title, citation;
  PaperSize size;
  std::optional<PaperSize> quick;
  std::vector<double> strains;                ///< axial, that are looked at; ascending
  std::vector<Setting> shared;                ///< what all tests share
  std::vector<StudyGroup> groups;             ///< one at least
  std::map<std::string, std::string> labels;  ///< of groups
  std::vector<std::string> screening;         ///< groups that are enough to compare bond models by
  std::vector<ThicknessImage> images;
  std::vector<PaperClaim> claims;
  std::vector<PaperSection> sections;
};

/// nullptr where there is no group of this name.
StudyGroup const* group_of(Paper const& paper, std::string const& name);
/// Whether groups are tests of a material of this name.
bool is_material(Paper const& paper, std::string const& name);

/// Leaves out all other groups wherever they are named, and materials of which no group is left.
void keep_only(Paper& paper, std::vector<std::string> const& groups);

/// What the file says of the scene of a group, all else left as in Scene{}.
Scene stated_scene(Paper const& paper, StudyGroup const& group);

/// The series with its places; those that go by critical thickness are put in its order. @param d50  [m]
PaperSeries placed(Paper const& paper, PaperSeries series, double d50);

/// A group in words; of a material it is the name.
std::string label_of(Paper const& paper, std::string const& name);

/// The name of a place of a series: what the file calls it, else the place itself, else its group's label.
std::string place_name(Paper const& paper, PaperSeries const& series, std::size_t i);

/// Puts values for {names}.
std::string filled(std::string text, std::map<std::string, std::string> const& values);

/// A cell of a table with what its {marks} stand for: {KEY} is the value of a key of the scene, {KEY in UNIT} and {E_m in UNIT} a
/// number in a unit, {eq3 26 %} is h_max / d50 by Eq. 3. @param d50  [m]  @throws std::invalid_argument for any other mark
std::string cell_text(std::string const& cell, Scene const& scene, double d50);

}  // namespace clathra
