#pragma once
/// A stage of a run: how it reports, how it ends early, what numbers it leaves.
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>

namespace clathra {

/// Told now and then how far a long stage is; returns false to stop it (Ctrl-C). `fraction` runs from 0 to 1 within the stage.
struct Progress {
  std::string stage;  ///< "generate", "consolidate", "shear"
  double fraction = 0;
  std::string detail;           ///< a few words on the present state ("layer 3/5, e 0.251")
  std::int64_t disc_steps = 0;  ///< disc-steps done in this stage, for the rate
};
using ProgressCallback = std::function<bool(Progress const&)>;

/// Thrown where a guard refuses a scene or target (unreachable void ratio, not quasi-static): the text says what, with numbers.
struct Refused : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// Ends the text of a refusal that a scene can overrule.
inline constexpr char ignore_hint[] = " (run.ignore_guards = true or --ignore-guards runs it anyway)";
/// Begins the warning that stands in its place where it was.
inline constexpr char guard_ignored[] = "guard ignored: ";

/// Thrown where a forecast asks for more memory than there is.
struct OutOfMemory : std::runtime_error {
  using std::runtime_error::runtime_error;
};
struct Snapshot;

/// The state diverged or left the range of the model; the text names disc, step and cause.
struct Diverged : std::runtime_error {
  using std::runtime_error::runtime_error;
  Diverged(std::string const& text, double at_x, double at_y) : std::runtime_error(text), x(at_x), y(at_y), placed(true) {}
  double x = 0, y = 0;                               ///< of the disc [m]
  bool placed = false;                               ///< whether it is known where
  std::shared_ptr<Snapshot const> around = nullptr;  ///< this rank's part of the state around it, where somebody took it
};
/// Thrown when the progress callback asked to stop.
struct Stopped : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Named numbers of a stage, for run.json and the screen.
using StageRecord = std::map<std::string, double>;

/// Passes a report on, if anybody listens. @throws Stopped where the listener says so
inline void report(ProgressCallback const& callback, Progress const& progress) {
  if (callback && !callback(progress)) throw Stopped("stopped during '" + progress.stage + "'");
}

}  // namespace clathra
