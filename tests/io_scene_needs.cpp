/// What each example scene keeps and launches, scene by scene: tests/golden/scene_needs.txt.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "command.hpp"
#include "domain/biaxial/scene_needs.hpp"
#include "file_content.hpp"
#include "io/scene/scene_file.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

/// A line a scene: bytes a disc and an entry, fields beside those of every scene, and what the contact kernel does.
std::string needs_of_examples() {
  std::ostringstream text;
  for (fs::path const& path : example_scenes()) {
    SceneNeeds const needs = needs_of(load_scene(path).scene);
    text << fs::relative(path, CLATHRA_EXAMPLES).string() << ": " << needs.bytes(FieldOf::disc) << " a particle, "
         << needs.bytes(FieldOf::entry) << " an entry;";
    for (NeededField const& field : needs.fields)
      if (field.asked_by != "every scene") text << ' ' << field.name;
    for (NeededKernel const& kernel : needs.kernels) text << "; " << kernel.name << ": " << kernel.does;
    text << '\n';
  }
  return text.str();
}

// CLATHRA_RECORD=1 writes the record anew.
TEST(SceneNeeds, OfTheExamplesAreThoseOnRecord) {
  if (std::getenv("CLATHRA_RECORD")) std::ofstream(CLATHRA_GOLDEN "/scene_needs.txt") << needs_of_examples();
  std::ifstream file(CLATHRA_GOLDEN "/scene_needs.txt");
  std::string const golden((std::istreambuf_iterator<char>(file)), {});
  EXPECT_EQ(needs_of_examples(), golden);
}

TEST(SceneNeeds, AreWhatInfoPrints) {
  CommandResult const out = run_clathra("info --cost " CLATHRA_EXAMPLES "/sand.toml");
  EXPECT_EQ(out.code, 0);
  for (char const* const part : {"bytes a particle", "friction", "output.snapshots", "kick_and_drift"})
    EXPECT_NE(out.output.find(part), std::string::npos) << part;
  EXPECT_EQ(out.output.find("hydrate"), std::string::npos) << "nothing of bonds is there";
  EXPECT_EQ(run_clathra("info --cost nowhere.toml").code, 66);
  fs::path const scene = fs::temp_directory_path() / ("clathra_needs_" + std::to_string(::getpid()) + ".toml");
  std::ofstream(scene) << std::ifstream(CLATHRA_EXAMPLES "/quick.toml").rdbuf() << "event_details = true\n";
  CommandResult const detailed = run_clathra("info --cost " + scene.string());
  EXPECT_NE(detailed.output.find("64 bytes a bond"), std::string::npos) << detailed.output;
  EXPECT_NE(detailed.output.find("output.event_details"), std::string::npos) << detailed.output;
  fs::remove(scene);
}

}  // namespace
}  // namespace clathra
