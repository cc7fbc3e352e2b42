#include "reproduce/reproduction.hpp"

#include <fmt/format.h>

#include "io/formats/text_file.hpp"
#include "io/scene/schema.hpp"
#include "io/scene/study_members.hpp"

namespace clathra {

Study reproduction_study(Paper const& paper, ReproductionSize const& size, std::filesystem::path const& folder,
                         std::filesystem::path const& scene) {
  Study study;
  study.folder = folder;
  study.scene = scene;
  study.file = folder / "scene.toml";
  study.seeds_stated = true;
  for (int k = 0; k < size.tests.seeds; ++k) study.seeds.push_back(size.first_seed + static_cast<std::uint64_t>(k));
  study.groups = paper.groups;
  for (StudyGroup const& group : study.groups)
    for (Setting const& setting : group.settings) add_key(study, setting.first);
  std::string shared = "# What all tests of `clathra reproduce` share; the rest is the default of `clathra`.\n";
  for (auto const& [key, value] : paper.shared) {
    bool const path = find_key(key)->kind == Kind::path && !value.empty();
    shared += fmt::format("{} = {}\n", key, in_quotes(path ? std::filesystem::absolute(value).string() : value));
  }
  replace_text_file(study.scene, shared + fmt::format("specimen.particles = {}\n", size.tests.particles));
  return study;
}

}  // namespace clathra
