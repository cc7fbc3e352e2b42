#pragma once
/// Points that a user measured in a laboratory, to be drawn beside our curves.
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clathra {

/// A kind of figure that points can be laid over.
struct LaboratoryAxes {
  std::string_view figure;                                ///< its word in the file
  std::string_view x_column, y_column, x_shown, y_shown;  ///< of histories; what the file has there
  double x_factor, y_factor;                              ///< from there to SI
  bool x_strain, y_strain;
};
/// All of them.
std::vector<LaboratoryAxes> const& laboratory_axes();

/// A line through measured points.
struct LaboratorySeries {
  LaboratoryAxes const* axes;
  std::string name;                        ///< for the legend
  std::optional<double> saturation;        ///< [%]
  std::optional<double> confining_stress;  ///< [Pa]
  std::vector<double> x, y;                ///< SI: natural strains, Pa; saturation in %, phi in degrees
};
struct LaboratoryData {
  std::string source;  ///< the file's name
  std::vector<LaboratorySeries> series;
};

/// Reads a CSV file with the header `figure,name,strain,saturation_pct,confining_stress_MPa,x,y`, one row a point. `strain` is
/// "natural" or "engineering" (-ln(1 - e) is the natural one) where the figure has strains, else empty; saturation and stress may
/// be left empty. Rows of the same figure, name, saturation and stress are one series, in the order of the file. Lines that begin
/// with # are passed over.
/// @throws FileProblem file_missing, or bad_input with line, column, value and what is allowed
LaboratoryData read_laboratory_data(std::filesystem::path const& path);

}  // namespace clathra
