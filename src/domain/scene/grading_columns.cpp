#include "domain/scene/grading_columns.hpp"

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include "domain/scene/units.hpp"

namespace clathra {
namespace {

using Words = std::vector<std::string>;
using Names = std::initializer_list<std::string_view>;

Names const sizes = {"d", "dia", "diam", "diameter", "size", "sieve", "opening", "aperture", "grain", "particle"};
Names const passing = {"finer", "passing", "passed", "pass", "undersize"};
Names const retained = {"retained", "coarser"};
Names const percents = {"percent", "percentage", "pct"};
Names const masses = {"mass", "weight", "wt", "g", "kg", "gram", "grams"};
Names const cumulatives = {"cumulative", "cum", "coarser"};
Names const others = {"mass", "weight", "wt", "volume", "total", "by", "of", "than", "in", "fraction"};
constexpr std::pair<std::string_view, double> lengths[] = {
    {"mm", 1e-3}, {"um", 1e-6}, {"m", 1}, {"micron", 1e-6}, {"microns", 1e-6}};

constexpr std::string_view understood =
    "; understood are d_mm, diameter_mm, size_um, sieve size (mm) and the like for the sizes, percent_finer, % passing, finer, "
    "cumulative_percent_retained and the like for what is finer; put a '#' in front of a title";

bool is_any(std::string_view word, Names names) { return std::find(names.begin(), names.end(), word) != names.end(); }

bool has(Words const& words, Names names) {
  return std::any_of(words.begin(), words.end(), [&](std::string_view word) { return is_any(word, names); });
}

bool has_only(Words const& words, std::initializer_list<Names> lists) {
  return std::all_of(words.begin(), words.end(), [&](std::string_view word) {
    return std::any_of(lists.begin(), lists.end(), [&](Names names) { return is_any(word, names); });
  });
}

/// "Sieve size [mm]" as sieve, size, mm; "% finer" as percent, finer.
Words words_of(std::string_view name) {
  Words words;
  bool within = false;
  for (char c : in_ascii(name)) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    if (c == '\xb5') c = 'u';  // the mu of a file that is not in UTF-8
    bool const letter = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    if (letter && !within) words.emplace_back();
    if (letter) words.back() += c;
    if (c == '%') words.emplace_back("percent");
    within = letter;
  }
  return words;
}

/// The unit of a length that a name states [m], 0 for none.
double length_unit(Words const& words) {
  for (auto const& [name, metre] : lengths)
    if (has(words, {name})) return metre;
  return 0;
}

/// A name that states two units, or one that no column here may have.
void require_one_unit(ForeignRow const& header, std::string const& name) {
  Words const words = words_of(name);
  if (name.find("\xe2\x80\xb0") != name.npos || has(words, {"permille", "promille", "mille"}))
    refuse_line(header.line, quote_of(name) + " is in per mille: write per cent");
  double metre = 0;
  for (std::string const& word : words) {
    double const unit = length_unit({word});
    if (unit == 0) continue;
    if (metre > 0 && unit != metre) refuse_line(header.line, quote_of(name) + " states two units: leave one of them");
    metre = unit;
  }
}

/// A column of sieve numbers beside it states no unit.
bool is_diameter(Words const& words) {
  bool const known = std::all_of(words.begin(), words.end(), [](std::string const& word) {
    return is_any(word, sizes) || is_any(word, {"of", "in"}) || length_unit({word}) > 0;
  });
  return known && length_unit(words) > 0 && (has(words, sizes) || !has(words, {"m"}));
}

bool says_share(Words const& words) { return has(words, percents) || has(words, {"fraction"}); }

/// Masses that pass are no shares of them.
bool is_passing(Words const& words) {
  return has(words, passing) && has_only(words, {passing, percents, cumulatives, others}) &&
         (says_share(words) || !has(words, masses));
}

/// What a sieve and those above it hold; where it is not said to be that, it may be what this sieve alone holds.
bool is_retained(Words const& words) {
  return has(words, retained) && has(words, cumulatives) && says_share(words) &&
         has_only(words, {retained, percents, cumulatives, others});
}

/// The one column of a kind. @return the number of names where there is none
std::size_t find_column(ForeignRow const& header, bool (*is_kind)(Words const&), std::string const& kind) {
  std::size_t found = header.cells.size();
  for (std::size_t k = 0; k < header.cells.size(); ++k) {
    if (!is_kind(words_of(header.cells[k]))) continue;
    if (found < header.cells.size())
      refuse_line(header.line, "both " + quote_of(header.cells[found]) + " and " + quote_of(header.cells[k]) + " name " + kind +
                                   ": leave one of them");
    found = k;
  }
  return found;
}

/// Why no column is one of sizes: a name that comes near.
std::string no_diameter(ForeignRow const& header) {
  for (std::string const& name : header.cells)
    if (has(words_of(name), sizes)) return quote_of(name) + " says no unit of the sizes that is understood (mm, um, m)";
  return "no column says the sizes";
}

/// Why no column is one of what is finer: a name that comes near.
std::string no_share(ForeignRow const& header) {
  for (std::string const& name : header.cells) {
    Words const words = words_of(name);
    if (has(words, retained))
      return quote_of(name) + " may be what each sieve holds for itself: give what passes it, or say cumulative_percent_retained";
  }
  for (std::string const& name : header.cells)
    if (has(words_of(name), masses)) return quote_of(name) + " says masses, not what is finer than each size, in per cent of all";
  return "no column says what is finer than each size";
}

}  // namespace

GradingColumns find_grading_columns(ForeignRow const& header) {
  for (std::string const& name : header.cells) require_one_unit(header, name);
  GradingColumns columns;
  std::size_t const none = header.cells.size();
  std::string const shown = ": the header is " + quote_of(header.text);
  columns.diameter = find_column(header, is_diameter, "the diameter");
  if (columns.diameter == none) refuse_line(header.line, no_diameter(header) + shown + std::string(understood));
  columns.metre = length_unit(words_of(header.cells[columns.diameter]));
  columns.share = find_column(header, is_passing, "what is finer");
  if (columns.share == none) {
    columns.share = find_column(header, is_retained, "what is retained");
    columns.retained = true;
  }
  if (columns.share == none) refuse_line(header.line, no_share(header) + shown + std::string(understood));
  Words const words = words_of(header.cells[columns.share]);
  columns.unit = has(words, percents) ? ShareUnit::percent : has(words, {"fraction"}) ? ShareUnit::fraction : ShareUnit::unsaid;
  return columns;
}

}  // namespace clathra
