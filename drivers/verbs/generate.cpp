/// `clathra generate`: make a specimen and keep it.
#include <fmt/format.h>

#include <memory>

#include "clathra_version.hpp"
#include "io/errors/rank_errors.hpp"
#include "io/formats/text_file.hpp"
#include "io/results/specimen_file.hpp"
#include "machine/interrupt.hpp"
#include "machine/threads.hpp"
#include "run/forecast.hpp"
#include "run/rank_checks.hpp"
#include "run/specimen_source.hpp"
#include "run/stage_progress.hpp"
#include "terminal/print.hpp"
#include "verbs/scene_options.hpp"
#include "verbs/verbs.hpp"

namespace clathra {
namespace {

struct GenerateOptions {
  SceneOptions scene;
  std::string output = "specimen.h5";
  bool overwrite = false;
};

std::string record_text(RunRecord const& record) {
  std::string text;
  for (auto const& [name, value] : record.stages.at("generate")) text += fmt::format("  {:<26} {:.6g}\n", name, value);
  text += fmt::format("  {:<26}", "layer void ratios");
  for (double const ratio : record.layer_void_ratios) text += fmt::format(" {:.4f}", ratio);
  return text + fmt::format("\n  {:<26} {:.1f}\n", "wall seconds", record.wall_seconds.at("generate"));
}

/// @throws FileProblem where the file could not be written, or is there and shall stay
void require_free(std::string const& output, bool overwrite) {
  std::error_code ignored;
  if (!overwrite && !std::filesystem::is_directory(output, ignored))
    require_no_file(output, "-o names another file, --overwrite puts the new specimen in its place");
  require_creatable(output);
}

ExitCode generate_on(Ranks const& ranks, GenerateOptions const& options, RunRecord& record) {
  std::string const& output = options.output;
  Scene const& scene = record.input.scene;
  require_same_everywhere(ranks, record.input);
  on_root(ranks, [&] { require_free(output, options.overwrite); });
  StageRecord const cost = predict(scene, launched_ranks());
  std::vector<std::string> refusals;
  if (std::string const refusal = memory_refusal(cost); !refusal.empty() && !scene.run.ignore_guards) refusals.push_back(refusal);
  share_refusals(ranks, refusals);
  if (!refusals.empty()) throw OutOfMemory(refusals.front() + ignore_hint);
  require_enough_discs(ranks.count(), static_cast<std::int64_t>(cost.at("particles")));
  watch_for_interrupt();
  ProgressLine line;
  for (std::string const& warning : record.input.warnings) line.warn(warning);
  if (std::string const warning = thread_warning(scene.run.threads); !warning.empty()) line.warn(warning);
  KokkosSession const kokkos;
  Specimen const specimen = generate_recorded(scene, line, record, ranks);
  write_specimen(output, specimen, ranks, options.overwrite ? Existing::replaced : Existing::kept);
  line.repeat_warnings();
  return print_result(
      fmt::format("{}: {:.0f} particles\n{}", output, record.stages.at("generate").at("particles"), record_text(record)));
}

ExitCode generate(GenerateOptions const& options) {
  RunRecord record;
  record.version = CLATHRA_VERSION;
  record.git_hash = CLATHRA_GIT_HASH;
  record.input = options.scene.load();
  Scene const& scene = record.input.scene;
  if (scene.specimen.is_read()) throw Refused("the scene reads its specimen from a file: there is nothing to generate");
  set_up_threads(scene.run.threads);
  RankSession const session;
  return guarded_on_all_ranks(session.ranks(), [&] { return generate_on(session.ranks(), options, record); });
}

}  // namespace

void add_generate(CLI::App& program, Verb& chosen) {
  auto const options = std::make_shared<GenerateOptions>();
  CLI::App* const verb = program.add_subcommand("generate", "Make a specimen file that later runs can read");
  options->scene.add_to(*verb);
  verb->add_option("-o,--output", options->output, "specimen file to write")
      ->capture_default_str()
      ->type_name("FILE")
      ->check(CLI::Validator(name_problem, ""));
  verb->add_flag("--overwrite", options->overwrite, "take the place of a file of that name, once the specimen is made");
  add_status_option(*verb);
  verb->footer(
      "Example: clathra generate examples/quick.toml -o specimen.h5\n"
      "         clathra run examples/quick.toml --set specimen.file=specimen.h5");
  verb->callback([options, &chosen] { chosen = [options] { return generate(*options); }; });
}

}  // namespace clathra
