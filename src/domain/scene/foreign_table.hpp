#pragma once
/// Tables as spreadsheets and laboratories write them: whatever line ends, separators and quotes there are, where they can be
/// told apart. Our own tables are read by CsvRows.
#include <string>
#include <string_view>
#include <vector>

namespace clathra {

/// A line that is neither blank nor a comment.
struct ForeignRow {
  std::size_t line = 0;            ///< in the file, from 1 on
  std::string text;                ///< all of it
  std::vector<std::string> cells;  ///< without the blanks and quotes around them; no empty ones at the end
};

struct ForeignTable {
  ForeignRow header;              ///< the first row; no cells where there is none
  std::vector<ForeignRow> rows;   ///< the others
  char separator = ',';           ///< what the header is cut at; ' ' for any number of blanks
  std::size_t comment_above = 0;  ///< line of the last comment above the header, 0 for none
};

/// Says why a table is not what it should be.
/// @throws std::invalid_argument ":12: text" with the line, or ": text" where that is 0, to follow the name of a file
[[noreturn]] void refuse_line(std::size_t line, std::string const& text);

/// Lines end with LF, CR LF or CR. Lines that begin with '#' are comments. The header decides on the separator: a tab, else a
/// semicolon, else a comma, else blanks. A cell may stand in quotes, within its line.
/// @throws std::invalid_argument as refuse_line()
ForeignTable read_foreign_table(std::string_view text);

}  // namespace clathra
