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

constexpr std::string_view header_line = "figure,name,saturation_pct,confining_stress_MPa,x,y";
constexpr std::size_t largest_laboratory_file = std::size_t{16} << 20;
constexpr double pascals = 1e6;

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

void add_point(LaboratoryData& data, std::vector<std::string_view> const& cells) {
  if (cells.size() != 6) throw std::invalid_argument(fmt::format("has {} cells, not 6 ({})", cells.size(), header_line));
  LaboratorySeries series;
  series.figure = cells[0];
  series.name = cells[1];
  bool const curve = series.figure == "q" || series.figure == "eps_v";
  if (!curve && series.figure != "c" && series.figure != "phi")
    throw std::invalid_argument(fmt::format("column 'figure' must be q, eps_v, c or phi, got '{}'", printable(series.figure)));
  constexpr double most_y = 1e6;
  double const factor = series.figure == "q" || series.figure == "c" ? pascals : series.figure == "eps_v" ? 1 / percent : 1;
  series.saturation = curve ? number_of(cells[2], "saturation_pct", 0, 100) : 0;
  series.confining_stress = curve ? pascals * number_of(cells[3], "confining_stress_MPa", 1e-3, 1e3) : 0;
  double const x = curve ? number_of(cells[4], "x", -1, 100) / percent : number_of(cells[4], "x", 0, 100);
  double const y = factor * number_of(cells[5], "y", -most_y, most_y);
  auto const same = std::find_if(data.series.begin(), data.series.end(), [&](LaboratorySeries const& s) {
    return s.figure == series.figure && s.name == series.name && s.saturation == series.saturation &&
           s.confining_stress == series.confining_stress;
  });
  LaboratorySeries& to = same == data.series.end() ? data.series.emplace_back(std::move(series)) : *same;
  to.x.push_back(x);
  to.y.push_back(y);
}

}  // namespace

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
