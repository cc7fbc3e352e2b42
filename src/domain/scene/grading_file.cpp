#include "domain/scene/grading_file.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "domain/scene/foreign_table.hpp"
#include "domain/scene/grading_columns.hpp"
#include "domain/scene/units.hpp"

namespace clathra {
namespace {

constexpr std::size_t largest_file = 1 << 20;  // [bytes]; sieve analyses have a dozen lines

/// A row of a file in the numbers that it holds.
struct Sieve {
  std::size_t line;
  double diameter;  ///< [m]
  double share;     ///< in the unit of the file, or with a percent sign in per cent
};

std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string size_text(Sieve const& sieve) { return number_text(sieve.diameter * 1e3) + " mm"; }
std::string line_text(Sieve const& sieve) { return "line " + std::to_string(sieve.line); }

/// "1,000" and "12,500" but not "0,125": the comma may set apart the thousands.
bool may_be_thousands(std::string_view number) {
  auto const comma = number.find(',');
  return comma > 0 && comma <= 3 && number[0] != '0' && number.size() == comma + 4;
}

/// A cell without its percent sign.
std::string_view bare(std::string_view cell) {
  if (cell.ends_with('%')) cell.remove_suffix(1);
  return cell;
}

/// Puts points for decimal commas, in a file that has no decimal points.
void set_points(ForeignTable& table, std::initializer_list<std::size_t> columns) {
  std::size_t point = 0, comma = 0, decimal = 0;  // first lines of these
  std::string with_comma;
  for (ForeignRow& row : table.rows)
    for (std::size_t const k : columns) {
      std::string& cell = row.cells[k];
      if (point == 0 && cell.find('.') != cell.npos) point = row.line;
      auto const at = cell.find(',');
      if (at == cell.npos) continue;
      if (comma == 0) comma = row.line, with_comma = cell;
      if (decimal == 0 && !may_be_thousands(bare(cell))) decimal = row.line;
      cell[at] = '.';
    }
  if (comma > 0 && point > 0)
    refuse_line(comma, quote_of(with_comma) + " has a comma, line " + std::to_string(point) +
                           " a decimal point: write all numbers with a point");
  if (comma > 0 && decimal == 0)
    refuse_line(comma, quote_of(with_comma) + " may be a thousand times what it is with a decimal comma: write it with a point");
}

double number_of(ForeignRow const& row, std::size_t column, std::string_view cell) {
  try {
    return parse_number(in_ascii(cell));
  } catch (std::invalid_argument const&) {
    refuse_line(row.line, "column " + std::to_string(column + 1) + " needs a number, got " + quote_of(row.cells[column]) +
                              " in " + quote_of(row.text));
  }
}

std::string separator_text(char separator) {
  return separator == '\t' ? "tabs" : separator == ' ' ? "blanks" : quote_of({&separator, 1});
}

/// Each row must have the cells of its header.
void check_cells(ForeignTable const& table, GradingColumns const& columns) {
  std::size_t const names = table.header.cells.size(), needed = std::max(columns.diameter, columns.share) + 1;
  for (ForeignRow const& row : table.rows) {
    if (row.cells.size() >= needed && row.cells.size() <= names) continue;
    std::string const cause = row.cells.size() < needed ? ": the header is cut at " + separator_text(table.separator)
                              : table.separator == ','  ? ": beside decimal commas columns need ';' or tabs between them"
                                                        : "";
    refuse_line(row.line, quote_of(row.text) + " has " + std::to_string(row.cells.size()) + " of " + std::to_string(names) +
                              " cells" + cause);
  }
}

/// The file's rows by size, the coarse or the fine ones first there.
std::vector<Sieve> sieves_of(ForeignTable& table, GradingColumns const& columns) {
  if (table.rows.empty()) refuse_line(table.header.line, "no rows under the header " + quote_of(table.header.text));
  check_cells(table, columns);
  set_points(table, {columns.diameter, columns.share});
  std::vector<Sieve> sieves;
  for (ForeignRow const& row : table.rows) {
    std::string_view const share = bare(row.cells[columns.share]);
    Sieve const sieve{row.line, number_of(row, columns.diameter, row.cells[columns.diameter]) * columns.metre,
                      number_of(row, columns.share, share)};
    if (!(sieve.diameter > 0))
      refuse_line(row.line, "a size must be above 0, got " + quote_of(row.cells[columns.diameter]) +
                                ": give the size below which there is nothing");
    if (!(sieve.share >= 0 && sieve.share <= 100))
      refuse_line(row.line, "what is finer must be 0 to 100 %, got " + quote_of(row.cells[columns.share]));
    sieves.push_back(sieve);
  }
  std::stable_sort(sieves.begin(), sieves.end(), [](Sieve const& a, Sieve const& b) { return a.diameter < b.diameter; });
  return sieves;
}

/// The unit of the shares, which percent signs in the cells may say.
ShareUnit unit_of(ForeignTable const& table, GradingColumns const& columns) {
  for (ForeignRow const& row : table.rows) {
    std::string_view const cell = row.cells[columns.share];
    if (!cell.ends_with('%')) continue;
    if (columns.unit != ShareUnit::fraction) return ShareUnit::percent;
    refuse_line(row.line, quote_of(cell) + " is in per cent, the column " + quote_of(table.header.cells[columns.share]) +
                              " in fractions: name it percent_finer, or write fractions");
  }
  return columns.unit;
}

/// What stands for all grains in the file: 100 or 1.
double whole_of(std::vector<Sieve> const& sieves, ShareUnit unit) {
  Sieve const& most =
      *std::max_element(sieves.begin(), sieves.end(), [](Sieve const& a, Sieve const& b) { return a.share < b.share; });
  if (unit == ShareUnit::percent && most.share <= 1)
    refuse_line(most.line, "no more than " + number_text(most.share) +
                               " % in the whole column: these look like fractions; write per cent, or name it fraction_finer");
  if (unit == ShareUnit::fraction && most.share > 1)
    refuse_line(most.line, "fractions are 0 to 1, got " + number_text(most.share) +
                               ": these look like per cent; name the column percent_finer");
  return most.share <= 1 ? 1 : 100;
}

/// Makes equal rows one. The others must be in an order: one that is not may have a slip in its size.
void order(std::vector<Sieve>& sieves, double percent) {
  for (std::size_t k = 1; k < sieves.size(); ++k) {
    Sieve const &one = sieves[k - 1], &two = sieves[k];
    if (one.diameter == two.diameter && one.share != two.share)
      refuse_line(two.line, size_text(two) + " has " + number_text(two.share * percent) + " % here, " +
                                number_text(one.share * percent) + " % on " + line_text(one) + ": a curve has no vertical step");
  }
  auto const same = [](Sieve const& a, Sieve const& b) { return a.diameter == b.diameter; };
  sieves.erase(std::unique(sieves.begin(), sieves.end(), same), sieves.end());
  bool const coarse_first = sieves.front().line > sieves.back().line;
  for (std::size_t k = 1; k < sieves.size(); ++k) {
    if ((sieves[k - 1].line > sieves[k].line) == coarse_first) continue;
    bool const later = sieves[k].line > sieves[k - 1].line;
    Sieve const &here = sieves[later ? k : k - 1], &before = sieves[later ? k - 1 : k];
    refuse_line(here.line, "the sizes neither grow nor fall from line to line: " + size_text(here) + " here, " +
                               size_text(before) + " on " + line_text(before));
  }
}

/// Nothing is finer than the first size, all than the last; what is finer grows in between. The shares are those that pass.
void check_curve(std::vector<Sieve> const& sieves, double percent) {
  Sieve const &fine = sieves.front(), &coarse = sieves.back();
  auto const passes = [&](Sieve const& sieve) {
    return size_text(sieve) + " lets " + number_text(sieve.share * percent) + " % through";
  };
  for (std::size_t k = 1; k < sieves.size(); ++k)
    if (sieves[k].share < sieves[k - 1].share)
      refuse_line(sieves[k].line, passes(sieves[k]) + ", less than the finer sieve of " + line_text(sieves[k - 1]) + " (" +
                                      passes(sieves[k - 1]) + ")" +
                                      (fine.share > coarse.share ? ": what is finer and what is retained may be mixed up" : ""));
  if (coarse.share * percent != 100)
    refuse_line(coarse.line, "the coarsest sieve of " + passes(coarse) + ": add the size that all pass, with 100 % finer");
  if (fine.share != 0)
    refuse_line(fine.line, "the finest sieve of " + passes(fine) + ": add the size below which there is nothing, with 0 % finer");
}

Grading grading_of(ForeignTable table) {
  ForeignRow const& header = table.header;
  if (header.cells.empty()) refuse_line(0, "is empty: a grading needs a header such as d_mm,percent_finer and rows under it");
  if (std::string_view const first = header.cells[0]; first.find_first_not_of("0123456789.,+-eE") == first.npos)
    refuse_line(header.line, "there is no header above " + quote_of(header.text) + ": put d_mm,percent_finer there" +
                                 (table.comment_above > 0
                                      ? ", or take the '#' of line " + std::to_string(table.comment_above) + " away if that is it"
                                      : ""));
  GradingColumns const columns = find_grading_columns(header);
  std::vector<Sieve> sieves = sieves_of(table, columns);
  double const whole = whole_of(sieves, unit_of(table, columns)), percent = 100 / whole;
  order(sieves, percent);
  if (columns.retained)
    for (Sieve& sieve : sieves) sieve.share = whole - sieve.share;
  check_curve(sieves, percent);
  std::vector<double> diameters, finer;
  for (Sieve const& sieve : sieves) {
    diameters.push_back(sieve.diameter);
    finer.push_back(sieve.share / whole);
  }
  Grading grading(diameters, finer);
  if (!(grading.d50() >= smallest_d50 && grading.d50() <= largest_d50))
    refuse_line(header.line, "half of its grains are finer than " + number_text(grading.d50() * 1e3) +
                                 " mm, no soil is: its sizes are in another unit than the column " +
                                 quote_of(header.cells[columns.diameter]) + " says");
  return grading;
}

}  // namespace

Grading parse_grading(std::string_view text, std::string const& name) {
  try {
    return grading_of(read_foreign_table(text));
  } catch (std::invalid_argument const& problem) {
    throw std::invalid_argument(name + problem.what());
  }
}

Grading read_grading(std::string const& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::invalid_argument("grading file '" + path + "' cannot be read");
  std::string text(largest_file + 1, '\0');
  file.read(text.data(), largest_file + 1);
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (text.size() > largest_file) throw std::invalid_argument(path + ": is larger than 1 MB: no sieve analysis");
  return parse_grading(text, path);
}

}  // namespace clathra
