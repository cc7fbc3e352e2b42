/// `clathra info`: what a specimen file, a snapshot or the folder of a run holds.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "io/formats/text_file.hpp"
#include "io/results/checkpoint.hpp"
#include "io/results/export.hpp"
#include "io/results/run_record.hpp"
#include "io/results/run_results.hpp"
#include "io/results/snapshot_file.hpp"
#include "io/results/specimen_check.hpp"
#include "io/results/specimen_file.hpp"
#include "io/scene/scene_file.hpp"
#include "run/file_info.hpp"
#include "terminal/json_text.hpp"
#include "terminal/print.hpp"
#include "verbs/verbs.hpp"

namespace clathra {
namespace {

struct InfoOptions {
  std::string file;
  bool state_hash = false, cost = false, json = false;
};

ExitCode info_of_run(std::filesystem::path const& file, InfoOptions const& options) {
  std::string const text = read_text_file(file, largest_run_record);
  try {
    if (options.json) return print_json(json_text(nlohmann::ordered_json::parse(text)));
    nlohmann::json const record = nlohmann::json::parse(text);
    if (!options.state_hash) return print_result(run_text(record));
    if (!record.contains("state_hash"))
      throw FileProblem(ExitCode::bad_input, file, "the run has not finished, there is no state hash");
    return print_result(record.at("state_hash").get<std::string>() + "\n");
  } catch (nlohmann::json::exception const& problem) {
    throw FileProblem(ExitCode::bad_input, file, fmt::format("is not a record of a run: {}", problem.what()));
  }
}

ExitCode info(InfoOptions const& options) {
  std::filesystem::path const file = options.file;
  if (options.cost) return print_result(needs_text(load_scene(file).scene));
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) require_run_folder(file);
  if (std::filesystem::is_directory(file, ignored)) return info_of_run(file / "run.json", options);
  if (file.extension() == ".json") return info_of_run(file, options);
  if (is_snapshot(file)) {
    if (options.state_hash)
      throw FileProblem(ExitCode::bad_input, file, "is a snapshot, whose numbers are rounded: it has no state hash");
    Snapshot const snapshot = read_snapshot(file);
    return options.json ? print_json(json_text(snapshot_json(snapshot))) : print_result(snapshot_text(snapshot));
  }
  if (is_checkpoint(file)) {
    std::string const hash = checkpoint_state_hash(file);
    std::string const run = file.parent_path().parent_path().string();
    if (options.json) return print_json(json_text({{"kind", "checkpoint"}, {"run", run}, {"state_hash", hash}}));
    return print_result(options.state_hash ? hash + "\n"
                                           : fmt::format("{:<18} {}\n{:<18} {}\n", "checkpoint of", run, "state hash", hash));
  }
  auto const [specimen, facts] = read_checked_specimen(file);
  if (options.state_hash) return print_result(hash_text(specimen_hash(specimen)) + "\n");
  std::vector<std::string> warnings = oddities(file, specimen, facts);
  for (std::string& warning : stress_oddities(file, specimen, facts, {})) warnings.push_back(std::move(warning));
  if (options.json) {
    nlohmann::ordered_json json = specimen_json(specimen, facts);
    json["warnings"] = warnings;
    return print_json(json_text(json));
  }
  std::string text = specimen_text(specimen, facts);
  for (std::string const& warning : warnings) text += "warning: " + warning + "\n";
  return print_result(text);
}

}  // namespace

void add_info(CLI::App& program, Verb& chosen) {
  auto const options = std::make_shared<InfoOptions>();
  CLI::App* const verb = program.add_subcommand("info", "Say what a specimen file, a snapshot or the folder of a run holds");
  verb->add_option("file", options->file, "specimen file, snapshot, checkpoint, run.json, or folder of a run")->required();
  CLI::Option* const hash = verb->add_flag("--state-hash", options->state_hash, "print only the hash of the state");
  verb->add_flag("--json", options->json, "one JSON object, SI units; of a run its run.json")->excludes(hash);
  // For developers: what a scene keeps in memory and computes, field by field.
  verb->add_flag("--cost", options->cost)->excludes(hash)->group("");
  verb->footer("Example: clathra info out/quick/specimen.h5");
  verb->callback([options, &chosen] { chosen = [options] { return info(*options); }; });
}

}  // namespace clathra
