#include "study/study_outcome.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "io/formats/text_file.hpp"
#include "io/report/study_report.hpp"
#include "machine/figure_files.hpp"
#include "study/study_goal.hpp"
#include "terminal/print.hpp"
#include "terminal/text.hpp"

namespace clathra {

namespace {

/// What became of the specimens: "4 made, 1 could not be made, 2 not yet: each for 3 members".
std::string specimens_text(StudyPlan const& plan) {
  std::error_code ignored;
  std::size_t made = 0, failed = 0;
  for (StudyTask const& task : plan.specimens) {
    failed += task.failure.empty() ? 0 : 1;
    made += task.failure.empty() && std::filesystem::exists(task.result, ignored) ? 1 : 0;
  }
  if (made == plan.specimens.size()) return sharing_text(plan);
  std::string text = fmt::format("{}: {} made", sharing_text(plan), made);
  if (failed > 0) text += fmt::format(", {} could not be made", failed);
  std::size_t const waiting = plan.specimens.size() - made - failed;
  return waiting == 0 ? text : text + fmt::format(", {} not yet", waiting);
}

}  // namespace

std::string failures_text(StudyPlan const& plan) {
  std::string text;
  std::vector<bool> said(plan.runs.size());
  for (std::size_t s = 0; s < plan.specimens.size(); ++s) {
    if (plan.specimens[s].failure.empty()) continue;
    std::vector<std::string> members;
    for (std::size_t i = 0; i < plan.runs.size(); ++i)
      if (plan.runs[i].specimen == s && plan.members[i].message == failure_of_specimen(plan.specimens[s]))
        said[i] = true, members.push_back(plan.runs[i].name);
    text += fmt::format("failed    the specimen of {}: {}\n          needed by {}\n", specimen_words(plan, s),
                        plan.specimens[s].failure, listed(members));
  }
  for (std::size_t i = 0; i < plan.members.size(); ++i)
    if (plan.members[i].state == MemberState::failed && !said[i])
      text += fmt::format("failed    {}: {}\n", plan.runs[i].name, plan.members[i].message);
  return text;
}

ExitCode conclude(StudyPlan const& plan, ProgressLine& line) {
  replace_text_file(plan.study.folder / "study.csv", study_csv(plan.study, plan.members));
  std::size_t warnings = 0, warned = 0;
  for (MemberResult const& member : plan.members) warnings += member.warnings.size(), warned += member.warnings.empty() ? 0 : 1;
  auto const count = [&](MemberState state) {
    return std::count_if(plan.members.begin(), plan.members.end(), [state](MemberResult const& m) { return m.state == state; });
  };
  auto const finished = count(MemberState::finished), waiting = count(MemberState::waiting), failed = count(MemberState::failed),
             refused = count(MemberState::refused);
  std::vector<std::filesystem::path> folders;
  for (StudyTask const& task : plan.runs) folders.push_back(task.result);
  std::string drawn;
  if (finished > 0) {
    std::vector<Figure> const figures =
        write_study_report(plan.study, plan.members, folders, plan.study.folder / "study.html", plan.data);
    if (!plan.figures.empty()) drawn = "figures   " + write_figure_files(figures, plan.figures);
  }
  line.repeat_warnings();
  if (warned > 0)
    line.note(fmt::format("warning: {} of {} members have warnings ({} in all); study.csv and study.html list them", warned,
                          finished, warnings));
  std::string text = fmt::format("members   {} finished", finished);
  if (waiting > 0) text += fmt::format(", {} not yet", waiting);
  if (failed > 0) text += fmt::format(", {} failed", failed);
  if (refused > 0) text += fmt::format(", {} refused by guards and left out", refused);
  text += "\nspecimens " + specimens_text(plan) + "\n" + statistics_text(plan) + failures_text(plan) + drawn;
  print_result(text + fmt::format("results   {}\n", (plan.study.folder / (finished > 0 ? "study.html" : "study.csv")).string()));
  return failed > 0 ? ExitCode::member_failed : waiting > 0 ? ExitCode::to_be_resumed : ExitCode::done;
}

}  // namespace clathra
