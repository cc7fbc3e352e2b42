#include "run/stage_progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "machine/interrupt.hpp"
#include "terminal/text.hpp"

namespace clathra {

double Speedometer::seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

std::string Speedometer::text(double fraction, std::int64_t disc_steps) const {
  double const passed = seconds();
  if (disc_steps <= 0 || fraction <= from_) return "...";
  double const left = passed * std::max(0.0, 1 - fraction) / (fraction - from_);
  return fmt::format("{} particle-steps/s | ETA {}", short_count(static_cast<double>(disc_steps) / passed), duration_text(left));
}

ProgressCallback show_stage(ProgressLine& line, Ranks const& ranks) {
  struct Stage {
    std::string name;
    Speedometer speed;
    std::int64_t disc_steps = 0;  // when the stage began
  };
  auto const stage = std::make_shared<Stage>();
  return [&line, stage, ranks](Progress const& progress) {
    if (progress.stage != stage->name) *stage = {progress.stage, Speedometer{progress.fraction}, progress.disc_steps};
    std::string const speed = stage->speed.text(progress.fraction, progress.disc_steps - stage->disc_steps);
    line.show(progress.stage, progress.fraction, progress.detail.empty() ? speed : progress.detail + " | " + speed);
    return !ranks.any(interrupted());
  };
}

}  // namespace clathra
