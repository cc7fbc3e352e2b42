/// `clathra init`: a commented scene file to start from.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <vector>

#include "io/formats/text_file.hpp"
#include "io/scene/scene_file.hpp"
#include "io/scene/scene_reference.hpp"
#include "terminal/print.hpp"
#include "verbs/examples.hpp"
#include "verbs/verbs.hpp"

namespace clathra {
namespace {

struct InitOptions {
  std::string example, output;
  bool list = false;
};

/// The comment lines that a scene begins with.
std::string_view opening_comment(std::string_view text) {
  std::size_t end = 0;
  while (end < text.size() && text[end] == '#') end = std::min(text.size(), text.find('\n', end) + 1);
  return text.substr(0, end);
}

/// Of lines that begin with '#', with its full stop.
std::string first_sentence(std::string_view comment) {
  std::string text;
  for (std::size_t k = 0; k < comment.size(); ++k) {
    if (comment[k] != '#') text += comment[k] == '\n' ? ' ' : comment[k];
    if (text.starts_with(' ')) text.erase(0, 1);
    if (text.ends_with("  ")) text.pop_back();
    bool const abbreviates = text.ends_with("al. ") || text.ends_with("Eq. ");
    if (text.ends_with(". ") && !abbreviates) break;
  }
  return text;
}

std::string listing() {
  std::string text;
  for (Example const& example : examples()) {
    text += fmt::format("{:<24} {}\n", example.name, first_sentence(opening_comment(example.text)));
  }
  return text;
}

ExitCode write_template(InitOptions const& options) {
  auto const found =
      std::find_if(examples().begin(), examples().end(), [&](Example const& e) { return e.name == options.example; });
  if (found == examples().end()) {
    std::vector<std::string_view> names;
    for (Example const& example : examples()) names.push_back(example.name);
    print_error(fmt::format("clathra: there is no example '{}'{}; `clathra init --list` names them all", options.example,
                            name_suggestion(options.example, names)));
    return ExitCode::usage;
  }
  std::filesystem::path const path =
      options.output.empty() ? std::filesystem::path(options.example).filename().string() + ".toml" : options.output;
  require_no_file(path, "-o names another file");
  LoadedScene const loaded = parse_scene(std::string(found->text), options.example, path.parent_path());
  replace_text_file(path, commented_scene(loaded.scene, loaded.stated, opening_comment(found->text), found->text),
                    Existing::kept);
  return print_result(fmt::format("{} is written; check it with: clathra check {}\n", path.string(), path.string()));
}

}  // namespace

void add_init(CLI::App& program, Verb& chosen) {
  auto const options = std::make_shared<InitOptions>();
  CLI::App* const verb = program.add_subcommand("init", "Write a commented scene file to start from");
  CLI::Option* const list = verb->add_flag("--list", options->list, "list the examples, as without an argument");
  verb->add_option("example", options->example, "the example to start from; without one, they are listed");
  verb->add_option("-o,--output", options->output, "file to write (default: the example's name in the current folder)")
      ->type_name("FILE")
      ->excludes(list);
  verb->footer("Example: clathra init quick -o my.toml");
  verb->callback([options, &chosen] {
    if (options->example.empty() && !options->output.empty()) throw CLI::RequiredError("example");
    chosen = [options] { return options->example.empty() ? print_result(listing()) : write_template(*options); };
  });
}

}  // namespace clathra
