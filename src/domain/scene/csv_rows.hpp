#pragma once
/// Comma-separated cells, line by line: the one reader of all our tables. No quotes, no cells over several lines.
#include <string_view>
#include <vector>

namespace clathra {

/// Goes through the lines of a text that outlives it.
class CsvRows {
 public:
  explicit CsvRows(std::string_view text) : rest_(text) {}

  /// Takes the next line that has an end: one without it may still be in writing. @return false where there is none
  bool next() {
    auto const end = rest_.find('\n');
    if (end == rest_.npos) return false;
    split(rest_.substr(0, end));
    rest_.remove_prefix(end + 1);
    return true;
  }
  /// The same, and the text behind the last end of a line counts as one too.
  bool next_or_rest() {
    if (next()) return true;
    if (rest_.empty()) return false;
    split(rest_);
    rest_ = {};
    return true;
  }

  std::size_t line() const { return line_; }  ///< from 1 on
  std::string_view text() const { return text_; }
  std::vector<std::string_view> const& cells() const { return cells_; }

 private:
  void split(std::string_view text) {
    if (text.ends_with('\r')) text.remove_suffix(1);
    text_ = text;
    ++line_;
    cells_.clear();
    for (auto comma = text.find(','); comma != text.npos; comma = text.find(',')) {
      cells_.push_back(text.substr(0, comma));
      text.remove_prefix(comma + 1);
    }
    cells_.push_back(text);
  }

  std::string_view rest_, text_;
  std::vector<std::string_view> cells_;
  std::size_t line_ = 0;
};

}  // namespace clathra
