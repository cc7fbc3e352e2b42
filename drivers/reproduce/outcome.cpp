#include "reproduce/outcome.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "domain/scene/specimen_design.hpp"
#include "io/formats/text_file.hpp"
#include "io/report/paper_report.hpp"
#include "io/results/scored_claims.hpp"
#include "machine/own_program.hpp"
#include "study/study_outcome.hpp"
#include "terminal/print.hpp"
#include "terminal/text.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

std::map<std::string, std::string> facts_of(ReproductionOutcome const& outcome, StudyPlan const& plan) {
  std::string settings, seeds;
  for (std::string const& text : outcome.overrides) settings += (settings.empty() ? "" : "; ") + text;
  for (std::uint64_t const seed : plan.study.seeds) seeds += fmt::format("{}{}", seeds.empty() ? "" : ", ", seed);
  double cost = 0;
  for (MemberResult const& member : plan.members) cost += member.wall_seconds;
  std::map<std::string, std::string> facts{
      {"particles", fmt::format("{}", outcome.size.tests.particles)},
      {"seeds", seeds},
      {"settings", settings.empty() ? "the defaults" : settings},
      {"cost", fmt::format("{} of shearing, were one test sheared after the other", duration_text(cost))},
      {"program", "clathra " + own_version()}};
  if (!outcome.paper.citation.empty()) facts["paper"] = outcome.paper.citation;
  return facts;
}

}  // namespace

ExitCode conclude(StudyPlan const& plan, ReproductionOutcome const& outcome, ProgressLine& line) {
  std::vector<fs::path> folders;
  for (StudyTask const& task : plan.runs) folders.push_back(task.result);
  std::size_t const last = plan.study.groups.size() - 1;
  Scene const scene = member_scene(plan.study, plan.study.groups[last], plan.study.seeds.front()).scene;
  double const d50 = design_sample(scene).grading.d50();
  TestQuantities const numbers = quantities_of_members(plan.study, plan.members, folders, outcome.paper.strains);
  Scorecard const card{outcome.paper.title + ", claim by claim", facts_of(outcome, plan),
                       scored_claims(outcome.paper, numbers, d50)};
  fs::path const& out = plan.study.folder;
  replace_text_file(out / "study.csv", study_csv(plan.study, plan.members));
  replace_text_file(out / "scorecard.md", scorecard_markdown(card));
  replace_text_file(out / "scorecard.json", scorecard_json(card));
  auto const finished = std::count_if(plan.members.begin(), plan.members.end(),
                                      [](MemberResult const& m) { return m.state == MemberState::finished; });
  if (finished > 0)
    write_paper_report({plan.study, plan.members, folders, outcome.paper, card, scene, d50, outcome.data},
                       out / "reproduce.html");
  line.repeat_warnings();
  std::string text = fmt::format("members   {} of {} finished\n", finished, plan.members.size());
  text += failures_text(plan);
  for (Claim const& claim : card.claims)
    text += fmt::format("{:>5}     {:<13} {}\n", "(" + claim.id + ")", name_of(claim.verdict()), claim.words);
  text += fmt::format("claims    {}\nresults   {}\n", tally(card.claims), (out / "scorecard.md").string());
  if (outcome.quick) text += "two small specimens decide little: most claims need the full reproduction, without --quick\n";
  print_result(text);
  bool const failed =
      std::any_of(plan.members.begin(), plan.members.end(), [](MemberResult const& m) { return m.state == MemberState::failed; });
  return failed ? ExitCode::member_failed : finished == std::ssize(plan.members) ? ExitCode::done : ExitCode::to_be_resumed;
}

}  // namespace clathra
