#include "study/array_jobs.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "domain/scene/stage.hpp"
#include "io/formats/text_file.hpp"
#include "io/results/output_folder.hpp"
#include "machine/processes.hpp"
#include "terminal/print.hpp"

namespace clathra {

ExitCode run_alone(StudyPlan const& plan, SlurmJobs const& jobs, bool specimen, int number) {
  std::vector<StudyTask> const& tasks = specimen ? plan.specimens : plan.runs;
  if (static_cast<std::size_t>(number) > tasks.size())
    throw Refused(fmt::format("the study has {} {}, not {}", tasks.size(), specimen ? "specimens" : "members", number));
  StudyTask const& task = tasks[static_cast<std::size_t>(number) - 1];
  claim_folder(plan.study.folder, "study");
  std::error_code ignored;
  if (!specimen && task.specimen && !std::filesystem::exists(plan.specimens[*task.specimen].result, ignored))
    throw FileProblem(
        ExitCode::file_missing, plan.specimens[*task.specimen].result,
        fmt::format("is not there, which the member {} needs: make it first (--specimen {})", task.name, *task.specimen + 1));
  for (char const* const folder : {"specimens", "members"})
    std::filesystem::create_directories(plan.study.folder / folder, ignored);
  if (specimen && std::filesystem::exists(task.result, ignored))
    return print_result(fmt::format("{} is there\n", task.result.string()));
  std::vector<std::string> command = words_of(jobs.launcher);
  command.push_back(own_path());
  command.insert(command.end(), task.arguments.begin(), task.arguments.end());
  if (jobs.threads > 0) command.insert(command.end(), {"--threads", fmt::format("{}", jobs.threads)});
  if (!specimen) command.insert(command.end(), {"--checkpoint-every", jobs.checkpoint_every});
  if (!specimen && !jobs.most_time.empty()) command.insert(command.end(), {"--max-walltime", jobs.most_time});
  become(command);
}

ExitCode write_script(StudyPlan const& plan, SlurmJobs const& jobs) {
  for (std::string const& file : {jobs.script.string(), jobs.script.string() + ".toml"})
    require_no_file(file, "--slurm names another script");
  claim_folder(plan.study.folder, "study");  // which the jobs work in side by side
  Study study = plan.study;
  std::vector<StudyGroup> groups;
  for (std::size_t g = 0; g < study.groups.size(); ++g)
    if (std::none_of(plan.members.begin(), plan.members.end(),
                     [g](MemberResult const& m) { return m.group == g && is_refused(m); }))
      groups.push_back(study.groups[g]);
  study.groups = std::move(groups);
  StudyPlan script_plan = plan_study(std::move(study));
  add_members(script_plan);
  write_slurm_script(script_plan, jobs);
  return print_result(fmt::format("{}: {} specimens, {} members; submit it with: bash {}\n", jobs.script.string(),
                                  script_plan.specimens.size(), script_plan.runs.size(), shell_word(jobs.script.string())));
}

}  // namespace clathra
