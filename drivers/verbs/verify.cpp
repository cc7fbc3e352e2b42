/// `clathra verify`: are the files of a run still what the run wrote?
#include <fmt/format.h>

#include <memory>

#include "io/results/run_check.hpp"
#include "print.hpp"
#include "verbs.hpp"

namespace clathra {
namespace {

ExitCode verify(std::string const& folder) {
  std::string text;
  int wrong = 0;
  std::vector<FileCheck> const checks = check_run(folder);
  for (FileCheck const& check : checks) {
    text += fmt::format("{:<28} {}\n", check.file, check.problem.empty() ? "ok" : check.problem);
    wrong += check.problem.empty() ? 0 : 1;
  }
  text += wrong == 0 ? fmt::format("all {} files are as the run wrote them\n", checks.size())
                     : fmt::format("{} of {} files are not as the run wrote them\n", wrong, checks.size());
  ExitCode const printed = print_result(text);
  return wrong > 0 ? ExitCode::bad_input : printed;
}

}  // namespace

void add_verify(CLI::App& program, Verb& chosen) {
  auto const folder = std::make_shared<std::string>();
  CLI::App* const verb = program.add_subcommand("verify", "Compare the files of a finished run with the digests in its run.json");
  verb->add_option("folder", *folder, "folder of a run")->required();
  verb->footer("Example: clathra verify out/quick");
  verb->callback([folder, &chosen] { chosen = [folder] { return verify(*folder); }; });
}

}  // namespace clathra
