#include "io/results/spreadsheet.hpp"

#include <fmt/format.h>

#include <charconv>
#include <string_view>
#include <vector>

namespace clathra {
namespace {

/// A column's heading, and by what its numbers are multiplied.
struct Conversion {
  std::string heading;
  double factor = 1;
};

bool is_strain(std::string_view name) {
  for (std::string_view const strain : {"eps1", "eps3", "eps_v"})
    if (name == strain || (name.ends_with(strain) && name[name.size() - strain.size() - 1] == '_')) return true;
  return false;
}

Conversion conversion_of(std::string_view name) {
  if (is_strain(name)) return {std::string(name) + "_pct", 100};
  if (!name.ends_with("_Pa") || name.ends_with("_per_Pa")) return {std::string(name), 1};
  std::string const quantity(name.substr(0, name.size() - 3));
  bool const modulus = quantity.find("modulus") != std::string::npos;
  return modulus ? Conversion{quantity + "_MPa", 1e-6} : Conversion{quantity + "_kPa", 1e-3};
}

/// Commas within quotes belong to a cell.
std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  std::size_t begin = 0;
  bool quoted = false;
  for (std::size_t k = 0; k <= line.size(); ++k) {
    if (k < line.size() && line[k] == '"') quoted = !quoted;
    if (k < line.size() && (line[k] != ',' || quoted)) continue;
    cells.push_back(line.substr(begin, k - begin));
    begin = k + 1;
  }
  return cells;
}

std::string converted(std::string_view cell, double factor) {
  double value = 0;
  auto const [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (factor == 1 || cell.empty() || error != std::errc{} || end != cell.data() + cell.size()) return std::string(cell);
  return fmt::format("{:.10g}", value * factor);
}

}  // namespace

std::string spreadsheet_csv(std::string const& csv) {
  std::vector<Conversion> columns;
  std::string text;
  for (std::string_view rest = csv; !rest.empty();) {
    std::size_t const end = std::min(rest.size(), rest.find('\n'));
    std::vector<std::string_view> const cells = cells_of(rest.substr(0, end));
    rest.remove_prefix(std::min(rest.size(), end + 1));
    bool const heading = columns.empty();
    for (std::size_t k = 0; k < cells.size(); ++k) {
      if (heading) columns.push_back(conversion_of(cells[k]));
      if (k > 0) text += ',';
      text += heading ? columns[k].heading : converted(cells[k], k < columns.size() ? columns[k].factor : 1);
    }
    text += '\n';
  }
  return text;
}

}  // namespace clathra
