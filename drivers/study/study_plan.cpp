#include "study/study_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "domain/biaxial/scene_cost.hpp"
#include "domain/measurement/specimen_facts.hpp"
#include "io/errors/problems.hpp"
#include "io/formats/digest.hpp"
#include "io/results/earlier_run.hpp"
#include "io/results/output_folder.hpp"
#include "io/results/specimen_check.hpp"
#include "io/results/specimen_file.hpp"
#include "io/results/specimen_label.hpp"
#include "io/scene/scene_comparison.hpp"
#include "machine/own_program.hpp"
#include "run/forecast.hpp"
#include "terminal/text.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

/// Keys that a specimen read from a file has a say in instead of the scene.
constexpr std::string_view size_keys[] = {
    "specimen.particles", "specimen.void_ratio", "specimen.void_ratio_at",     "specimen.width",
    "specimen.height",    "specimen.generator",  "specimen.compaction_layers", "grading.d50",
    "grading.file",       "grading.table"};

/// Whether the making of a specimen could depend on a key: of one that is to have its void ratio at the start of the test, what
/// it goes through before the test is part of it. What is sheared and written later is not, nor what trades accuracy for speed:
/// settings are compared on the same specimens.
bool is_of_generation(std::string const& key, Scene const& scene) {
  if (key.starts_with("specimen.") || key.starts_with("grading.") || key == "run.seed") return true;
  if (scene.specimen.void_ratio_at == VoidRatioAt::preparation)
    return key == "grains.density" || key == "grains.normal_stiffness" || key == "grains.shear_stiffness";
  if (key == "damping.viscous_ratio") return false;
  return key.starts_with("grains.") || key.starts_with("bond.") || key.starts_with("hydrate.") ||
         key == "test.confining_stress" || key == "test.wall_friction";
}

/// The name of the specimen of a scene: the same for all scenes that make the same one. What the grading's file holds counts,
/// not only what it is called.
std::string specimen_name(Scene const& scene, fs::path const& folder) {
  std::string text;
  for (auto const& [key, value] : scene_texts(scene, folder))
    if (is_of_generation(key, scene)) text += key + "=" + value + "\n";
  if (!scene.grading.file.empty()) text += "grading_digest=" + file_digest(scene.grading.file) + "\n";
  return fmt::format("{}-seed{}", text_digest(text).substr(0, 10), scene.run.seed);
}

std::vector<std::string> with_set(std::vector<std::string> arguments, std::vector<std::string> const& overrides) {
  for (std::string const& text : overrides) arguments.insert(arguments.end(), {"--set", text});
  return arguments;
}

bool is_of_size(std::string const& text) {
  return std::any_of(std::begin(size_keys), std::end(size_keys),
                     [&](std::string_view key) { return text.starts_with(std::string(key) + "="); });
}

/// What a specimen in a file says of the cost of testing it.
SpecimenDesign const& design_of_file(StudyPlan& plan, std::string const& file) {
  auto const found = plan.designs.find(file);
  if (found != plan.designs.end()) return found->second;
  Specimen const specimen = read_specimen(file);
  require_walls(file, specimen);
  return plan.designs.emplace(file, design_of(specimen)).first->second;
}

/// What a member will cost and what its guards say. @throws FileProblem where it reads a specimen that cannot be read
Forecast forecast_of(StudyPlan& plan, Scene const& scene) {
  if (!scene.specimen.is_read()) return forecast(scene, design_sample(scene), 1);
  return forecast(scene, design_of_file(plan, scene.specimen.file), 1);
}

std::size_t specimen_task(StudyPlan& plan, Scene const& scene, std::vector<std::string> const& overrides) {
  fs::path const folder = plan.study.folder / "specimens";
  std::string const name = specimen_name(scene, folder);
  auto const found =
      std::find_if(plan.specimens.begin(), plan.specimens.end(), [&](StudyTask const& task) { return task.name == name; });
  if (found != plan.specimens.end()) return static_cast<std::size_t>(found - plan.specimens.begin());
  StudyTask task;
  task.name = name;
  task.result = folder / (name + ".h5");
  task.log = plan.study.folder / "logs" / (name + ".log");
  std::vector<std::string> making;
  for (std::string const& text : overrides)
    if (std::string const key = text.substr(0, text.find('=')); is_of_generation(key, scene) || key == "run.ignore_guards")
      making.push_back(text);
  task.arguments = with_set({"generate", plan.study.scene.string(), "-o", task.result.string()}, making);
  StageRecord const cost = predict(scene);
  task.disc_steps = cost.at("generation_particle_steps");
  task.memory = cost.at("memory_bytes");
  plan.specimens.push_back(std::move(task));
  return plan.specimens.size() - 1;
}

/// The scene of a member. Where guards refuse it, and nothing else is wrong with it, the plan has what they say of its group.
/// @throws SceneProblems
Scene scene_of_member(StudyPlan& plan, StudyGroup const& group, std::uint64_t seed) {
  try {
    return member_scene(plan.study, group, seed).scene;
  } catch (SceneProblems const& found) {
    std::vector<std::string> why;
    for (Problem const& problem : found.problems) {
      if (problem.severity != Severity::refusal) throw;
      why.push_back(problem.text.substr(0, problem.text.find(ignore_hint)));
    }
    plan.refused[group.name] = std::move(why);
    StudyGroup unguarded = group;
    unguarded.settings.emplace_back("run.ignore_guards", "true");
    Scene scene = member_scene(plan.study, unguarded, seed).scene;
    scene.run.ignore_guards = false;
    return scene;
  }
}

/// Where a problem begins to say in which group it is.
std::size_t group_part(std::string const& text) { return std::min(text.size(), text.rfind(" (in the group")); }

std::string without_group(Problem const& problem) {
  return fmt::format("{}:{}:{}", problem.file, problem.line, problem.text.substr(0, group_part(problem.text)));
}

/// Members that guards refuse cost nothing, nor do specimens that no other member needs.
void leave_out_refused(StudyPlan& plan) {
  std::vector<StudyTask> needed;
  std::map<std::size_t, std::size_t> places;  // in `needed`, of those in plan.specimens
  for (std::size_t i = 0; i < plan.runs.size(); ++i) {
    StudyTask& task = plan.runs[i];
    if (is_refused(plan.members[i])) {
      task.disc_steps = task.memory = task.disk = 0;
      task.specimen.reset();
    } else if (task.specimen) {
      auto const [place, is_new] = places.emplace(*task.specimen, needed.size());
      if (is_new) needed.push_back(plan.specimens[*task.specimen]);
      task.specimen = place->second;
    }
  }
  plan.specimens = std::move(needed);
}

}  // namespace

LoadedScene StudyPlan::scene_of_run(std::size_t member) const {
  std::vector<std::string> const& arguments = runs[member].arguments;
  std::vector<std::string> texts;
  for (std::size_t i = 0; i + 1 < arguments.size(); ++i)
    if (arguments[i] == "--set") texts.push_back(arguments[i + 1]);
  return load_scene(study.scene, texts);
}

StudyPlan plan_study(Study study) {
  StudyPlan plan{std::move(study), {}, {}, {}, {}, {}, {}};
  std::map<SceneTexts, std::vector<std::string>> same;
  std::vector<Problem> problems;
  std::map<std::string, std::size_t> said;  // by how many groups
  std::vector<std::string> read_files;
  for (StudyGroup const& group : plan.study.groups) {
    try {
      Scene const scene = scene_of_member(plan, group, plan.study.seeds.front());
      SceneTexts texts = scene_texts(scene, ".");
      texts["specimen.file"] = scene.specimen.file;
      if (scene.specimen.is_read()) read_files.push_back(group.name);
      same[std::move(texts)].push_back(group.name);
    } catch (SceneProblems const& found) {
      for (Problem const& problem : found.problems)
        if (++said[without_group(problem)] == 1) problems.push_back(problem);
    }
  }
  for (Problem& problem : problems)
    if (said.at(without_group(problem)) == plan.study.groups.size()) problem.text.erase(group_part(problem.text));
  for (auto const& [texts, groups] : same)
    if (groups.size() > 1)
      problems.push_back({plan.study.file.string(), 0, 0, fmt::format("the groups {} are the same scene", listed(groups))});
  if (problems.empty() && !plan.study.seeds_stated && !plan.study.precision_target &&
      read_files.size() == plan.study.groups.size())
    plan.study.seeds.resize(1);
  if (!read_files.empty() && (plan.study.seeds.size() > 1 || plan.study.precision_target))
    problems.push_back(
        {plan.study.file.string(), 0, 0,
         fmt::format("seeds change nothing in the group {}, whose specimen comes from a file: all would be the same "
                     "test. Write seeds = 1, or let specimens be made (specimen.generator)",
                     read_files.front())});
  if (!problems.empty()) throw SceneProblems(std::move(problems));
  return plan;
}

void add_member(StudyPlan& plan, std::size_t group, std::uint64_t seed) {
  StudyGroup const& of = plan.study.groups[group];
  Scene const scene = scene_of_member(plan, of, seed);
  std::vector<std::string> overrides = member_overrides(of, seed);
  StudyTask task;
  task.name = member_name(of, seed);
  task.result = plan.study.folder / "members" / task.name;
  task.log = plan.study.folder / "logs" / (task.name + ".log");
  Forecast const cost = forecast_of(plan, scene);
  task.particles = cost.numbers.at("particles");
  task.disc_steps = cost.numbers.at("particle_steps");
  task.memory = cost.numbers.at("memory_bytes");
  task.disk = cost.numbers.at("disk_bytes");
  task.refusals = plan.refused[of.name];
  if (!scene.run.ignore_guards) task.refusals.insert(task.refusals.end(), cost.refusals.begin(), cost.refusals.end());
  if (!scene.specimen.is_read()) {
    task.specimen = specimen_task(plan, scene, overrides);
    std::erase_if(overrides, is_of_size);
    overrides.insert(overrides.end(), {"specimen.file=" + plan.specimens[*task.specimen].result.string()});
  }
  task.arguments = with_set({"run", plan.study.scene.string(), "--output", task.result.string(), "--resume"}, overrides);
  MemberResult member;
  member.group = group;
  member.seed = seed;
  plan.members.push_back(std::move(member));
  plan.runs.push_back(std::move(task));
}

void add_members(StudyPlan& plan) {
  for (std::size_t group = 0; group < plan.study.groups.size(); ++group)
    for (std::uint64_t const seed : plan.study.seeds) add_member(plan, group, seed);
}

std::string sharing_text(StudyPlan const& plan) {
  std::vector<int> shares(plan.specimens.size());
  int of_files = 0;
  for (std::size_t i = 0; i < plan.runs.size(); ++i) {
    if (is_refused(plan.members[i])) continue;
    ++(plan.runs[i].specimen ? shares[*plan.runs[i].specimen] : of_files);
  }
  auto const for_members = [](int least, int most) {
    return (least < most ? fmt::format("for {} to ", least) : "for ") + fmt::format("{} member{}", most, most == 1 ? "" : "s");
  };
  std::string text;
  if (!shares.empty()) {
    auto const [least, most] = std::minmax_element(shares.begin(), shares.end());
    text = fmt::format("{}, each {}", shares.size(), for_members(*least, *most));
  }
  if (of_files > 0)
    text += fmt::format("{}{} read, {}", text.empty() ? "" : "; ", plan.designs.size(), for_members(of_files, of_files));
  return text;
}

std::string specimen_words(StudyPlan const& plan, std::size_t specimen) {
  auto const first =
      std::find_if(plan.runs.begin(), plan.runs.end(), [&](StudyTask const& run) { return run.specimen == specimen; });
  MemberResult const& member = plan.members[static_cast<std::size_t>(first - plan.runs.begin())];
  std::vector<std::string> const& made_with = plan.specimens[specimen].arguments;
  std::string text;
  for (auto const& [key, value] : plan.study.groups[member.group].settings)
    if (std::find(made_with.begin(), made_with.end(), key + "=" + value) != made_with.end() && groups_differ_in(plan.study, key))
      text += fmt::format("{} = {}, ", key, value);
  return text + fmt::format("seed {}", member.seed);
}

std::string failure_of_specimen(StudyTask const& specimen) { return "its specimen could not be made: " + specimen.failure; }

void heed_guards(StudyPlan& plan, bool skip) {
  std::vector<std::pair<std::string, std::vector<std::string>>> refused;  // what guards say, of which groups
  std::set<std::size_t> groups;
  for (std::size_t i = 0; i < plan.runs.size(); ++i) {
    MemberResult& member = plan.members[i];
    std::string why;
    for (std::string const& refusal : plan.runs[i].refusals) why += (why.empty() ? "" : "; ") + refusal;
    if (why.empty()) continue;
    member.state = MemberState::refused;
    member.message = why;
    if (!groups.insert(member.group).second) continue;
    auto same = std::find_if(refused.begin(), refused.end(), [&](auto const& entry) { return entry.first == why; });
    if (same == refused.end()) same = refused.insert(same, {why, {}});
    same->second.push_back(plan.study.groups[member.group].name);
  }
  bool const all = groups.size() == plan.study.groups.size();
  if (groups.empty() || (skip && !all)) return leave_out_refused(plan);
  std::vector<Problem> problems;
  auto const add = [&](std::string text) {
    problems.push_back({plan.study.file.string(), 0, 0, std::move(text), Severity::refusal});
  };
  for (auto const& [why, names] : refused)
    add(fmt::format("the group{} {} would be refused: {}", names.size() == 1 ? "" : "s", listed(names), why));
  add(fmt::format("{} of {} groups would be refused, so nothing was started: {}--ignore-guards overrides the guards",
                  groups.size(), plan.study.groups.size(), all ? "" : "--skip-refused goes on without them, "));
  throw SceneProblems(std::move(problems));
}

void require_one_program(StudyPlan const& plan) {
  std::set<std::string> programs;
  std::string first;
  std::size_t count = 0;
  auto const look_at = [&](std::string const& program, fs::path const& made) {
    if (program.empty() || program == own_version()) return;
    programs.insert(program);
    if (++count == 1) first = made.string();
  };
  std::error_code ignored;
  for (StudyTask const& task : plan.specimens)
    if (fs::exists(task.result, ignored)) look_at(program_of_specimen(task.result), task.result);
  for (StudyTask const& task : plan.runs)
    if (holds_results(task.result)) look_at(program_of_run(task.result), task.result);
  if (count == 0) return;
  std::string others;
  for (std::string const& program : programs) others += (others.empty() ? "" : ", ") + program;
  throw Refused(
      fmt::format("{}{} made by another program ({}; this is {}): --output names another folder, --allow-mixed takes "
                  "what is there and says in study.csv which program each is of",
                  first, count == 1 ? " was" : fmt::format(" and {} more were", count - 1), others, own_version()));
}

void find_finished(StudyPlan& plan, std::size_t member) {
  StudyTask const& task = plan.runs[member];
  std::error_code ignored;
  if (!fs::exists(task.result / "run.json", ignored)) return;
  if (task.specimen && !fs::exists(plan.specimens[*task.specimen].result, ignored)) return;
  auto const fail = [&](char const* message) {
    plan.members[member].state = MemberState::failed;
    plan.members[member].message = message;
  };
  try {
    Scene const scene = plan.scene_of_run(member).scene;
    EarlierRun const earlier = earlier_run(task.result, scene, input_digests(scene));
    // An extended test has rows at the places of the shorter one: other numbers than one that was asked for at once.
    if (earlier == EarlierRun::to_be_extended)
      throw FileProblem(ExitCode::cannot_create, task.result,
                        "holds a finished run to a smaller test.axial_strain; a study does not extend it: name another folder "
                        "(--output), or remove this one");
    if (earlier == EarlierRun::finished) read_member(plan.members[member], task.result);
  } catch (FileProblem const& problem) {
    fail(problem.what());
  } catch (SceneProblems const& problems) {
    fail(problems.what());
  }
}

void find_all_finished(StudyPlan& plan) {
  for (std::size_t i = 0; i < plan.members.size(); ++i)
    if (plan.members[i].state == MemberState::waiting) find_finished(plan, i);
}

double largest_memory(StudyPlan const& plan) {
  double most = 0;
  for (StudyTask const& task : plan.runs) most = std::max(most, task.memory);
  for (StudyTask const& task : plan.specimens) most = std::max(most, task.memory);
  return most;
}

}  // namespace clathra
