#pragma once
/// Points that a user measured in a laboratory, to be drawn beside our curves.
#include <filesystem>
#include <string>
#include <vector>

namespace clathra {

/// A line through measured points.
struct LaboratorySeries {
  std::string figure;           ///< "q": q over eps_1; "eps_v": eps_v over eps_1; "c", "phi": over saturation
  std::string name;             ///< for the legend
  double saturation = 0;        ///< [%]
  double confining_stress = 0;  ///< [Pa]; 0 for c and phi
  std::vector<double> x, y;     ///< SI: strains, Pa; saturation in %, phi in degrees
};
struct LaboratoryData {
  std::string source;  ///< the file's name
  std::vector<LaboratorySeries> series;
};

/// Reads a CSV file with the header `figure,name,saturation_pct,confining_stress_MPa,x,y`, one row a point; x is the axial strain
/// in % (saturation in % for c and phi), y is q in MPa, eps_v in % (compression positive), c in MPa, phi in degrees. Rows of the
/// same first four cells are one series, in the order of the file. Lines that begin with # are passed over.
/// @throws FileProblem file_missing, or bad_input with line, column, value and what is allowed
LaboratoryData read_laboratory_data(std::filesystem::path const& path);

}  // namespace clathra
