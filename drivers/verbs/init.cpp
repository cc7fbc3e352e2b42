/// `clathra init`: a commented scene file, or a study file, to start from.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <vector>

#include "io/formats/text_file.hpp"
#include "io/scene/schema.hpp"
#include "study/examples.hpp"
#include "terminal/print.hpp"
#include "verbs/verbs.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

struct InitOptions {
  std::string example, output;
  bool list = false;
};

ExitCode write_template(InitOptions const& options) {
  Example const* const example = example_named(options.example);
  if (!example) {
    std::vector<std::string_view> names;
    std::string hint;
    for (Example const& other : examples()) {
      names.push_back(other.name);
      if (other.name.ends_with("/" + options.example)) hint = fmt::format("; did you mean '{}'?", other.name);
    }
    if (hint.empty()) hint = name_suggestion(options.example, names);
    print_error(fmt::format("clathra: there is no example '{}'{}; `clathra init --list` names them all", options.example, hint));
    return ExitCode::usage;
  }
  fs::path const path = options.output.empty() ? fs::path(options.example).filename().string() + ".toml" : options.output;
  require_no_file(path, "-o names another file");
  return print_result(write_example(*example, path));
}

}  // namespace

void add_init(CLI::App& program, Verb& chosen) {
  auto const options = std::make_shared<InitOptions>();
  CLI::App* const verb = program.add_subcommand("init", "Write a commented scene file or a study file to start from");
  CLI::Option* const list = verb->add_flag("--list", options->list, "list the examples, as without an argument");
  verb->add_option("example", options->example, "the example to start from; without one, they are listed");
  verb->add_option("-o,--output", options->output, "file to write (default: the example's name in the current folder)")
      ->type_name("FILE")
      ->excludes(list);
  verb->footer("Example: clathra init quick -o my.toml\n         clathra init studies/saturations -o my-study.toml");
  verb->callback([options, &chosen] {
    if (options->example.empty() && !options->output.empty()) throw CLI::RequiredError("example");
    chosen = [options] { return options->example.empty() ? print_result(listed_examples()) : write_template(*options); };
  });
}

}  // namespace clathra
