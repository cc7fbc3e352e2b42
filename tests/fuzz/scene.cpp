/// Any text is a scene or is refused with its problems; a scene reads back from its echo to the same scene.
#include <cstdint>

#include "io/scene/scene_file.hpp"
#include "require.hpp"

using namespace clathra;

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  std::string const text(reinterpret_cast<char const*>(data), size);
  try {
    LoadedScene const loaded = parse_scene(text, "fuzz.toml", ".");
    std::string const echo = resolved_scene(loaded.scene, ".");
    require(resolved_scene(parse_scene(echo, "echo.toml", ".").scene, ".") == echo);
  } catch (SceneProblems const& problems) {
    require(!problems.problems.empty());
    for (Problem const& problem : problems.problems) require(!problem.message().empty());
  }
  return 0;
}
