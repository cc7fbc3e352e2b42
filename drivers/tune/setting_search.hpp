#pragma once
/// Which of several settings of the solver is the cheapest whose measured error lies within a tolerance, and what has to be run
/// to know that.
#include <optional>
#include <utility>
#include <vector>

#include "tune/setting_error.hpp"

namespace clathra {

/// A setting that may be run.
struct Trial {
  double rate = 0;         ///< I
  double cost = 0;         ///< in any unit
  bool on_ladder = false;  ///< in all but the rate as the reference: these carry the extrapolation
  bool failed = false;     ///< it cannot be run
  SeedValues values;       ///< as far as it was run
};

/// Runs to be made: these trials with seeds 1 to `seeds`.
struct RunRequest {
  std::vector<std::size_t> trials;
  int seeds = 0;
};

/// Looks for the fastest rate of the ladder that is within the tolerance, then for the cheapest setting at that rate. A setting
/// is chosen only with its whole 95 % interval within the tolerance, and, as long as there may be more runs, when it is so again
/// with more seeds: who stops at the first good look stops where it is good by chance. All of it follows from the values alone.
class SettingSearch {
 public:
  static constexpr int first_seeds = 5, most_seeds = 60;
  static constexpr std::size_t first_levels = 3;  ///< of the ladder, from the fastest; slower ones only if these do not do

  /// @param trials  two of the ladder at least
  SettingSearch(double tolerance, std::vector<Trial> trials);

  std::vector<Trial>& trials() { return trials_; }
  std::vector<Trial> const& trials() const { return trials_; }
  /// What to run next; nothing where the search is over.
  std::optional<RunRequest> next();
  /// From now on no more seeds and no slower rates: there is no time for them. A slower rate that was asked for and hardly run is
  /// left out again.
  void stop_growing();

  /// The setting that was found; nothing where none is known to be within the tolerance.
  std::optional<std::size_t> choice() const { return choice_; }
  /// The error of a trial that was run.
  std::optional<SettingError> error(std::size_t trial) const { return setting_error(trials_[trial].values, pair()); }
  /// The fastest rate of the ladder that is neither within the tolerance nor beyond it, with the seeds that would tell; nothing
  /// where there is none or no seeds would.
  std::optional<std::pair<std::size_t, int>> undecided() const;
  /// The two slowest rates that were run: the limit rests on them.
  std::size_t slow() const { return ladder_[slowest_]; }
  std::size_t fast() const { return ladder_[slowest_ - 1]; }
  bool trials_of_limit_failed() const { return trials_[slow()].failed || trials_[fast()].failed; }

 private:
  RatePair pair() const { return {trials_[fast()].values, trials_[slow()].values, trials_[fast()].rate / trials_[slow()].rate}; }
  ErrorVerdict verdict(std::size_t trial) const;
  std::optional<RunRequest> more_seeds(std::size_t trial) const;
  std::optional<RunRequest> slower_level();
  void leave_out_slowest();
  std::optional<RunRequest> numerics_at(double rate, std::vector<std::size_t>& candidates) const;
  std::optional<RunRequest> choose(std::size_t level);
  std::optional<RunRequest> confirm(std::size_t trial);
  int seeds() const { return static_cast<int>(trials_[slow()].values.size()); }

  double tolerance_;
  std::vector<Trial> trials_;
  std::vector<std::size_t> ladder_;  // by falling rate
  std::size_t slowest_ = 0;          // place in the ladder
  bool growing_ = true;
  std::optional<std::size_t> choice_;
  std::optional<std::pair<std::size_t, int>> last_analysis_;  // chosen at the last look, with so many seeds
};

}  // namespace clathra
