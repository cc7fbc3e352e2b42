#include "verbs/scene_options.hpp"

#include <fmt/format.h>

#include "io/scene/scene_guard.hpp"
#include "run/read_once.hpp"
#include "terminal/status.hpp"
#include "verbs/verbs.hpp"

namespace clathra {

void SceneOptions::add_to(CLI::App& verb) {
  verb.add_option("scene", file, "scene file (TOML)")->required();
  verb.add_option(
          "--set", overrides,
          "override a key of the scene, as in --set test.confining_stress=\"2 MPa\"; KEY= restores the default; may be repeated")
      ->allow_extra_args(false)
      ->type_name("KEY=VALUE");
  verb.add_option("--threads", threads, "threads; results do not depend on them")->check(CLI::Range(1, 4096))->type_name("N");
  verb.add_flag("--ignore-guards", ignore_guards, "run although a guard refuses (I above 0.01, ...); run.json says so");
}

LoadedScene SceneOptions::load(std::vector<std::string> more) const {
  std::vector<std::string> all = overrides;
  if (threads > 0) all.push_back(fmt::format("run.threads={}", threads));
  if (ignore_guards) all.push_back("run.ignore_guards=true");
  all.insert(all.end(), more.begin(), more.end());
  std::filesystem::path const path = file;
  return parse_scene(read_once(path, largest_scene_file + 1), file, path.parent_path(), all);
}

CLI::Option* add_figures_option(CLI::App& verb, std::filesystem::path& folder) {
  return verb
      .add_option("--figures", folder, "also write each figure of the page as SVG, PDF and the CSV behind it, into this folder")
      ->type_name("DIR")
      ->check(CLI::Validator(name_problem, ""));
}

CLI::Option* add_data_option(CLI::App& verb, std::filesystem::path& file) {
  return verb
      .add_option("--data", file,
                  "points of your own laboratory, laid over the figures of the page (CSV; docs/howto/laboratory-data.md)")
      ->type_name("FILE");
}

void add_status_option(CLI::App& verb) {
  verb.add_option_function<std::string>("--status", [](std::string const& file) { open_status(file); })->group("");
}

}  // namespace clathra
