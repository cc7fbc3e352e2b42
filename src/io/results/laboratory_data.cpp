#include "io/results/laboratory_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "domain/scene/csv_rows.hpp"
#include "domain/scene/units.hpp"
#include "io/errors/printable.hpp"
#include "io/errors/problems.hpp"
#include "io/formats/text_file.hpp"
#include "io/results/shown_units.hpp"

namespace clathra {
namespace {

constexpr std::string_view header_line = "figure,name,strain,saturation_pct,confining_stress_MPa,x,y";
constexpr std::size_t largest_laboratory_file = std::size_t{16} << 20, cells_of_row = 7;
constexpr double pascals = 1e6, strains = 1 / percent;

double number_of(std::string_view cell, char const* column, double least, double most) {
  double value = 0;
  try {
    value = parse_number(cell);
  } catch (std::invalid_argument const&) {
    throw std::invalid_argument(fmt::format("column '{}' must be a number, got '{}'", column, printable(std::string(cell))));
  }
  if (!(value >= least && value <= most))
    throw std::invalid_argument(fmt::format("column '{}' must lie between {:g} and {:g}, got {:g}", column, least, most, value));
  return value;
}

LaboratoryAxes const& axes_of(std::string_view figure) {
  std::string allowed;
  for (LaboratoryAxes const& axes : laboratory_axes()) {
    if (axes.figure == figure) return axes;
    allowed += fmt::format("{}{}", allowed.empty() ? "" : ", ", axes.figure);
  }
  throw std::invalid_argument(
      fmt::format("column 'figure' must be one of {}, got '{}'", allowed, printable(std::string(figure))));
}

/// Whether strains are engineering ones.
bool is_engineering(LaboratoryAxes const& axes, std::string_view cell) {
  bool const has_strains = axes.x_strain || axes.y_strain;
  if (has_strains ? cell == "natural" || cell == "engineering" : cell.empty()) return cell == "engineering";
  throw std::invalid_argument(fmt::format("column 'strain' must be {}, got '{}'",
                                          has_strains ? "natural or engineering" : "empty for a figure without strains",
                                          printable(std::string(cell))));
}

double natural(double engineering, char const* column) {
  if (!(engineering < 1))
    throw std::invalid_argument(
        fmt::format("column '{}' must lie below 100 for an engineering strain, got {:g}", column, engineering * percent));
  return -std::log1p(-engineering);
}

std::optional<double> stated(std::string_view cell, char const* column, double least, double most, double factor) {
  if (cell.empty()) return {};
  return factor * number_of(cell, column, least, most);
}

void add_point(LaboratoryData& data, std::vector<std::string_view> const& cells) {
  if (cells.size() != cells_of_row)
    throw std::invalid_argument(fmt::format("has {} cells, not {} ({})", cells.size(), cells_of_row, header_line));
  constexpr double most = 1e6;
  LaboratoryAxes const& axes = axes_of(cells[0]);
  bool const engineering = is_engineering(axes, cells[2]);
  if (axes.x_column == "saturation_pct" && !(cells[3].empty() && cells[4].empty()))
    throw std::invalid_argument("columns 'saturation_pct' and 'confining_stress_MPa' must be empty for " +
                                std::string(axes.figure));
  LaboratorySeries series{&axes,
                          std::string(cells[1]),
                          stated(cells[3], "saturation_pct", 0, 100, 1),
                          stated(cells[4], "confining_stress_MPa", 1e-3, 1e3, pascals),
                          {},
                          {}};
  double x = axes.x_factor * number_of(cells[5], "x", -most, most), y = axes.y_factor * number_of(cells[6], "y", -most, most);
  if (engineering && axes.x_strain) x = natural(x, "x");
  if (engineering && axes.y_strain) y = natural(y, "y");
  auto const same = std::find_if(data.series.begin(), data.series.end(), [&](LaboratorySeries const& s) {
    return s.axes == series.axes && s.name == series.name && s.saturation == series.saturation &&
           s.confining_stress == series.confining_stress;
  });
  LaboratorySeries& to = same == data.series.end() ? data.series.emplace_back(std::move(series)) : *same;
  to.x.push_back(x);
  to.y.push_back(y);
}

}  // namespace

std::vector<LaboratoryAxes> const& laboratory_axes() {
  static std::vector<LaboratoryAxes> const all{
      {"q", "eps1", "q_Pa", "axial strain in %", "q in MPa", strains, pascals, true, false},
      {"eps_v", "eps1", "eps_v", "axial strain in %", "volumetric strain in %", strains, strains, true, true},
      {"pore_pressure", "eps1", "u_Pa", "axial strain in %", "u in MPa", strains, pascals, true, false},
      {"stress_ratio", "eps1", "q_over_p", "axial strain in %", "q/p", strains, 1, true, false},
      {"stress_path", "p_Pa", "q_Pa", "p in MPa", "q in MPa", pascals, pascals, false, false},
      {"compression", "sigma1_Pa", "void_ratio", "sigma_1 in MPa", "void ratio", pascals, 1, false, false},
      {"lateral_stress", "sigma1_Pa", "sigma3_Pa", "sigma_1 in MPa", "sigma_3 in MPa", pascals, pascals, false, false},
      {"c", "saturation_pct", "peak_cohesion_Pa", "saturation in %", "c in MPa", 1, pascals, false, false},
      {"phi", "saturation_pct", "peak_friction_angle_deg", "saturation in %", "phi in degrees", 1, 1, false, false}};
  return all;
}

LaboratoryData read_laboratory_data(std::filesystem::path const& path) {
  std::string const text = read_text_file(path, largest_laboratory_file);
  LaboratoryData data{path.filename().string(), {}};
  bool headed = false;
  for (CsvRows rows(text); rows.next_or_rest();) {
    if (rows.text().empty() || rows.text().front() == '#') continue;
    if (!headed) {
      if (rows.text() != header_line)
        throw FileProblem(ExitCode::bad_input, path, fmt::format("line {} must be the header '{}'", rows.line(), header_line));
      headed = true;
      continue;
    }
    try {
      add_point(data, rows.cells());
    } catch (std::invalid_argument const& problem) {
      throw FileProblem(ExitCode::bad_input, path, fmt::format("line {}: {}", rows.line(), problem.what()));
    }
  }
  if (data.series.empty()) throw FileProblem(ExitCode::bad_input, path, "holds no points");
  return data;
}

}  // namespace clathra
