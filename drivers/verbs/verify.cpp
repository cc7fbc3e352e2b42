/// `clathra verify`: are the files of a run still what the run wrote?
#include <fmt/format.h>

#include <memory>

#include "io/results/run_check.hpp"
#include "io/results/run_results.hpp"
#include "terminal/json_text.hpp"
#include "terminal/print.hpp"
#include "verbs/verbs.hpp"

namespace clathra {
namespace {

struct VerifyOptions {
  std::string folder;
  bool json = false;
};

ExitCode verify(VerifyOptions const& options) {
  std::string text;
  int wrong = 0;
  require_run_folder(options.folder);
  std::vector<FileCheck> const checks = check_run(options.folder);
  nlohmann::ordered_json files = nlohmann::json::array();
  for (FileCheck const& check : checks) {
    text += fmt::format("{:<28} {}\n", check.file, check.problem.empty() ? "ok" : check.problem);
    files.push_back({{"file", check.file}, {"as_written", check.problem.empty()}, {"problem", check.problem}});
    wrong += check.problem.empty() ? 0 : 1;
    if (is_quiet() && !check.problem.empty()) print_error(fmt::format("clathra: {} {}", check.file, check.problem));
  }
  text += wrong == 0 ? fmt::format("all {} files are as the run wrote them\n", checks.size())
                     : fmt::format("{} of {} files are not as the run wrote them\n", wrong, checks.size());
  ExitCode const printed = options.json ? print_json(json_text({{"folder", options.folder},
                                                                {"files_checked", checks.size()},
                                                                {"files_not_as_written", wrong},
                                                                {"files", std::move(files)}}))
                                        : print_result(text);
  return wrong > 0 ? ExitCode::bad_input : printed;
}

}  // namespace

void add_verify(CLI::App& program, Verb& chosen) {
  auto const options = std::make_shared<VerifyOptions>();
  CLI::App* const verb = program.add_subcommand("verify", "Compare the files of a finished run with the digests in its run.json");
  verb->add_option("folder", options->folder, "folder of a run")->required();
  verb->add_flag("--json", options->json, "one JSON object");
  verb->footer("Example: clathra verify out/quick");
  verb->callback([options, &chosen] { chosen = [options] { return verify(*options); }; });
}

}  // namespace clathra
