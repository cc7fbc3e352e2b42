/// The program `clathra`: chooses the verb, turns what goes wrong into a message and an exit code.
#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "domain/parallel/ranks.hpp"
#include "io/errors/failure.hpp"
#include "io/scene/schema.hpp"
#include "machine/own_program.hpp"
#include "terminal/help_format.hpp"
#include "terminal/json_text.hpp"
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

/// What the command line says before it is understood.
struct Call {
  std::string command;
  bool json = false;
};

Call call_of(int argc, char** argv) {
  Call call{argc > 1 ? argv[1] : "", false};
  for (int i = 1; i < argc; ++i) call.json |= std::string_view(argv[i]) == "--json";
  return call;
}

nlohmann::ordered_json json_of(Problem const& problem) {
  constexpr char const* severities[] = {"error", "missing file", "refusal"};
  return {{"file", problem.file},
          {"line", problem.line},
          {"column", problem.column},
          {"severity", severities[static_cast<int>(problem.severity)]},
          {"text", problem.text}};
}

/// What went wrong, for a script, unless it has got its object already.
void print_problems(Call const& call, ExitCode code, std::vector<Problem> const& problems) {
  if (!call.json || has_printed_json()) return;
  bool const of_input = code == ExitCode::usage || code == ExitCode::bad_input || code == ExitCode::file_missing;
  nlohmann::ordered_json json = {{"command", call.command},
                                 {"verdict", code == ExitCode::refused ? "refused"
                                             : of_input                ? "invalid"
                                                                       : "failed"},
                                 {"exit_code", static_cast<int>(code)},
                                 {"problems", nlohmann::json::array()}};
  for (Problem const& problem : problems) json["problems"].push_back(json_of(problem));
  (void)print_json(json_text(json));
}

ExitCode say(Call const& call, Failure const& failure) {
  say_failure(failure.text);
  print_error("clathra: " + failure.text);
  print_problems(call, failure.code, failure.problems);
  return failure.code;
}

/// What is wrong with the command line.
ExitCode say_of_usage(Call const& call, std::string const& text) {
  return say(call, {ExitCode::usage, text, true, {{"", 0, 0, text}}});
}

ExitCode run_guarded(Call const& call, Verb const& verb) {
  try {
    return verb();
  } catch (SceneProblems const& problems) {
    say_failure(problems.problems.front().message());
    for (Problem const& problem : problems.problems) print_error(problem.message());
    print_problems(call, problems.code(), problems.problems);
    return problems.code();
  } catch (...) {
    return say(call, failure_in_flight());
  }
}

/// Where the first argument is no command: "there is no command 'cehck'; did you mean 'check'?", or what there is; else nothing.
std::string command_problem(CLI::App& program, std::string const& command) {
  std::vector<std::string> names;
  for (CLI::App const* verb : program.get_subcommands({})) names.push_back(verb->get_name());
  if (std::find(names.begin(), names.end(), command) != names.end()) return {};
  if (command.empty() || command.front() == '-')
    return fmt::format("a command is required{}: {}; `clathra --help` says what each does",
                       command.empty() ? "" : " before " + command.substr(0, 60), fmt::join(names, ", "));
  std::vector<std::string_view> const views(names.begin(), names.end());
  std::string const name = command.substr(0, 60);
  return fmt::format("there is no command '{}'{}; `clathra --help` lists all", name, name_suggestion(name, views));
}

/// Help and version, which end the parsing too, go to stdout, what is wrong with the command line to stderr.
ExitCode say_of_parser(Call const& call, CLI::App& program, CLI::ParseError const& error) {
  std::ostringstream out, problem;
  if (program.exit(error, out, problem) == 0) return print_result(out.str());
  if (std::string const text = command_problem(program, call.command); !text.empty()) return say_of_usage(call, text);
  std::istringstream lines(problem.str());
  for (std::string line; std::getline(lines, line);) print_error(line);
  print_problems(call, ExitCode::usage, {{"", 0, 0, error.what()}});
  return ExitCode::usage;
}

/// Verbs whose work is more than what they print.
void add_quiet(CLI::App& program, bool& quiet) {
  for (char const* const name :
       {"check", "run", "study", "tune", "reproduce", "generate", "export", "report", "verify", "selftest"}) {
    CLI::App* const verb = program.get_subcommand(name);
    CLI::Option* const flag = verb->add_flag("--quiet", quiet, "print warnings and errors only");
    if (CLI::Option* const dry = verb->get_option_no_throw("--dry-run")) flag->excludes(dry);  // which does nothing but print
  }
}

ExitCode choose_and_run(int argc, char** argv) {
  Call const call = call_of(argc, argv);
  CLI::App program{"Clathra: discrete element solver for hydrate-bearing sand", "clathra"};
  program.set_version_flag("--version", version_and_libraries);
  program.require_subcommand(1);
  program.formatter(std::make_shared<HelpFormat>());
  program.footer(fmt::format(
      "Example: clathra run examples/quick.toml --output out/quick\nPages that texts call docs/NAME.md: {}", pages_folder()));
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
  for (CLI::App* const verb : program.get_subcommands({})) verb->group("Commands");
  bool quiet = false;
  add_quiet(program, quiet);
  try {
    program.parse(argc, argv);
  } catch (CLI::ParseError const& error) {
    return say_of_parser(call, program, error);
  }
  if (quiet) be_quiet();
  std::string const verb = program.get_subcommands().front()->get_name();
  if (launched_ranks() > 1 && verb != "run" && verb != "generate")
    return say_of_usage(call, fmt::format("'{}' runs on one rank, {} were started; only 'run' and 'generate' share their work",
                                          verb, launched_ranks()));
  return run_guarded(call, chosen);
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
