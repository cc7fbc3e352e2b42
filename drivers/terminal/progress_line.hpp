#pragma once
/// How far a run is, on stderr: on a terminal one line that is rewritten, else a line every 5 % or 60 s.
#include <chrono>
#include <string>
#include <vector>

namespace clathra {

class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine();

  /// @param stage  begins a new count of percents;  @param fraction  0 to 1;  @param text  shown after the percentage
  void show(std::string const& stage, double fraction, std::string const& text);
  /// A line of its own, above the progress.
  void note(std::string const& text);
  /// A warning, shown now and again by repeat_warnings().
  void warn(std::string const& text);
  std::vector<std::string> const& warnings() const { return warnings_; }
  void repeat_warnings();

 private:
  using Clock = std::chrono::steady_clock;
  void erase();
  void put_line(std::string const& begin, std::string const& text);
  std::string coloured(std::string const& text, char const* code) const;

  bool terminal_, colour_, line_shown_ = false;
  std::string stage_;
  int last_mark_ = -1;  ///< in steps of 5 %
  Clock::time_point last_;
  std::vector<std::string> warnings_;
};

}  // namespace clathra
