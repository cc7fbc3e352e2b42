#pragma once
/// From the reports of a stage to the progress line, and from Ctrl-C back to the stage.
#include "domain/parallel/ranks.hpp"
#include "domain/scene/stage.hpp"
#include "terminal/progress_line.hpp"

namespace clathra {

/// A callback for generation and consolidation: shows each report with its rate, and asks to stop after Ctrl-C on any rank.
ProgressCallback show_stage(ProgressLine& line, Ranks const& ranks);

/// Particle-steps per second and the time left, counted from its construction.
class Speedometer {
 public:
  /// @param from  the fraction at which it begins
  explicit Speedometer(double from = 0) : from_(from) {}
  /// "31 M particle-steps/s | ETA 41 s", or "..." while there is too little to tell from.
  std::string text(double fraction, std::int64_t disc_steps) const;
  double seconds() const;

 private:
  double from_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace clathra
