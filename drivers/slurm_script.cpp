#include "slurm_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "domain/scene/stage.hpp"
#include "duration.hpp"
#include "io/formats/text_file.hpp"
#include "member_processes.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

/// A word for a shell.
std::string shell_word(std::string const& text) {
  std::string word = "'";
  for (char const c : text) word += c == '\'' ? "'\\''" : std::string(1, c);
  return word + "'";
}

/// "HH:MM:00", rounded up.
std::string slurm_time(double seconds) {
  auto const minutes = static_cast<long>(std::ceil(seconds / 60));
  return fmt::format("{:02}:{:02}:00", minutes / 60, minutes % 60);
}

double largest_memory(StudyPlan const& plan) {
  double most = 0;
  for (StudyTask const& task : plan.runs) most = std::max(most, task.memory);
  for (StudyTask const& task : plan.specimens) most = std::max(most, task.memory);
  return most;
}

}  // namespace

void write_slurm_script(StudyPlan const& plan, SlurmJobs const& jobs) {
  if (plan.study.until) throw Refused("--slurm needs members that are known before: leave out 'until' and give 'seeds'");
  std::string study = fmt::format("clathra study {}", shell_word(fs::absolute(jobs.study).lexically_normal().string()));
  for (std::string const& text : jobs.overrides) study += " --set " + shell_word(text);
  if (!jobs.checkpoint_every.empty()) study += " --checkpoint-every " + jobs.checkpoint_every;
  if (!jobs.output.empty()) study += " --output " + shell_word(jobs.output);
  constexpr double usual_time = 24 * 3600;
  double const time = jobs.most_time.empty() ? usual_time : duration_of(jobs.most_time);
  std::string const launcher = jobs.launcher.empty() ? "srun" : jobs.launcher;
  std::string text =
      "#!/bin/bash\n# Written by `clathra study --slurm`. Run it: it submits the arrays. Options of sbatch may follow: bash ";
  text += fmt::format("{} --partition=short\n", jobs.script.filename().string());
  text += "set -euo pipefail\n";
  text += fmt::format("cd {}\nexport PATH={}:$PATH\n", shell_word(fs::current_path().string()),
                      shell_word(fs::path(own_path()).parent_path().string()));
  text += fmt::format("folder={}\nmkdir -p \"$folder/logs\"\n", shell_word(plan.study.folder.string()));
  text += fmt::format("study={}\n", shell_word(study));
  text +=
      "# USR1 comes two minutes before the time is over; a job that ends with 75 has a checkpoint and goes back into the queue.\n"
      "job() { sbatch --parsable --requeue --open-mode=append --signal=USR1@120 " +
      fmt::format("--time={} --cpus-per-task={} --mem={}M \\\n  --output=\"$folder/logs/slurm-%x-%a.log\" \"$@\"; }}\n",
                  slurm_time(time), std::max(1, jobs.threads), static_cast<long>(std::ceil(largest_memory(plan) * 1.2e-6 + 50)));
  text += fmt::format(
      "again='code=$?; [ $code != 75 ] || scontrol requeue ${{SLURM_ARRAY_JOB_ID}}_$SLURM_ARRAY_TASK_ID; exit $code'\n");
  std::string const number = "$SLURM_ARRAY_TASK_ID", with = fmt::format(" --launcher {}", shell_word(launcher));
  std::string after;
  if (!plan.specimens.empty()) {
    text += fmt::format("specimens=$(job \"$@\" --job-name=specimen --array=1-{} --wrap \"$study --specimen \\{}{}; $again\")\n",
                        plan.specimens.size(), number, with);
    after = " --dependency=afterok:$specimens";
  }
  text += fmt::format("members=$(job \"$@\" --job-name=member --array=1-{}{} --wrap \"$study --member \\{}{}; $again\")\n",
                      plan.runs.size(), after, number, with);
  text += "collect=$(job \"$@\" --job-name=collect --dependency=afterany:$members --wrap \"$study --collect\")\n";
  text += fmt::format("echo \"members $members, collected by $collect into $folder/study.csv\"\n");
  replace_text_file(jobs.script, text);
}

}  // namespace clathra
