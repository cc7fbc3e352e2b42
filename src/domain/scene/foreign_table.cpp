#include "domain/scene/foreign_table.hpp"

#include <stdexcept>

#include "domain/scene/units.hpp"

namespace clathra {
namespace {

constexpr std::string_view blanks = " \t";

std::string_view without_blanks(std::string_view text) {
  auto const first = text.find_first_not_of(blanks);
  return first == text.npos ? std::string_view() : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// Takes the next line of a text, whichever way it ends.
std::string_view take_line(std::string_view& text) {
  auto const end = text.find_first_of("\r\n");
  std::string_view const line = text.substr(0, end);
  text.remove_prefix(end == text.npos ? text.size() : end + (text.substr(end).starts_with("\r\n") ? 2 : 1));
  return line;
}

/// What is no table of bytes as we read them, by name; without the mark of UTF-8.
std::string_view decoded(std::string_view text) {
  if (text.starts_with("PK\x03\x04")) refuse_line(0, "is a spreadsheet (.xlsx, .ods) or an archive: save it as CSV in UTF-8");
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff")) refuse_line(0, "is in UTF-16: save it as CSV in UTF-8");
  if (text.find('\0') != text.npos) refuse_line(0, "holds bytes of zero, as UTF-16 and binary files do: save it as CSV in UTF-8");
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  return text;
}

char separator_of(std::string_view header) {
  bool within = false;
  std::string outside;
  for (char const c : header) {
    within ^= c == '"';
    if (!within) outside += c;
  }
  for (char const candidate : {'\t', ';', ','})
    if (outside.find(candidate) != outside.npos) return candidate;
  return ' ';
}

/// Takes what stands in quotes at the beginning of a text; two quotes within are one that belongs to it.
std::string take_quoted(std::string_view& text) {
  std::string inside;
  do {
    text.remove_prefix(1);
    auto const end = text.find('"');
    if (end == text.npos) break;
    if (!inside.empty()) inside += '"';
    inside += text.substr(0, end);
    text.remove_prefix(end + 1);
  } while (text.starts_with('"'));
  return inside;
}

std::vector<std::string> cells_of(std::string_view text, char separator, std::size_t line) {
  std::string_view const ends = separator == ' ' ? blanks : std::string_view(&separator, 1);
  std::vector<std::string> cells;
  for (std::size_t end = 0; end != text.npos;) {
    auto const start = text.find_first_not_of(separator == '\t' ? " " : blanks);
    text.remove_prefix(start == text.npos ? text.size() : start);
    bool const in_quotes = text.starts_with('"');
    std::string const inside = in_quotes ? take_quoted(text) : "";
    end = text.find_first_of(ends);
    std::string_view const outside = without_blanks(text.substr(0, end));
    if (in_quotes && !outside.empty())
      refuse_line(line, "a quote has no end on its line, or something behind it: " + quote_of(outside));
    cells.emplace_back(in_quotes ? without_blanks(inside) : outside);
    if (end != text.npos) text.remove_prefix(end + 1);
  }
  while (!cells.empty() && cells.back().empty()) cells.pop_back();
  return cells;
}

/// "#4,4.75,100": what laboratories write for the sieve number 4 looks like a row that somebody left out.
void refuse_sieve_number(ForeignTable const& table, std::string_view text, std::size_t line) {
  auto const behind = text.find_first_not_of("0123456789", 1);
  if (table.header.cells.size() < 3 || behind == 1 || behind == text.npos || text[behind] != table.separator) return;
  refuse_line(line, quote_of(text) +
                        " may be a comment or the row of a sieve number: put a blank behind the '#' of a comment, write a number "
                        "without '#'");
}

}  // namespace

void refuse_line(std::size_t line, std::string const& text) {
  throw std::invalid_argument((line > 0 ? ":" + std::to_string(line) : "") + ": " + text);
}

ForeignTable read_foreign_table(std::string_view text) {
  ForeignTable table;
  text = decoded(text);
  for (std::size_t line = 1; !text.empty(); ++line) {
    std::string_view const whole = take_line(text), shown = without_blanks(whole);
    bool const headed = !table.header.cells.empty();
    if (shown.starts_with('#')) {
      refuse_sieve_number(table, shown, line);
      if (!headed) table.comment_above = line;
      continue;
    }
    if (!headed) table.separator = separator_of(shown);
    ForeignRow row{line, std::string(shown), cells_of(whole, table.separator, line)};
    if (row.cells.empty()) continue;
    (headed ? table.rows.emplace_back() : table.header) = std::move(row);
  }
  return table;
}

}  // namespace clathra
