#pragma once
/// The members of a study, side by side on the cores there are.
#include <map>
#include <set>
#include <string>
#include <vector>

#include "io/errors/problems.hpp"
#include "io/results/output_folder.hpp"
#include "machine/processes.hpp"
#include "study/study_plan.hpp"
#include "terminal/progress_line.hpp"

namespace clathra {

struct StudyLimits {
  int parallel = 1;                   ///< programs at a time
  int threads = 1;                    ///< of each
  bool threads_stated = false;        ///< else what is behind a launcher has as many as the launcher gives it
  std::vector<std::string> launcher;  ///< "mpirun", "-n", "4": before each program; the cores are its affair then
  std::vector<std::string> options;   ///< of `clathra run` for all members
  double most_seconds = 0;            ///< stop then, members with a checkpoint; 0 = never
  bool allow_mixed = false;           ///< take what another program made
};

/// Programs at a time and threads of each: by default one thread for each member, which is the most work that cores can do, and
/// more threads only where there are fewer members than cores. @param parallel,threads  0: the default
StudyLimits usual_limits(StudyPlan const& plan, int parallel, int threads, std::vector<std::string> launcher);

class StudyRun {
 public:
  /// @param folder  of the study, which it holds
  StudyRun(StudyPlan& plan, StudyLimits limits, OutputFolder const& folder);
  /// Runs all tasks that have not been done, as far as that is possible. A member that fails is named and left, the others go on;
  /// one that a signal killed is tried once more, from its checkpoint. Writes study.csv after each.
  /// @return done, also where members failed; to_be_resumed where a signal or the wall time stopped it
  /// @throws Refused where there is something of another program; FileProblem where study.csv cannot be written. Whatever it
  /// throws, the members are stopped with a checkpoint before.
  ExitCode run();
  /// Lines on stderr.
  ProgressLine& line() { return line_; }

 private:
  struct Running {
    std::size_t slot = 0, task = 0;
    bool specimen = false;
    double fraction = 0;  ///< done
  };
  enum class TaskState { waiting, running, done, failed, left_out };

  StudyTask const& task_of(Running const& running) const {
    return running.specimen ? plan_.specimens[running.task] : plan_.runs[running.task];
  }
  void look_at_what_is_there();
  ExitCode run_until_done();
  void stop_members();
  bool start_next();
  bool start(bool specimen, std::size_t task);
  std::optional<std::size_t> next_specimen() const;
  std::optional<std::size_t> next_run() const;
  void take(ProcessEnd const& end);
  void take_end(Running const& was, ProcessEnd const& end);
  void take_result(Running const& was);
  std::string words_of(Running const& running) const;
  void fail(Running const& was, std::string const& message);
  void fail_specimen(std::size_t specimen, std::string const& message);
  void note_failure(std::size_t member);
  void write_table() const;
  void show();
  bool time_is_over() const;

  StudyPlan& plan_;
  StudyLimits limits_;
  ProgressLine line_;
  std::vector<TaskState> specimen_states_, run_states_;
  std::map<pid_t, Running> running_;
  std::set<std::string> tried_again_;
  std::vector<bool> slot_taken_;
  std::vector<int> cores_;
  double work_ = 0, done_ = 0, done_before_ = 0;         ///< predicted particle-steps
  double first_begin_ = 0, begin_ = 0, last_shown_ = 0;  ///< [s]
  bool stopping_ = false;
};

}  // namespace clathra
