/// The program `clathra`: chooses the verb, turns what goes wrong into a message and an exit code.
#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <sstream>
#include <thread>

#include "domain/parallel/ranks.hpp"
#include "io/errors/failure.hpp"
#include "io/scene/schema.hpp"
#include "machine/own_program.hpp"
#include "terminal/print.hpp"
#include "terminal/status.hpp"
#include "verbs/verbs.hpp"

namespace clathra {
namespace {

/// Closed standard streams are opened on /dev/null: otherwise the first result file would get their number, and messages go into
/// it. A reader of our output that goes away is no reason to stop a run.
void secure_standard_streams() {
  for (int descriptor = 0; descriptor <= 2; ++descriptor)
    if (::fcntl(descriptor, F_GETFD) < 0) (void)::open("/dev/null", O_RDWR);
  ::signal(SIGPIPE, SIG_IGN);
  ::signal(SIGXFSZ, SIG_IGN);
}

ExitCode say(ExitCode code, std::string const& text) {
  say_failure(text);
  print_error("clathra: " + text);
  return code;
}

ExitCode run_guarded(Verb const& verb) {
  try {
    return verb();
  } catch (SceneProblems const& problems) {
    say_failure(problems.problems.front().message());
    for (Problem const& problem : problems.problems) print_error(problem.message());
    return problems.code();
  } catch (...) {
    Failure const failure = failure_in_flight();
    return say(failure.code, failure.text);
  }
}

/// For a first argument that is no verb: "there is no command 'cehck'; did you mean 'check'?", else nothing.
std::string unknown_verb(CLI::App& program, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return {};
  std::vector<std::string> names;
  for (CLI::App const* verb : program.get_subcommands({})) names.push_back(verb->get_name());
  if (std::find(names.begin(), names.end(), argv[1]) != names.end()) return {};
  std::vector<std::string_view> const views(names.begin(), names.end());
  std::string const name = std::string(argv[1]).substr(0, 60);
  return fmt::format("there is no command '{}'{}; `clathra --help` lists all", name, name_suggestion(name, views));
}

/// Help and version, which end the parsing too, go to stdout, what is wrong with the command line to stderr.
ExitCode say_of_parser(CLI::App const& program, CLI::ParseError const& error) {
  std::ostringstream out, problem;
  if (program.exit(error, out, problem) == 0) return print_result(out.str());
  std::istringstream lines(problem.str());
  for (std::string line; std::getline(lines, line);) print_error(line);
  return ExitCode::usage;
}

/// Verbs whose work is more than what they print.
void add_quiet(CLI::App& program, bool& quiet) {
  for (char const* const name :
       {"check", "run", "study", "tune", "reproduce", "generate", "export", "report", "verify", "selftest"})
    program.get_subcommand(name)->add_flag("--quiet", quiet, "print warnings and errors only");
}

ExitCode choose_and_run(int argc, char** argv) {
  CLI::App program{"Clathra: discrete element solver for hydrate-bearing sand", "clathra"};
  program.set_version_flag("--version", version_and_libraries);
  program.require_subcommand(1);
  program.get_formatter()->label("SUBCOMMAND", "COMMAND");
  program.footer("Example: clathra run examples/quick.toml --output out/quick");
  Verb chosen;
  add_init(program, chosen);
  add_schema(program, chosen);
  add_check(program, chosen);
  add_run(program, chosen);
  add_study(program, chosen);
  add_tune(program, chosen);
  add_reproduce(program, chosen);
  add_generate(program, chosen);
  add_bond(program, chosen);
  add_info(program, chosen);
  add_events(program, chosen);
  add_export(program, chosen);
  add_report(program, chosen);
  add_verify(program, chosen);
  add_bench(program, chosen);
  add_selftest(program, chosen);
  add_completion(program, chosen);
  add_manual(program, chosen);
  for (CLI::App* const verb : program.get_subcommands([](CLI::App const* app) { return !app->get_group().empty(); }))
    verb->group("Commands");
  bool quiet = false;
  add_quiet(program, quiet);
  try {
    program.parse(argc, argv);
  } catch (CLI::ParseError const& error) {
    if (std::string const text = unknown_verb(program, argc, argv); !text.empty()) return say(ExitCode::usage, text);
    return say_of_parser(program, error);
  }
  if (quiet) be_quiet();
  std::string const verb = program.get_subcommands().front()->get_name();
  if (launched_ranks() > 1 && verb != "run" && verb != "generate")
    return say(ExitCode::usage, fmt::format("'{}' runs on one rank, {} were started; only 'run' and 'generate' share their work",
                                            verb, launched_ranks()));
  return run_guarded(chosen);
}

/// A launcher kills all ranks as soon as one ends with an error, and only rank 0 says which: it goes first.
void let_rank_0_explain(ExitCode code) {
  if (code != ExitCode::done && launched_rank() > 0) std::this_thread::sleep_for(std::chrono::seconds(2));
}

}  // namespace
}  // namespace clathra

int main(int argc, char** argv) {
  clathra::secure_standard_streams();
  clathra::ExitCode const code = clathra::choose_and_run(argc, argv);
  clathra::let_rank_0_explain(code);
  return static_cast<int>(code);
}
