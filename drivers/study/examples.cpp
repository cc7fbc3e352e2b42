#include "study/examples.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "io/formats/text_file.hpp"
#include "io/scene/scene_file.hpp"
#include "io/scene/scene_reference.hpp"
#include "io/scene/study_file.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

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

std::string write_scene(Example const& example, fs::path const& path) {
  LoadedScene const loaded = parse_scene(std::string(example.text), std::string(example.name), path.parent_path());
  replace_text_file(path, commented_scene(loaded.scene, loaded.stated, opening_comment(example.text), example.text),
                    Existing::kept);
  return fmt::format("{} is written; check it with: clathra check {}\n", path.string(), path.string());
}

void replace(std::string& text, std::string const& from, std::string const& to) {
  if (std::size_t const at = text.find(from); at != text.npos) text.replace(at, from.size(), to);
}

/// The study, and beside it the scene that it is of, where there is no file of that name.
std::string write_study(Example const& example, fs::path const& path) {
  std::string text(example.text);
  std::string const scene = parse_study(text, std::string(example.name) + ".toml").scene.string();  // "quick.toml"
  fs::path const beside = path.parent_path() / fs::path(scene).filename();
  replace(text, fmt::format("\"../{}\"", scene), fmt::format("\"{}\"", beside.filename().string()));
  replace(text, fmt::format("examples/{}.toml", example.name), path.string());
  std::error_code ignored;
  std::string said = fs::exists(beside, ignored)
                         ? fmt::format("{} is there already and stays\n", beside.string())
                         : write_scene(*example_named(fs::path(scene).replace_extension().string()), beside);
  replace_text_file(path, text, Existing::kept);
  return said + fmt::format("{} is written; see what it costs with: clathra study {} --dry-run\n", path.string(), path.string());
}

}  // namespace

Example const* example_named(std::string_view name) {
  auto const found = std::find_if(examples().begin(), examples().end(), [&](Example const& e) { return e.name == name; });
  return found == examples().end() ? nullptr : &*found;
}

std::string listed_examples() {
  std::string text;
  for (Example const& example : examples()) {
    text += fmt::format("{:<24} {}\n", example.name, first_sentence(opening_comment(example.text)));
  }
  return text;
}

std::string write_example(Example const& example, fs::path const& path) {
  return example.name.starts_with("studies/") ? write_study(example, path) : write_scene(example, path);
}

}  // namespace clathra
