#include "study/slurm_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "domain/scene/stage.hpp"
#include "io/formats/text_file.hpp"
#include "machine/processes.hpp"
#include "terminal/duration.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

std::string absolute_text(fs::path const& path) { return fs::absolute(path).lexically_normal().string(); }

/// "HH:MM:00", rounded up.
std::string slurm_time(double seconds) {
  auto const minutes = static_cast<long>(std::ceil(seconds / 60));
  return fmt::format("{:02}:{:02}:00", minutes / 60, minutes % 60);
}

}  // namespace

std::string shell_word(std::string const& text) {
  std::string word = "'";
  for (char const c : text) word += c == '\'' ? "'\\''" : std::string(1, c);
  return word + "'";
}

void write_slurm_script(StudyPlan const& plan, SlurmJobs const& jobs) {
  if (plan.study.precision_target)
    throw Refused("--slurm needs members that are known before: leave out 'precision_target' and give 'seeds'");
  fs::path const study = jobs.script.string() + ".toml";
  replace_text_file(study, resolved_study(plan.study), Existing::kept);
  std::vector<std::string> words = {own_path(), "study", absolute_text(study), "--checkpoint-every", jobs.checkpoint_every};
  if (!jobs.most_time.empty()) words.insert(words.end(), {"--max-walltime", jobs.most_time});
  if (jobs.threads > 0) words.insert(words.end(), {"--threads", fmt::format("{}", jobs.threads)});
  if (jobs.allow_mixed) words.push_back("--allow-mixed");
  std::string command;
  for (std::string const& word : words) command += (command.empty() ? "" : " ") + shell_word(word);
  constexpr double usual_time = 24 * 3600;
  double const time = jobs.most_time.empty() ? usual_time : duration_of(jobs.most_time);
  std::string text = fmt::format(
      "#!/bin/bash\n# Written by `clathra study --slurm`. Run it: it submits itself as arrays of jobs. Options of sbatch may "
      "follow:\n"
      "# bash {} --partition=short\nset -euo pipefail\ncd {}\n",
      jobs.script.filename().string(), shell_word(fs::current_path().string()));
  text += fmt::format("script={}\nstudy=({})\nlauncher={}\nfolder={}\n", shell_word(absolute_text(jobs.script)), command,
                      shell_word(jobs.launcher.empty() ? "srun" : jobs.launcher), shell_word(absolute_text(plan.study.folder)));
  text += R"(
# In a job.
case ${1-} in
  --job=specimen | --job=member)
    code=0
    "${study[@]}" "--${1#--job=}" "$SLURM_ARRAY_TASK_ID" --launcher "$launcher" || code=$?
    # It has a checkpoint and goes back into the queue.
    [ $code != 75 ] || scontrol requeue "${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID"
    exit $code
    ;;
  --job=collect) exec "${study[@]}" --collect ;;
esac

mkdir -p "$folder/logs"
# USR1 comes two minutes before the time is over.
)";
  text += fmt::format(
      "job() {{\n  sbatch --parsable --requeue --open-mode=append --signal=USR1@120 --time={} --cpus-per-task={} --mem={}M \\\n",
      slurm_time(time), std::max(1, jobs.threads), static_cast<long>(std::ceil(largest_memory(plan) * 1.2e-6 + 50)));
  text += "    --output=\"$folder/logs/slurm-%x-%a.log\" \"$@\"\n}\n";
  std::string after;
  if (!plan.specimens.empty()) {
    text += fmt::format("specimens=$(job \"$@\" --job-name=specimen --array=1-{} \"$script\" --job=specimen)\n",
                        plan.specimens.size());
    after = " --dependency=afterok:$specimens";
  }
  text +=
      fmt::format("members=$(job \"$@\" --job-name=member --array=1-{}{} \"$script\" --job=member)\n", plan.runs.size(), after);
  text += "collect=$(job \"$@\" --job-name=collect --dependency=afterany:$members \"$script\" --job=collect)\n";
  text += "echo \"members $members, collected by $collect into $folder/study.csv\"\n";
  replace_text_file(jobs.script, text, Existing::kept);
}

}  // namespace clathra
