/// The key bond.rolling_lever: a length, or a part of the bond width.
#include <gtest/gtest.h>

#include <stdexcept>

#include "io/scene/rolling_lever_text.hpp"
#include "io/scene/scene_file.hpp"
#include "io/scene/scene_value.hpp"

namespace clathra {
namespace {

std::string problem(std::string const& text) {
  try {
    (void)parse_rolling_lever(text);
  } catch (std::invalid_argument const& refused) {
    return refused.what();
  }
  return "none";
}

TEST(RollingLever, IsALengthOrAPartOfTheBondWidth) {
  EXPECT_EQ(parse_rolling_lever("1 m"), (RollingLever{1, 0}));
  EXPECT_EQ(parse_rolling_lever(" 1 mm "), (RollingLever{1e-3, 0}));
  EXPECT_EQ(parse_rolling_lever("0.25 B"), (RollingLever{0, 0.25}));
  EXPECT_EQ(parse_rolling_lever("0.25B"), (RollingLever{0, 0.25}));
  EXPECT_EQ(parse_rolling_lever("B/4"), (RollingLever{0, 0.25}));
  EXPECT_EQ(parse_rolling_lever("B / 14"), (RollingLever{0, 1.0 / 14}));
  EXPECT_EQ(parse_rolling_lever("B"), (RollingLever{0, 1}));
}

TEST(RollingLever, IsWrittenSoThatItReadsBackToTheSameBits) {
  EXPECT_EQ(format_rolling_lever({1e-3, 0}), "1 mm");
  EXPECT_EQ(format_rolling_lever({0, 0.25}), "0.25 B");
  for (RollingLever const& lever :
       {RollingLever{0, 1.0 / 14}, RollingLever{0, 1.0 / 3}, RollingLever{1.0 / 3, 0}, RollingLever{}})
    if (lever != RollingLever{}) EXPECT_EQ(parse_rolling_lever(format_rolling_lever(lever)), lever);
}

TEST(RollingLever, SaysWhatIsWrongWithOthers) {
  EXPECT_EQ(problem("0.25"), "needs a length (\"1 mm\") or a part of the bond width B (\"0.25 B\", \"B/4\"), got '0.25'");
  for (char const* const text : {"0 B", "-1 B", "11 B", "B/0", "B/20000", "0 m", "11 m", "1 nm"})
    EXPECT_NE(problem(text).find("must lie in 1 um to 10 m, or 1e-04 B to 10 B, got '"), std::string::npos)
        << text << problem(text);
  for (char const* const text : {"", "B/", "B*4", "x B", "nan B", "1 MPa", "1 kg", "inf"})
    EXPECT_NE(problem(text), "none") << text;
}

TEST(RollingLever, StandsInScenesOverridesAndTheirEcho) {
  std::string const text = "[specimen]\nparticles = 2000\n[hydrate]\nsaturation = \"55 %\"\n[bond]\nrolling_lever = \"1 mm\"\n";
  Scene const scene = parse_scene(text, "a.toml", ".", {}).scene;
  EXPECT_EQ(scene.bond.rolling_lever, (RollingLever{1e-3, 0}));
  EXPECT_EQ(parse_scene(resolved_scene(scene, "."), "b.toml", ".", {}).scene.bond.rolling_lever, scene.bond.rolling_lever);
  EXPECT_EQ(parse_scene(text, "a.toml", ".", {"bond.rolling_lever=0.1 B"}).scene.bond.rolling_lever, (RollingLever{0, 0.1}));
  EXPECT_EQ(parse_scene(text, "a.toml", ".", {"bond.rolling_lever="}).scene.bond.rolling_lever, (RollingLever{0, 0.25}));
  try {
    (void)parse_scene("[specimen]\nparticles = 2000\n[bond]\nrolling_lever = 0.25\n", "a.toml", ".", {});
    ADD_FAILURE() << "a bare number has two meanings";
  } catch (SceneProblems const& problems) {
    EXPECT_NE(std::string(problems.what()).find("a.toml:4:17: error: 'rolling_lever' needs "), std::string::npos)
        << problems.what();
  }
}

}  // namespace
}  // namespace clathra
