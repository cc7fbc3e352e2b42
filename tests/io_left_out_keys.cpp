/// Keys that a scene leaves out: 0 does not say so, an empty override does, and the resolved scene says what holds instead.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "io/scene/scene_file.hpp"
#include "io/scene/scene_value.hpp"
#include "io/scene/schema.hpp"
#include "loaded_scene.hpp"

namespace clathra {
namespace {

std::string refusal_of(std::string const& text, Texts const& overrides = {}) {
  try {
    (void)load(text, overrides);
  } catch (SceneProblems const& problems) {
    return problems.what();
  }
  return "none";
}

TEST(LeftOutKeys, AreNotStatedAsZeroButWhereZeroMeansSomething) {
  int keys = 0;
  for (Key const& key : schema()) {
    if (key.zero.empty() || key.least <= 0) continue;
    ++keys;
    std::string const said = std::string(key.name) + "=0", problem = refusal_of(sized, {said});
    if (key.takes_zero)
      EXPECT_EQ(problem, "none") << said;
    else
      EXPECT_NE(problem.find("'" + std::string(key.name) + "' must lie between "), std::string::npos) << said << problem;
  }
  EXPECT_GE(keys, 12);
  EXPECT_EQ(refusal_of("[specimen]\nparticles = 0\nwidth = \"10 mm\"\n"),
            "my.toml:2:13: error: 'particles' must lie between 16 and 1000000000, got 0; where the key is left out: it follows "
            "from the others");
  EXPECT_EQ(load(sized + "[test]\nmax_platen_wave_stress = 0\n[output]\nsnapshots = 0\n").scene.test.max_platen_wave_stress, 0);
}

TEST(LeftOutKeys, AreTakenBackByAnEmptyOverride) {
  std::string const file =
      "[specimen]\nparticles = 2000\nvoid_ratio = 0.3\ncompaction_layers = 3\n[grains]\nfriction = 0.3\n[run]\n"
      "preset = \"draft\"\nignore_guards = true\nverlet_skin = \"0.02 mm\"\n[output]\nsnapshots_at = [\"1 %\"]\n";
  Scene const scene = load(file, {"specimen.void_ratio=", "specimen.compaction_layers=", "grains.friction=", "run.preset=",
                                  "run.ignore_guards=", "run.verlet_skin=", "output.snapshots_at="})
                          .scene;
  Scene const plain = load(sized).scene;
  for (Key const& key : schema()) EXPECT_EQ(value_text(key, scene), value_text(key, plain)) << key.name;
  EXPECT_EQ(load(file, {"specimen.particles=", "specimen.width=10 mm"}).scene.specimen.particles, 0);
}

/// A rate that is taken back takes nothing else along, as one that is stated does.
TEST(LeftOutKeys, LeaveTheOtherRateOfTheFile) {
  std::string const slow = sized + "[test]\ninertial_number = 1e-5\nmax_platen_wave_stress = 0.02\n",
                    lab = sized + "[test]\nstrain_rate = 10\n";
  Scene const kept = load(slow, {"test.strain_rate="}).scene;
  EXPECT_EQ(kept.test.inertial_number, 1e-5);
  EXPECT_EQ(kept.test.max_platen_wave_stress, 0.02);
  EXPECT_EQ(load(lab, {"test.inertial_number="}).scene.test.strain_rate, 10);
  EXPECT_EQ(load(lab, {"test.strain_rate="}).scene.test.inertial_number, load(sized).scene.test.inertial_number);
}

TEST(LeftOutKeys, AreCommentsOfTheResolvedScene) {
  std::string const text = resolved_scene(load(sized).scene, ".");
  EXPECT_NE(text.find("# width is not given: it follows from the others\n"), std::string::npos) << text;
  EXPECT_NE(text.find("# verlet_skin is not given: chosen\n"), std::string::npos) << text;
  for (Key const& key : schema()) EXPECT_NE(text.find(std::string(key.leaf())), std::string::npos) << key.name;
  EXPECT_EQ(refusal_of(text), "none");
}

}  // namespace
}  // namespace clathra
