/// Any text is a study or is refused with its problems; the groups of a study have names that are files' names, each once.
#include <cstdint>
#include <set>

#include "io/scene/study_file.hpp"
#include "require.hpp"

using namespace clathra;

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  std::string const text(reinterpret_cast<char const*>(data), size);
  try {
    Study const study = parse_study(text, "fuzz.toml");
    std::set<std::string> names;
    for (StudyGroup const& group : study.groups) {
      require(!group.name.empty() && group.name.find('/') == std::string::npos && group.name.front() != '.');
      require(names.insert(group.name).second);
    }
    require(!study.groups.empty() && !study.seeds.empty());
  } catch (SceneProblems const& problems) {
    require(!problems.problems.empty());
    for (Problem const& problem : problems.problems) require(!problem.message().empty());
  }
  return 0;
}
