/// `clathra man`: the manual page, from the tables that the program has.
#include <fmt/format.h>

#include <array>

#include "clathra_version.hpp"
#include "io/scene/schema.hpp"
#include "terminal/command_table.hpp"
#include "terminal/print.hpp"
#include "verbs/verbs.hpp"

namespace clathra {
namespace {

struct ExitEntry {
  ExitCode code;
  char const* meaning;
};
constexpr std::array exits = {
    ExitEntry{ExitCode::done, "Done."},
    ExitEntry{ExitCode::usage, "The command line is wrong: the command, an option or its value, what --set says included."},
    ExitEntry{ExitCode::bad_input, "A scene, a study or another file has wrong content; every fault is printed with its place."},
    ExitEntry{ExitCode::file_missing, "An input file is not there or cannot be read."},
    ExitEntry{ExitCode::internal, "A fault of Clathra, or a failed check of selftest."},
    ExitEntry{ExitCode::out_of_memory, "More memory is needed than there is."},
    ExitEntry{
        ExitCode::cannot_create,
        "A file or folder of results cannot be made: no right to, another run is writing there, or earlier results or files of "
        "others are in the way."},
    ExitEntry{ExitCode::io_error, "A read or write failed half way, as on a full disk."},
    ExitEntry{ExitCode::to_be_resumed, "Stopped early, by a signal or the wall time, with a checkpoint: --resume goes on."},
    ExitEntry{ExitCode::diverged, "The run became unstable."},
    ExitEntry{ExitCode::refused,
              "Refused by a guard (its message names the option that overrides it, where there is one), or because no such test "
              "or specimen can be made."},
    ExitEntry{ExitCode::member_failed, "Members of a study failed; the others have results."},
    ExitEntry{ExitCode::undetermined, "What was asked for cannot be told from the runs that there are."},
    ExitEntry{ExitCode::interrupted, "Stopped by Ctrl-C or a signal before there was a checkpoint."},
};

constexpr char const* description = R"(.SH DESCRIPTION
Clathra is a two-dimensional discrete element solver for sand that is cemented by methane hydrate.
From a scene file (TOML) it makes a specimen, bonds the grains for a hydrate saturation, consolidates the specimen, shears
it between servo walls and writes the stress-strain curve and the state of every bond.
Results are equal to the bit for every number of threads and ranks, and after every restart.
)";
constexpr char const* environment = R"(.SH ENVIRONMENT
.TP
.B OMP_NUM_THREADS
Threads, where neither \-\-threads nor run.threads says how many.
.TP
.B OMP_PROC_BIND\fR, \fBOMP_PLACES
Where threads stay. If unset, threads are bound to cores only when they take all of them.
.TP
.B GLIBC_TUNABLES
If unset, glibc.malloc.hugetlb=1: memory in huge pages where the system has them.
.TP
.B NO_COLOR
If set and not empty, warnings on a terminal have no colour.
.TP
.B TMPDIR
Where selftest makes its temporary folder.
.SH FILES
.TP
.I share/doc/clathra
Beside the folder of the program: the pages that texts call docs/NAME.md, and the README.
.TP
.I share/clathra/examples
Scenes and studies, which clathra init writes too.
)";

/// Text for troff: hyphens that are to be copied, no accidental requests.
std::string troff(std::string_view text) {
  std::string result;
  for (char const letter : text) {
    if (letter == '\\')
      result += "\\e";
    else if (letter == '-')
      result += "\\-";
    else if ((letter == '.' || letter == '\'') && (result.empty() || result.back() == '\n'))
      result += std::string("\\&") + letter;
    else
      result += letter;
  }
  return result;
}

std::string option_text(OptionEntry const& option) {
  std::string names;
  for (std::string const& name : option.names) names += fmt::format("{}\\fB{}\\fR", names.empty() ? "" : ", ", troff(name));
  if (!option.positional && !option.value.empty()) names += fmt::format(" \\fI{}\\fR", troff(option.value));
  std::string text = fmt::format(".TP\n{}\n{}", names, troff(option.help));
  if (!option.choices.empty()) text += troff(fmt::format("; one of {}", fmt::join(option.choices, ", ")));
  if (!option.default_value.empty()) text += troff(fmt::format(" (default: {})", option.default_value));
  return text + "\n";
}

std::string verb_text(VerbEntry const& verb) {
  std::string arguments;
  for (OptionEntry const& option : verb.options)
    if (option.positional) arguments += fmt::format(" \\fI{}\\fR", troff(option.names.front()));
  std::string text = fmt::format(".SS \"clathra {}\"\n.B clathra {}\\fR{} [options]\n.PP\n{}.\n", verb.name, verb.name, arguments,
                                 troff(verb.help));
  for (OptionEntry const& option : verb.options) text += option_text(option);
  if (!verb.example.empty()) text += fmt::format(".PP\n.nf\n{}\n.fi\n", troff(verb.example));
  return text;
}

std::string key_text(Key const& key) {
  std::string values;
  if (!key.choices.empty()) values = fmt::format("one of {}", fmt::join(key.choices, ", "));
  if (key.kind == Kind::boolean) values = "true or false";
  if (key.kind == Kind::integer) values = "a whole number";
  if (key.kind == Kind::lever) values = "like \"1 mm\" or \"0.25 B\"";
  if (key.kind == Kind::quantity)
    values = fmt::format("{}, like {}", dimension_name(key.dimension), quantity_example(key.dimension));
  return fmt::format(".TP\n.B {}\n{}{}\n", troff(key.name), troff(key.help), values.empty() ? "" : troff("; " + values));
}

std::string manual(CLI::App const& program) {
  std::vector<VerbEntry> const verbs = command_table(program);
  std::string text = fmt::format(".TH CLATHRA 1 \"\" \"clathra {}\" \"User Commands\"\n", CLATHRA_VERSION);
  text += ".SH NAME\nclathra \\- discrete element solver for hydrate\\-bearing sand\n.SH SYNOPSIS\n";
  for (VerbEntry const& verb : verbs) text += fmt::format(".B clathra {}\\fR ...\n.br\n", verb.name);
  text += description;
  text += ".SH COMMANDS\n";
  for (VerbEntry const& verb : verbs) text += verb_text(verb);
  text += ".SH SCENE\nKeys of a scene file and of \\-\\-set. A quantity may have a unit; a bare number is in SI units.\n";
  for (Key const& key : schema()) text += key_text(key);
  text += ".SH EXIT STATUS\n";
  for (ExitEntry const& entry : exits)
    text += fmt::format(".TP\n.B {}\n{}\n", static_cast<int>(entry.code), troff(entry.meaning));
  return text + environment;
}

}  // namespace

void add_manual(CLI::App& program, Verb& chosen) {
  CLI::App* const verb = program.add_subcommand("man", "Print the manual page");
  verb->footer("Example: clathra man | man -l -");
  verb->callback([&program, &chosen] { chosen = [&program] { return print_result(manual(program)); }; });
}

}  // namespace clathra
