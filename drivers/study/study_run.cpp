#include "study/study_run.hpp"

#include <fmt/format.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "io/formats/text_file.hpp"
#include "machine/interrupt.hpp"
#include "study/study_forecast.hpp"
#include "terminal/status.hpp"
#include "terminal/text.hpp"

namespace clathra {
namespace {

/// Whether a member that reports this stage is beyond its preparation.
bool is_loading(std::string_view stage) { return !stage.empty() && stage != "generate" && stage != "consolidate"; }

namespace fs = std::filesystem;

constexpr auto pause = std::chrono::milliseconds(20);

/// Beside its log.
fs::path status_of(StudyTask const& task) { return fs::path(task.log).replace_extension(".status"); }

}  // namespace

StudyLimits usual_limits(StudyPlan const& plan, int parallel, int threads, std::vector<std::string> launcher) {
  StudyLimits limits;
  limits.launcher = std::move(launcher);
  limits.threads_stated = threads > 0;
  int const cores = static_cast<int>(own_cores().size());
  int const members = static_cast<int>(plan.members.size()) -
                      static_cast<int>(std::count_if(plan.members.begin(), plan.members.end(), is_refused));
  limits.threads = threads > 0 ? threads : std::max(1, cores / std::max(1, members));
  int const most = limits.launcher.empty() ? std::max(1, cores / limits.threads) : 1;
  limits.parallel = parallel > 0 ? parallel : std::min(most, parallel_in_memory(plan));
  return limits;
}

StudyRun::StudyRun(StudyPlan& plan, StudyLimits limits, OutputFolder const& folder)
    : plan_(plan), limits_(std::move(limits)), slot_taken_(static_cast<std::size_t>(limits_.parallel)), cores_(own_cores()) {
  std::error_code ignored;
  for (char const* const part : {"specimens", "members", "logs"}) fs::create_directories(folder / part, ignored);
  if (std::string const warning = folder.lock_warning(); !warning.empty()) line_.warn(warning);
}

void StudyRun::look_at_what_is_there() {
  std::error_code ignored;
  specimen_states_.assign(plan_.specimens.size(), TaskState::waiting);
  run_states_.assign(plan_.runs.size(), TaskState::waiting);
  std::vector<bool> needed(plan_.specimens.size());
  work_ = done_ = 0;
  for (std::size_t i = 0; i < plan_.runs.size(); ++i) {
    if (plan_.members[i].state == MemberState::waiting) {
      find_finished(plan_, i);
      if (plan_.members[i].state == MemberState::failed) note_failure(i);
    }
    MemberState const state = plan_.members[i].state;
    run_states_[i] = state == MemberState::waiting   ? TaskState::waiting
                     : state == MemberState::failed  ? TaskState::failed
                     : state == MemberState::refused ? TaskState::left_out
                                                     : TaskState::done;
    work_ += plan_.runs[i].disc_steps;
    if (run_states_[i] != TaskState::waiting) done_ += plan_.runs[i].disc_steps;
    if (run_states_[i] == TaskState::waiting && plan_.runs[i].specimen) needed[*plan_.runs[i].specimen] = true;
  }
  for (std::size_t i = 0; i < plan_.specimens.size(); ++i) {
    if (!needed[i] || fs::exists(plan_.specimens[i].result, ignored)) specimen_states_[i] = TaskState::done;
    work_ += plan_.specimens[i].disc_steps;
    if (specimen_states_[i] == TaskState::done) done_ += plan_.specimens[i].disc_steps;
  }
  done_before_ = done_;
}

ExitCode StudyRun::run() {
  if (!limits_.allow_mixed) require_one_program(plan_);
  try {
    return run_until_done();
  } catch (...) {
    if (!running_.empty()) stop_members();
    while (!running_.empty()) {  // their checkpoints are what the study goes on from
      while (std::optional<ProcessEnd> const end = ended_process()) running_.erase(end->process);
      std::this_thread::sleep_for(pause);
    }
    throw;
  }
}

void StudyRun::stop_members() {
  stopping_ = true;
  for (auto const& [process, running] : running_) ::kill(process, stop_signal);
  line_.note(fmt::format("clathra: stopping {} member{} with a checkpoint", running_.size(), running_.size() == 1 ? "" : "s"));
}

ExitCode StudyRun::run_until_done() {
  double const begin = clock_seconds();
  if (first_begin_ == 0) first_begin_ = begin;
  begin_ = begin;
  look_at_what_is_there();
  write_table();
  while (true) {
    while (std::optional<ProcessEnd> const end = ended_process()) take(*end);
    if (!stopping_ && (interrupted() || time_is_over())) stop_members();
    while (!stopping_ && start_next()) {
    }
    bool const waits = std::count(run_states_.begin(), run_states_.end(), TaskState::waiting) > 0;  // for a folder in use
    if (running_.empty() && (stopping_ || !waits)) break;
    show();
    std::this_thread::sleep_for(pause);
  }
  write_table();
  return stopping_ ? ExitCode::to_be_resumed : ExitCode::done;
}

bool StudyRun::time_is_over() const { return limits_.most_seconds > 0 && clock_seconds() - first_begin_ > limits_.most_seconds; }

/// Specimens first: others wait for them.
bool StudyRun::start_next() {
  if (std::count(slot_taken_.begin(), slot_taken_.end(), false) == 0) return false;
  if (std::optional<std::size_t> const specimen = next_specimen()) return start(true, *specimen);
  if (std::optional<std::size_t> const member = next_run()) return start(false, *member);
  return false;
}

std::optional<std::size_t> StudyRun::next_specimen() const {
  for (std::size_t i = 0; i < specimen_states_.size(); ++i)
    if (specimen_states_[i] == TaskState::waiting) return i;
  return {};
}

/// The longest of those that can start: a long one that starts last would keep the others' cores idle.
std::optional<std::size_t> StudyRun::next_run() const {
  std::optional<std::size_t> next;
  for (std::size_t i = 0; i < run_states_.size(); ++i) {
    if (run_states_[i] != TaskState::waiting) continue;
    if (std::optional<std::size_t> const specimen = plan_.runs[i].specimen)
      if (specimen_states_[*specimen] != TaskState::done) continue;
    if (folder_in_use(plan_.runs[i].result)) continue;  // a member of a study that was killed still writes its checkpoint
    if (!next || plan_.runs[i].disc_steps > plan_.runs[*next].disc_steps) next = i;
  }
  return next;
}

bool StudyRun::start(bool specimen, std::size_t task) {
  Running running;
  running.specimen = specimen;
  running.task = task;
  running.slot = static_cast<std::size_t>(std::find(slot_taken_.begin(), slot_taken_.end(), false) - slot_taken_.begin());
  StudyTask const& what = task_of(running);
  std::vector<std::string> command = limits_.launcher;
  command.push_back(own_path());
  command.insert(command.end(), what.arguments.begin(), what.arguments.end());
  std::vector<int> cores;
  if (limits_.launcher.empty() || limits_.threads_stated)
    command.insert(command.end(), {"--threads", fmt::format("{}", limits_.threads)});
  if (limits_.launcher.empty()) {
    auto const threads = static_cast<std::size_t>(limits_.threads), first = running.slot * threads;
    if (first + threads <= cores_.size())
      cores.assign(cores_.begin() + static_cast<std::ptrdiff_t>(first),
                   cores_.begin() + static_cast<std::ptrdiff_t>(first + threads));
  }
  if (!specimen) command.insert(command.end(), limits_.options.begin(), limits_.options.end());
  command.insert(command.end(), {"--status", status_of(what).string()});
  std::error_code ignored;
  fs::remove(status_of(what), ignored);  // of an earlier try
  (specimen ? specimen_states_ : run_states_)[task] = TaskState::running;
  try {
    running_[start_process(command, what.log, cores)] = running;
    slot_taken_[running.slot] = true;
  } catch (std::runtime_error const& problem) {
    fail(running, problem.what());
  }
  return true;
}

void StudyRun::take(ProcessEnd const& end) {
  auto const found = running_.find(end.process);
  if (found == running_.end()) return;
  Running const was = found->second;
  running_.erase(found);
  slot_taken_[was.slot] = false;
  take_end(was, end);
}

void StudyRun::take_end(Running const& was, ProcessEnd const& end) {
  StudyTask const& task = task_of(was);
  TaskState& state = (was.specimen ? specimen_states_ : run_states_)[was.task];
  bool const stopped = end.signal != 0 || end.code == static_cast<int>(ExitCode::to_be_resumed) ||
                       end.code == static_cast<int>(ExitCode::interrupted) || end.code >= 128;  // a launcher's way to say signal
  if (stopped && stopping_) {
    state = TaskState::waiting;
  } else if (stopped && tried_again_.insert(task.name).second) {
    state = TaskState::waiting;
    line_.note(fmt::format("clathra: {} was stopped{}, it {}", words_of(was),
                           end.signal != 0 ? fmt::format(" by signal {}", end.signal) : "",
                           was.specimen ? "is made once more" : "goes on from its checkpoint"));
  } else if (end.signal != 0) {
    fail(was, fmt::format("killed by signal {}, again when it was tried once more", end.signal));
  } else if (end.code != 0) {
    std::string const failed = read_status(status_of(task)).failed;
    fail(was, failed.empty() ? fmt::format("ended with exit code {}; its log is {}", end.code, task.log.string()) : failed);
  } else {
    take_result(was);
  }
}

void StudyRun::take_result(Running const& was) {
  StudyTask const& task = task_of(was);
  if (!was.specimen) try {
      read_member(plan_.members[was.task], task.result);
    } catch (FileProblem const& problem) {
      return fail(was, problem.what());
    }
  (was.specimen ? specimen_states_ : run_states_)[was.task] = TaskState::done;
  done_ += task.disc_steps;
  if (!was.specimen) write_table();
}

void StudyRun::fail(Running const& was, std::string const& message) {
  (was.specimen ? specimen_states_ : run_states_)[was.task] = TaskState::failed;
  done_ += task_of(was).disc_steps;
  if (was.specimen) {
    fail_specimen(was.task, message);
  } else {
    plan_.members[was.task].state = MemberState::failed;
    plan_.members[was.task].message = message;
    note_failure(was.task);
  }
  write_table();
}

/// And all members that wait for it.
void StudyRun::fail_specimen(std::size_t specimen, std::string const& message) {
  plan_.specimens[specimen].failure = message;
  std::size_t count = 0;
  for (std::size_t i = 0; i < plan_.runs.size(); ++i) {
    if (plan_.runs[i].specimen != specimen || run_states_[i] != TaskState::waiting) continue;
    run_states_[i] = TaskState::failed;
    done_ += plan_.runs[i].disc_steps;
    plan_.members[i].state = MemberState::failed;
    plan_.members[i].message = failure_of_specimen(plan_.specimens[specimen]);
    ++count;
  }
  line_.note(fmt::format("clathra: the specimen of {} could not be made; {} member{} need{} it", specimen_words(plan_, specimen),
                         count, count == 1 ? "" : "s", count == 1 ? "s" : ""));
}

/// Why, the summary says at the end, and study.csv from now on.
void StudyRun::note_failure(std::size_t member) { line_.note(fmt::format("clathra: {} failed", plan_.runs[member].name)); }

std::string StudyRun::words_of(Running const& running) const {
  return running.specimen ? "the specimen of " + specimen_words(plan_, running.task) : task_of(running).name;
}

void StudyRun::write_table() const { replace_text_file(plan_.study.folder / "study.csv", study_csv(plan_.study, plan_.members)); }

void StudyRun::show() {
  constexpr double interval = 0.5;  // [s]
  double const time = clock_seconds();
  if (time - last_shown_ < interval) return;
  last_shown_ = time;
  double done = done_;
  for (auto& [process, running] : running_) {
    if (!running.specimen)
      if (RunStatus const status = read_status(status_of(task_of(running))); is_loading(status.stage))
        running.fraction = std::max(running.fraction, status.fraction);
    done += running.fraction * task_of(running).disc_steps;
  }
  auto const count = [&](TaskState state) { return std::count(run_states_.begin(), run_states_.end(), state); };
  auto const finished = count(TaskState::done), failed = count(TaskState::failed);
  double const rate = (done - done_before_) / (time - begin_);
  std::string text = fmt::format("{}/{} members", finished, std::ssize(run_states_) - count(TaskState::left_out));
  if (failed > 0) text += fmt::format(", {} failed", failed);
  if (running_.size() == 1) text += " | " + words_of(running_.begin()->second);
  if (running_.size() > 1) text += fmt::format(" | {} running", running_.size());
  if (rate > 0 && done - done_before_ > 0.01 * work_) text += " | ETA " + duration_text((work_ - done) / rate);
  line_.show("study", work_ > 0 ? done / work_ : 1, text);
}

}  // namespace clathra
