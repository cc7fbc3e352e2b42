#include "io/results/earlier_run.hpp"

#include <nlohmann/json.hpp>

#include "io/errors/problems.hpp"
#include "io/formats/text_file.hpp"
#include "io/results/checkpoint.hpp"
#include "io/results/run_record.hpp"
#include "io/scene/scene_comparison.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr std::size_t largest_record = std::size_t{64} << 20;
constexpr char finished[] = "finished";

/// The run.json of a folder; no object where there is none that can be read.
Json record_of(fs::path const& run_folder) {
  std::error_code ignored;
  fs::path const file = run_folder / "run.json";
  if (!fs::is_regular_file(file, ignored)) return {};
  return Json::parse(read_text_file(file, largest_record), nullptr, false);
}

/// A text inside objects of a record, "" where it is not there.
std::string text_at(Json const& record, char const* section, char const* key) {
  if (!record.is_object() || !record.contains(section) || !record[section].is_object()) return "";
  Json const& value = record[section].value(key, Json());
  return value.is_string() ? value.get<std::string>() : "";
}

}  // namespace

EarlierRun earlier_run(fs::path const& run_folder, Scene const& scene, std::string const& specimen_digest) {
  Json const record = record_of(run_folder);
  if (text_at(record, "exit", "reason") != finished) return EarlierRun::unfinished;
  std::string different, to_go_on;
  bool longer = false;
  try {
    Scene then = scene_of(record.at("scene"));
    longer = scene.test.axial_strain > then.test.axial_strain;
    if (std::string& file = then.grading.file; !file.empty()) file = (run_folder / file).string();  // it stands there relative
    different = scene_differences(scene_texts(then, run_folder), scene, run_folder);
    to_go_on = scene_differences(scene_texts(then, run_folder), scene, run_folder, Agreement::further);
  } catch (std::exception const& problem) {
    throw FileProblem(ExitCode::bad_input, run_folder / "run.json", std::string("is no record of a run: ") + problem.what());
  }
  if (std::string const then = text_at(record, "input", "specimen_digest_xxh3_128"); then != specimen_digest) {
    std::string const digests = "; the specimen file had digest " + (then.empty() ? "(none)" : then) + ", has " +
                                (specimen_digest.empty() ? "(none)" : specimen_digest);
    different += digests;
    to_go_on += digests;
  }
  if (different.empty()) return EarlierRun::finished;
  if (!to_go_on.empty() || !longer)
    throw FileProblem(ExitCode::refused, run_folder,
                      "holds the finished run of another scene; --resume would destroy it, choose another folder" + different);
  if (!has_checkpoints(run_folder))
    throw FileProblem(ExitCode::refused, run_folder,
                      "holds a finished run that kept no checkpoint to be extended from (output.keep_checkpoint)" + different);
  return EarlierRun::to_be_extended;
}

std::optional<std::string> unfinished_run(fs::path const& run_folder) {
  if (!has_checkpoints(run_folder)) return {};
  std::string const reason = text_at(record_of(run_folder), "exit", "reason");
  if (reason == finished) return {};
  return reason.empty() || reason == "running" ? "it was killed" : reason;
}

}  // namespace clathra
