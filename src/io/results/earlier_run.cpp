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

constexpr std::size_t largest_record = std::size_t{64} << 20;
constexpr char finished[] = "finished";

/// The run.json of a folder; null where there is none. @throws FileProblem bad_input where it is no record of a run
Json record_of(fs::path const& run_folder) {
  std::error_code ignored;
  fs::path const file = run_folder / "run.json";
  if (!fs::exists(fs::symlink_status(file, ignored))) return {};
  Json record = Json::parse(read_text_file(file, largest_record + 1), nullptr, false);
  if (!record.is_object() || !record.contains("exit"))
    throw FileProblem(ExitCode::bad_input, file,
                      "is damaged, so nobody knows what the folder holds; nothing was changed: put back what was there, choose "
                      "another folder (--output), or give the results up with --overwrite");
  return record;
}

/// A text inside objects of a record, "" where it is not there.
std::string text_at(Json const& record, char const* section, char const* key) {
  if (!record.is_object() || !record.contains(section) || !record[section].is_object()) return "";
  Json const& value = record[section].value(key, Json());
  return value.is_string() ? value.get<std::string>() : "";
}

}  // namespace

namespace {

/// How the scene and the specimen of a record differ from those that are asked for.
struct Differences {
  std::string all, to_go_on;  ///< "; run.damping was 0.3, is 0.2"; what keeps the test from being gone on with
  bool longer = false;        ///< the test that is asked for
};

Differences differences_from(Json const& record, fs::path const& run_folder, Scene const& scene,
                             std::string const& specimen_digest) {
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
  if (std::string const then = text_at(record, "input", "specimen_digest_xxh3_128"); then != specimen_digest) {
    std::string const digests = "; the specimen file had digest " + (then.empty() ? "(none)" : then) + ", has " +
                                (specimen_digest.empty() ? "(none)" : specimen_digest);
    found.all += digests;
    found.to_go_on += digests;
  }
  return found;
}

}  // namespace

EarlierRun earlier_run(fs::path const& run_folder, Scene const& scene, std::string const& specimen_digest) {
  Json const record = record_of(run_folder);
  bool const is_finished = text_at(record, "exit", "reason") == finished;
  if (!is_finished && (has_checkpoints(run_folder) || !holds_results(run_folder))) return EarlierRun::unfinished;
  if (record.is_null())
    throw FileProblem(
        ExitCode::refused, run_folder,
        "holds results of a run whose run.json is missing; --overwrite gives them up, --output names another folder");
  Differences const different = differences_from(record, run_folder, scene, specimen_digest);
  if (!is_finished) {
    if (different.all.empty()) return EarlierRun::unfinished;
    throw FileProblem(ExitCode::refused, run_folder,
                      "holds the run of another scene, which has no checkpoint; --overwrite gives it up, --output names another "
                      "folder" +
                          different.all);
  }
  if (different.all.empty()) return EarlierRun::finished;
  if (!different.to_go_on.empty() || !different.longer)
    throw FileProblem(
        ExitCode::refused, run_folder,
        "holds the finished run of another scene; --resume would destroy it, choose another folder" + different.all);
  if (!has_checkpoints(run_folder))
    throw FileProblem(
        ExitCode::refused, run_folder,
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

std::optional<std::string> kept_run(fs::path const& run_folder) {
  if (!holds_results(run_folder)) return {};
  Json record;
  try {
    record = record_of(run_folder);
  } catch (FileProblem const&) {
    return "results of a run whose run.json is damaged";
  }
  if (record.is_null()) return "results of a run whose run.json is missing";
  std::string const reason = text_at(record, "exit", "reason");
  if (reason == finished) return "a finished run";
  return "a run that is not finished (" + (reason.empty() || reason == "running" ? "it was killed" : reason) + ")";
}

}  // namespace clathra
