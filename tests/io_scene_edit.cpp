/// Scene files with some keys set anew.
#include <gtest/gtest.h>

#include "io/scene/scene_edit.hpp"
#include "io/scene/scene_file.hpp"
#include "io/scene/scene_value.hpp"
#include "io/scene/schema.hpp"

namespace clathra {
namespace {

std::vector<SceneEdit> const edits = {{"test.inertial_number", "0.001", "error +0.3 %"},
                                      {"test.max_platen_wave_stress", "0.2", ""},
                                      {"run.precision", "\"mixed\"", "32 bits"}};

Scene wanted_of(std::string const& source) {
  std::vector<std::string> overrides;
  for (SceneEdit const& edit : edits) overrides.push_back(edit.key + "=" + std::string(unquoted(edit.value)));
  return parse_scene(source, "my.toml", ".", overrides).scene;
}

TEST(SceneEdit, ReplacesLinesAddsOthersAndLeavesTheRestAsItIs) {
  std::string const source =
      "# my scene\n[specimen]\nparticles = 2000   # enough\n\n[test]  # loading\naxial_strain = \"6 %\"\ninertial_number = 1e-4 "
      "# "
      "I\n";
  EXPECT_EQ(edited_scene_text(source, edits),
            "# my scene\n[specimen]\nparticles = 2000   # enough\n\n[test]  # loading\nmax_platen_wave_stress = "
            "0.2\naxial_strain = \"6 %\"\n"
            "# inertial_number = 1e-4 # I\n# error +0.3 %\ninertial_number = 0.001\n"
            "\n[run]\n# 32 bits\nprecision = \"mixed\"\n");
  std::string const dotted = "specimen.particles = 300\ntest.inertial_number = 1e-4\n";
  EXPECT_NE(
      edited_scene_text(dotted, edits).find("# test.inertial_number = 1e-4\n# error +0.3 %\ntest.inertial_number = 0.001\n"),
      std::string::npos);
}

/// However a scene is written, what comes out loads to what was wanted.
TEST(SceneEdit, OfAnyWayToWriteASceneLoadsToTheSceneThatWasWanted) {
  for (std::string const source :
       {"[specimen]\nparticles = 2000\n", "specimen.particles = 2000\ntest.axial_strain = 0.1\ndamping.local = 0.2\n",
        "specimen = { particles = 2000 }\ntest = { inertial_number = 1e-4, axial_strain = \"3 %\" }\n",
        "[specimen]\r\nparticles = 2000\r\n[test]\r\n\"inertial_number\" = 1e-4\r\n",
        "[specimen]\nparticles = 2000\n[test]\nstrain_rate = \"5 %/min\"\n[run]\nprecision = 'double' # all\n",
        "[specimen]\nparticles = 2000\n[output]\nsnapshots_at = [\"1 %\",\n  \"2 %\"]\nfolder = \"a = b\""}) {
    Scene const wanted = wanted_of(source);
    std::string const text = scene_text_for(wanted, source, edits, {"test.strain_rate"}, ".");
    Scene const loaded = parse_scene(text, "tuned.toml", ".").scene;
    for (Key const& key : schema()) EXPECT_EQ(value_text(key, loaded), value_text(key, wanted)) << key.name << "\n" << text;
    EXPECT_NE(text.find("error +0.3 %"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace clathra
