#pragma once
/// The search for the cheapest setting of a scene, and the tests that it asks for.
#include <string>

#include "io/results/output_folder.hpp"
#include "study/study_run.hpp"
#include "tune/setting_search.hpp"
#include "tune/tune_plan.hpp"

namespace clathra {

struct TuneLimits {
  double budget = 600;       ///< time that the runs may take [s]
  int parallel = 0;          ///< runs at a time; 0 = the default
  bool allow_mixed = false;  ///< take what another program made
};

class Tuning {
 public:
  /// Finds what earlier calls have run. @param plan  of the settings that may be tried
  Tuning(TunePlan plan, TuneLimits const& limits);
  /// @return done, also where nothing was found; to_be_resumed where a signal stopped it
  ExitCode run(OutputFolder const& folder);
  /// Settings by cost, with what was measured of each.
  std::string table() const;
  SettingSearch const& search() const { return search_; }
  TunePlan const& plan() const { return plan_; }
  /// Whether some test ended before its q fell: then its peak is only the largest q.
  bool misses_peaks() const;
  /// Tests that have a result, those of earlier calls included.
  std::size_t tests_made() const;
  double budget() const { return budget_; }  ///< [s]
  /// Whether the time allowed was too short for what the search would have run next.
  bool out_of_time() const { return out_of_time_; }
  /// Why there is no choice, and what would give one.
  std::string undetermined() const;

 private:
  /// Particle-steps a second of one thread.
  double speed_of(Precision precision) const;
  std::size_t values_of(std::size_t trial) const { return search_.trials()[trial].values.size(); }
  /// Masses scaled further than usual, which a guard may refuse at the rate, are tried with one seed first.
  void add(RunRequest const& request);
  bool has_member(std::size_t trial, std::uint64_t seed) const;
  void take_results();
  /// Wall time of one run of a setting: as measured, else by prediction.
  double seconds_of(std::size_t trial) const;
  double disc_steps_of(std::size_t trial) const;
  /// Of what is not run yet.
  double seconds_of(RunRequest const& request) const;
  bool has_result(std::size_t trial, std::uint64_t seed) const;
  bool fits(RunRequest const& request) const;

  TunePlan plan_;
  SettingSearch search_;
  std::vector<std::string> failures_;
  StudyLimits limits_;
  RunRequest request_;  // the first one
  double budget_, begin_, speed_ = 1;
  bool out_of_time_ = false;
};

}  // namespace clathra
