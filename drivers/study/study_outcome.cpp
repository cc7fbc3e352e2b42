#include "study/study_outcome.hpp"

#include <fmt/format.h>

#include "io/formats/text_file.hpp"
#include "io/report/study_report.hpp"
#include "machine/figure_files.hpp"
#include "study/study_goal.hpp"
#include "terminal/print.hpp"

namespace clathra {

ExitCode conclude(StudyPlan const& plan, ProgressLine& line) {
  replace_text_file(plan.study.folder / "study.csv", study_csv(plan.study, plan.members));
  std::vector<std::string> failed;
  std::size_t finished = 0, waiting = 0, refused = 0, warnings = 0, warned = 0;
  for (std::size_t i = 0; i < plan.members.size(); ++i) {
    MemberResult const& member = plan.members[i];
    if (member.state == MemberState::failed) failed.push_back(plan.runs[i].name + ": " + member.message);
    refused += member.state == MemberState::refused ? 1 : 0;
    warnings += member.warnings.size(), warned += member.warnings.empty() ? 0 : 1;
    finished += member.state == MemberState::finished ? 1 : 0;
    waiting += member.state == MemberState::waiting ? 1 : 0;
  }
  std::vector<std::filesystem::path> folders;
  for (StudyTask const& task : plan.runs) folders.push_back(task.result);
  std::string drawn;
  if (finished > 0) {
    std::vector<Figure> const figures = write_study_report(plan.study, plan.members, folders, plan.study.folder / "study.html");
    if (!plan.figures.empty()) drawn = "figures   " + write_figure_files(figures, plan.figures);
  }
  line.repeat_warnings();
  if (warned > 0)
    line.note(fmt::format("warning: {} of {} members have warnings ({} in all); study.csv and study.html list them", warned,
                          plan.members.size(), warnings));
  std::string text = fmt::format("members   {} finished", finished);
  if (waiting > 0) text += fmt::format(", {} not yet", waiting);
  if (!failed.empty()) text += fmt::format(", {} failed", failed.size());
  if (refused > 0) text += fmt::format(", {} refused by guards and left out", refused);
  text += "\nspecimens " + sharing_text(plan) + "\n" + statistics_text(plan);
  for (std::string const& member : failed) text += "failed    " + member + "\n";
  print_result(text + drawn +
               fmt::format("results   {}\n", (plan.study.folder / (finished > 0 ? "study.html" : "study.csv")).string()));
  return !failed.empty() ? ExitCode::member_failed : waiting > 0 ? ExitCode::to_be_resumed : ExitCode::done;
}

}  // namespace clathra
