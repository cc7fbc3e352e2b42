#include "study_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "domain/biaxial/scene_cost.hpp"
#include "io/errors/problems.hpp"
#include "io/formats/digest.hpp"
#include "io/results/earlier_run.hpp"
#include "io/results/specimen_file.hpp"
#include "io/scene/scene_comparison.hpp"
#include "scene_options.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

/// Keys that a specimen read from a file has a say in instead of the scene.
constexpr std::string_view size_keys[] = {"sample.particles", "sample.void_ratio", "sample.width", "sample.height",
                                          "grading.d50"};

/// Whether the making of a specimen could depend on a key. What is sheared, bonded and written later is not part of it, nor what
/// trades accuracy for speed: settings are compared on the same specimens.
bool is_of_generation(std::string const& key) {
  if (key.starts_with("bond.")) return key == "bond.stress";
  if (key.starts_with("run.")) return key == "run.seed";
  if (key == "grains.contact_damping") return false;
  return !key.starts_with("hydrate.") && !key.starts_with("test.") && !key.starts_with("output.");
}

/// The name of the specimen of a scene: the same for all scenes that make the same one.
std::string specimen_name(Scene const& scene, fs::path const& folder) {
  std::string text;
  for (auto const& [key, value] : scene_texts(scene, folder))
    if (is_of_generation(key)) text += key + "=" + value + "\n";
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

/// The overrides of a member, without those that its specimen decides.
std::vector<std::string> overrides_of(StudyPlan const& plan, std::size_t group, std::uint64_t seed) {
  std::vector<std::string> all = plan.overrides;
  for (auto const& [key, value] : plan.study.groups[group].settings) all.push_back(key + "=" + value);
  all.push_back(fmt::format("run.seed={}", seed));
  return all;
}

/// The scene with the size of the specimen that it reads.
Scene sized(StudyPlan& plan, Scene const& scene) {
  auto found = plan.sizes.find(scene.sample.file);
  if (found == plan.sizes.end()) {
    Specimen const specimen = read_specimen(scene.sample.file);
    SpecimenSize size{{}, static_cast<std::int64_t>(specimen.size())};
    size.outline.left = specimen.left, size.outline.right = specimen.right;
    size.outline.bottom = specimen.bottom, size.outline.top = specimen.top;
    size.outline.void_ratio = specimen.void_ratio;
    found = plan.sizes.emplace(scene.sample.file, std::move(size)).first;
  }
  return sized_by(scene, found->second.outline, found->second.discs);
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
    if (is_of_generation(text.substr(0, text.find('=')))) making.push_back(text);
  task.arguments = with_set({"generate", plan.study.scene.string(), "-o", task.result.string()}, making);
  StageRecord const cost = predict(scene);
  task.disc_steps = cost.at("generation_disc_steps");
  task.memory = cost.at("memory_bytes");
  plan.specimens.push_back(std::move(task));
  return plan.specimens.size() - 1;
}

}  // namespace

LoadedScene StudyPlan::scene_of_run(std::size_t member) const {
  std::vector<std::string> const& arguments = runs[member].arguments;
  std::vector<std::string> texts;
  for (std::size_t i = 0; i + 1 < arguments.size(); ++i)
    if (arguments[i] == "--set") texts.push_back(arguments[i + 1]);
  return load_scene(study.scene, texts);
}

StudyPlan plan_study(Study study, std::vector<std::string> overrides) {
  StudyPlan plan{std::move(study), std::move(overrides), {}, {}, {}, {}};
  std::map<SceneTexts, std::string> seen;
  std::vector<Problem> problems;
  std::set<std::string> said;
  for (StudyGroup const& group : plan.study.groups) {
    try {
      Scene const scene = member_scene(plan.study, group, plan.study.seeds.front(), plan.overrides).scene;
      SceneTexts texts = scene_texts(scene, ".");
      texts["sample.file"] = scene.sample.file;
      auto const [other, is_new] = seen.emplace(std::move(texts), group.name);
      if (!is_new)
        problems.push_back(
            {plan.study.file.string(), 0, 0, fmt::format("the groups {} and {} are the same scene", other->second, group.name)});
    } catch (SceneProblems const& found) {
      for (Problem const& problem : found.problems)
        if (said.insert(problem.file + problem.text.substr(0, problem.text.rfind(" (in the group"))).second)
          problems.push_back(problem);
    }
  }
  if (!problems.empty()) throw SceneProblems(std::move(problems));
  return plan;
}

void add_member(StudyPlan& plan, std::size_t group, std::uint64_t seed) {
  Scene const scene = member_scene(plan.study, plan.study.groups[group], seed, plan.overrides).scene;
  std::vector<std::string> overrides = overrides_of(plan, group, seed);
  StudyTask task;
  task.name = member_name(plan.study.groups[group], seed);
  task.result = plan.study.folder / "members" / task.name;
  task.log = plan.study.folder / "logs" / (task.name + ".log");
  StageRecord const cost = predict(scene.sample.generator == Generator::file ? sized(plan, scene) : scene);
  task.disc_steps = cost.at("disc_steps");
  task.memory = cost.at("memory_bytes");
  task.disk = cost.at("disk_bytes");
  if (scene.sample.generator != Generator::file) {
    task.specimen = specimen_task(plan, scene, overrides);
    std::erase_if(overrides, is_of_size);
    overrides.insert(overrides.end(), {"sample.generator=file", "sample.file=" + plan.specimens[*task.specimen].result.string()});
  }
  task.arguments = with_set({"run", plan.study.scene.string(), "--output", task.result.string(), "--resume"}, overrides);
  MemberResult member;
  member.group = group;
  member.seed = seed;
  plan.members.push_back(std::move(member));
  plan.runs.push_back(std::move(task));
}

void find_finished(StudyPlan& plan, std::size_t member) {
  StudyTask const& task = plan.runs[member];
  std::error_code ignored;
  if (!fs::exists(task.result / "run.json", ignored)) return;
  if (task.specimen && !fs::exists(plan.specimens[*task.specimen].result, ignored)) return;
  Scene const scene = plan.scene_of_run(member).scene;
  std::string const digest = scene.sample.generator == Generator::file ? file_digest(scene.sample.file) : "";
  if (earlier_run(task.result, scene, digest) == EarlierRun::finished) read_member(plan.members[member], task.result);
}

}  // namespace clathra
