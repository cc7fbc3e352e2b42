#include "scene_options.hpp"

#include <fmt/format.h>

#include "io/scene/scene_guard.hpp"
#include "read_once.hpp"

namespace clathra {

void SceneOptions::add_to(CLI::App& verb) {
  verb.add_option("scene", file, "scene file (TOML)")->required();
  verb.add_option(
          "--set", overrides,
          "override a key of the scene, as in --set test.confining_stress=\"2 MPa\"; KEY= takes one back; may be repeated")
      ->allow_extra_args(false)
      ->type_name("KEY=VALUE");
  verb.add_option("--threads", threads, "threads; results do not depend on them")->check(CLI::Range(1, 4096))->type_name("N");
  verb.add_flag("--ignore-guards", ignore_guards, "go on where a guard refuses; noted in run.json");
}

LoadedScene SceneOptions::load(std::vector<std::string> more) const {
  std::vector<std::string> all = overrides;
  if (threads > 0) all.push_back(fmt::format("run.threads={}", threads));
  if (ignore_guards) all.push_back("run.ignore_guards=true");
  all.insert(all.end(), more.begin(), more.end());
  std::filesystem::path const path = file;
  return parse_scene(read_once(path, largest_scene_file + 1), file, path.parent_path(), all);
}

}  // namespace clathra
