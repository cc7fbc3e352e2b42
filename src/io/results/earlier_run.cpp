#include "io/results/earlier_run.hpp"

#include <nlohmann/json.hpp>

#include "io/errors/problems.hpp"
#include "io/formats/text_file.hpp"
#include "io/results/checkpoint.hpp"
#include "io/results/output_folder.hpp"
#include "io/results/run_record.hpp"
#include "io/scene/scene_comparison.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr char finished[] = "finished";

/// A text inside objects of a record, "" where it is not there.
std::string text_at(Json const& record, char const* section, char const* key) {
  if (!record.is_object() || !record.contains(section) || !record[section].is_object()) return "";
  Json const& value = record[section].value(key, Json());
  return value.is_string() ? value.get<std::string>() : "";
}

/// Whether a record says how its run ended, or that it is running: code 0 belongs to these two alone.
bool says_how_it_ended(Json const& record) {
  if (!record.is_object()) return false;
  Json const end = record.value("exit", Json());
  if (!end.is_object() || !end.value("code", Json()).is_number_integer()) return false;
  std::string const reason = text_at(record, "exit", "reason");
  return !reason.empty() && (end["code"] != 0 || reason == finished || reason == "running");
}

/// The run.json of a folder; null where there is none. @throws FileProblem bad_input where it is no record of a run
Json record_of(fs::path const& run_folder) {
  std::error_code ignored;
  fs::path const file = run_folder / "run.json";
  if (!fs::exists(fs::symlink_status(file, ignored))) return {};
  Json record = Json::parse(read_text_file(file, largest_run_record + 1), nullptr, false);
  if (!says_how_it_ended(record))
    throw FileProblem(
        ExitCode::bad_input, file,
        "is damaged, so nobody knows what the folder holds; nothing was changed: put back what was there, or choose "
        "another folder (clathra run --overwrite gives the results up)");
  return record;
}

/// How the scene and the specimen of a record differ from those that are asked for.
struct Differences {
  std::string all, to_go_on;  ///< "; damping.local was 0.3, is 0.2"; what keeps the test from being gone on with
  std::string of_files;       ///< of what was read, which no checkpoint knows
  bool longer = false;        ///< the test that is asked for
};

Differences differences_from(Json const& record, fs::path const& run_folder, Scene const& scene, InputDigests const& digests) {
  Differences found;
  try {
    Scene then = scene_of(record.at("scene"));
    found.longer = scene.test.axial_strain > then.test.axial_strain;
    if (std::string& file = then.grading.file; !file.empty()) file = (run_folder / file).string();  // it stands there relative
    found.all = scene_differences(scene_texts(then, run_folder), scene, run_folder);
    found.to_go_on = scene_differences(scene_texts(then, run_folder), scene, run_folder, Agreement::further);
  } catch (std::exception const& problem) {
    throw FileProblem(ExitCode::bad_input, run_folder / "run.json", std::string("is no record of a run: ") + problem.what());
  }
  auto const compare = [&](char const* what, std::string const& then, std::string const& now) {
    if (then == now) return;
    std::string const text = std::string("; the ") + what + " file had digest " + (then.empty() ? "(none)" : then) + ", has " +
                             (now.empty() ? "(none)" : now);
    for (std::string* const differences : {&found.all, &found.to_go_on, &found.of_files}) *differences += text;
  };
  compare("specimen", text_at(record, "input", "specimen_digest_xxh3_128"), digests.specimen);
  compare("grading", text_at(record, "input", "grading_digest_xxh3_128"), digests.grading);
  return found;
}

}  // namespace

EarlierRun earlier_run(fs::path const& run_folder, Scene const& scene, InputDigests const& digests) {
  Json const record = record_of(run_folder);
  bool const is_finished = text_at(record, "exit", "reason") == finished;
  bool const goes_on = has_checkpoints(run_folder);  // which know their scene
  if (!holds_results(run_folder) || (record.is_null() && goes_on)) return EarlierRun::unfinished;
  if (record.is_null())
    throw FileProblem(
        ExitCode::cannot_create, run_folder,
        "holds results of a run whose run.json is missing; --overwrite gives them up, --output names another folder");
  Differences const different = differences_from(record, run_folder, scene, digests);
  if (!is_finished) {
    if ((goes_on ? different.of_files : different.all).empty()) return EarlierRun::unfinished;
    throw FileProblem(
        ExitCode::cannot_create, run_folder,
        "holds the unfinished run of another scene; --overwrite gives it up, --output names another folder" + different.all);
  }
  if (different.all.empty()) return EarlierRun::finished;
  if (!different.to_go_on.empty() || !different.longer)
    throw FileProblem(
        ExitCode::cannot_create, run_folder,
        "holds the finished run of another scene; --resume would destroy it, choose another folder" + different.all);
  if (!goes_on)
    throw FileProblem(
        ExitCode::cannot_create, run_folder,
        "holds a finished run that kept no checkpoint to be extended from (output.keep_checkpoint)" + different.all);
  return EarlierRun::to_be_extended;
}

std::string program_of_run(fs::path const& run_folder) {
  Json record;
  try {
    record = record_of(run_folder);
  } catch (FileProblem const&) {
    return {};
  }
  std::string const version = text_at(record, "program", "version");
  return version.empty() ? "" : version_text(version, text_at(record, "program", "git_hash"));
}

EarlierSessions earlier_sessions(fs::path const& run_folder) {
  Json const record = record_of(run_folder);
  if (record.is_null()) return {};
  try {
    Json const stages = record.value("stages", Json::object());
    EarlierSessions earlier;
    earlier.generate = stages.value("generate", StageRecord());
    earlier.plan = stages.value("plan", StageRecord());
    earlier.layer_void_ratios = record.value("layer_void_ratios", std::vector<double>());
    earlier.wall_seconds = record.value("wall_seconds", std::map<std::string, double>());
    earlier.axial_strain = scene_of(record.at("scene")).test.axial_strain;
    return earlier;
  } catch (std::exception const& problem) {
    throw FileProblem(ExitCode::bad_input, run_folder / "run.json", std::string("is no record of a run: ") + problem.what());
  }
}

std::optional<KeptRun> kept_run(fs::path const& run_folder) {
  if (!holds_results(run_folder)) return {};
  Json record;
  try {
    record = record_of(run_folder);
  } catch (FileProblem const&) {
    return KeptRun{"results of a run whose run.json is damaged", false};
  }
  if (record.is_null()) return KeptRun{"results of a run whose run.json is missing", has_checkpoints(run_folder)};
  std::string const reason = text_at(record, "exit", "reason");
  if (reason == finished) return KeptRun{"a finished run", true};
  return KeptRun{"a run that is not finished (" + (reason == "running" ? "it was killed" : reason) + ")", true};
}

}  // namespace clathra
