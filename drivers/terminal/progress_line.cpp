#include "terminal/progress_line.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string_view>

#include "domain/parallel/ranks.hpp"
#include "io/errors/printable.hpp"
#include "terminal/print.hpp"
#include "terminal/status.hpp"

namespace clathra {
namespace {

constexpr auto terminal_interval = std::chrono::milliseconds(200);
constexpr auto line_interval = std::chrono::seconds(60);
constexpr int percents_a_line = 5;

std::size_t terminal_width() {
  winsize size = {};
  return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 20 ? size.ws_col : 80;
}

/// A terminal on which a line can be rewritten.
bool is_terminal() {
  char const* const kind = std::getenv("TERM");
  return ::isatty(STDERR_FILENO) == 1 && !(kind && std::string_view(kind) == "dumb");
}

/// stderr may be closed or full: nothing that happens to it may stop a run.
void put(std::string const& text) {
  if (launched_rank() != 0) return;  // of several ranks the first one speaks
  ssize_t const written = ::write(STDERR_FILENO, text.data(), text.size());
  (void)written;
}

}  // namespace

ProgressLine::ProgressLine() : terminal_(is_terminal()), last_(Clock::now()) {
  char const* const no_colour = std::getenv("NO_COLOR");
  colour_ = terminal_ && !(no_colour && *no_colour);
}

ProgressLine::~ProgressLine() { erase(); }

void ProgressLine::erase() {
  if (line_shown_) put("\r\033[K");
  line_shown_ = false;
}

std::string ProgressLine::coloured(std::string const& text, char const* code) const {
  return colour_ ? fmt::format("\033[{}m{}\033[0m", code, text) : text;
}

void ProgressLine::show(std::string const& stage, double fraction, std::string const& text) {
  say_status(stage, fraction);
  if (is_quiet()) return;
  auto const now = Clock::now();
  int const percent = static_cast<int>(std::lround(100 * std::clamp(fraction, 0.0, 1.0))), mark = percent / percents_a_line;
  bool const new_stage = stage != stage_;
  if (new_stage) stage_ = stage, last_mark_ = -1;
  bool const due = terminal_ ? now - last_ >= terminal_interval : mark > last_mark_ || now - last_ >= line_interval;
  if (!new_stage && !due) return;
  last_ = now;
  last_mark_ = std::max(last_mark_, mark);
  std::string line = fmt::format("{} {}% {}", stage, percent, text);
  if (!terminal_) return put(line + "\n");
  line.resize(std::min(line.size(), terminal_width() - 1));
  put("\r\033[K" + line);
  line_shown_ = true;
}

void ProgressLine::put_line(std::string const& begin, std::string const& text) {
  erase();
  put(begin + printable(text) + "\n");  // a file's name in it may hold control characters
}

void ProgressLine::note(std::string const& text) { put_line("", text); }

void ProgressLine::warn(std::string const& text) {
  if (std::find(warnings_.begin(), warnings_.end(), text) != warnings_.end()) return;
  warnings_.push_back(text);
  put_line(coloured("warning: ", "33"), text);
}

void ProgressLine::repeat_warnings() {
  if (warnings_.empty()) return;
  note(fmt::format("{} warning{}:", warnings_.size(), warnings_.size() == 1 ? "" : "s"));
  for (std::string const& text : warnings_) put_line(coloured("  - ", "33"), text);
}

}  // namespace clathra
