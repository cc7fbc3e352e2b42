#include "io/scene/scene_guard.hpp"

#include <fmt/format.h>

#include <cctype>

#include "domain/scene/utf8.hpp"

namespace clathra {
namespace {

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-'; }

/// True where the word `nan` or `inf` stands at `at`.
bool is_not_finite(std::string_view line, std::size_t at) {
  std::string_view const word = line.substr(at, 3);
  if (word != "nan" && word != "inf") return false;
  if (at > 0 && is_word(line[at - 1]) && line[at - 1] != '-') return false;
  return at + 3 >= line.size() || !is_word(line[at + 3]);
}

/// What is wrong with a text that begins with a byte order mark, or nothing.
std::string byte_order_mark(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) return "begins with a byte order mark: save it as UTF-8 without one, or as ASCII";
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff")) return "is UTF-16 text: save it as UTF-8, or as ASCII";
  return {};
}

constexpr int most_dots = 8;  // of a dotted name: each is a table in a table for a parser that calls itself

/// Checks one line, appends it to the result with its comment blanked out. Reports the first problem only.
/// One loop over the characters with the state of the quotes; cutting it up would hide that.
void guard_line(std::string_view line, int number, std::string const& file, GuardedText& result) {
  char quote = 0;
  int dots = 0;  // since what separates names and values
  bool comment = false, escaped = false, reported = false;
  auto const report = [&](std::size_t at, std::string text) {
    if (!reported) result.problems.push_back({file, number, static_cast<int>(at) + 1, std::move(text)});
    reported = true;
  };
  if (line.size() > longest_scene_line)
    report(longest_scene_line, fmt::format("the line has {} bytes, at most {} are allowed", line.size(), longest_scene_line));
  for (std::size_t i = 0; i < line.size() && !reported; ++i) {
    char const c = line[i];
    bool const end_of_line = c == '\r' && i + 1 == line.size();
    if (!comment && quote == 0 && c == '#') comment = true;
    result.text += comment && !end_of_line ? ' ' : c;
    if (comment || end_of_line) continue;
    std::size_t const bytes = utf8_length(line, i);
    if (bytes == 0)
      report(i, "the text is not UTF-8");
    else if (bytes > 1 && quote == 0)
      report(i, "only ASCII characters are allowed outside quotes and comments");
    else if (bytes > 1)
      result.text += line.substr(i + 1, bytes - 1), i += bytes - 1;
    else if ((c < ' ' && c != '\t') || c > '~')
      report(i, "control characters are not allowed");
    else if (quote == 0 && (line.substr(i, 3) == "\"\"\"" || line.substr(i, 3) == "'''"))
      report(i, "a scene has no multi-line strings");
    else if (quote == 0 && is_not_finite(line, i))
      report(i, "nan and inf are not allowed");
    else if (quote == 0 && (c == '.' ? ++dots : dots) > most_dots)
      report(i, fmt::format("a name has at most {} dots", most_dots));
    else if (quote == 0 && (c == '"' || c == '\''))
      quote = c;
    else if (c == quote && !escaped)
      quote = 0;
    if (quote == 0 && std::string_view("=,[]{}").find(c) != std::string_view::npos) dots = 0;
    escaped = quote == '"' && c == '\\' && !escaped;
  }
}

}  // namespace

GuardedText guard_scene_text(std::string_view text, std::string const& file) {
  GuardedText result;
  if (text.size() > largest_scene_file) {
    result.problems.push_back({file, 0, 0, fmt::format("has {} bytes, at most {} are allowed", text.size(), largest_scene_file)});
    return result;
  }
  if (std::string const mark = byte_order_mark(text); !mark.empty()) {
    result.problems.push_back({file, 1, 1, mark});
    return result;
  }
  result.text.reserve(text.size());
  int number = 1;
  for (std::size_t start = 0; start <= text.size(); ++number) {
    std::size_t const end = std::min(text.find('\n', start), text.size());
    guard_line(text.substr(start, end - start), number, file, result);
    if (end < text.size()) result.text += '\n';
    start = end + 1;
  }
  return result;
}

}  // namespace clathra
