/// What keys may be: limits that are right, what 0 stands for, names that other programs have for a key.
#include <gtest/gtest.h>

#include "io/scene/scene_file.hpp"
#include "io/scene/scene_reference.hpp"
#include "io/scene/schema.hpp"
#include "loaded_scene.hpp"

namespace clathra {
namespace {

std::string problems_with(std::vector<std::string> const& overrides) {
  try {
    (void)parse_scene(sized, "a.toml", ".", overrides);
  } catch (SceneProblems const& problems) {
    return problems.what();
  }
  return "none";
}

TEST(KeyLimits, SayWhatZeroStandsFor) {
  EXPECT_EQ(allowed_values(*find_key("hydrate.saturation")), "0 (clean sand) to 1");
  EXPECT_EQ(allowed_values(*find_key("output.snapshots")), "0 (none), or 1 to 100000");
  for (Key const& key : schema())
    if (key.takes_zero) EXPECT_FALSE(key.zero.empty()) << key.name;
  EXPECT_EQ(problems_with({"grains.friction=6"}),
            "--set grains.friction=6: error: 'grains.friction' must lie between 0 and 5, got 6");
  EXPECT_EQ(problems_with({"output.snapshots=-1"}),
            "--set output.snapshots=-1: error: 'output.snapshots' must lie between 1 and 100000, or be 0 (none), got -1");
  EXPECT_NE(problems_with({"grains.density=31 t/m^3"}).find("between 100 kg/m^3 and 30000 kg/m^3, got 31000 kg/m^3"),
            std::string::npos);
}

TEST(KeyLimits, OfTheSeedAreWholeNumbersThatEveryFormatHolds) {
  EXPECT_EQ(allowed_values(*find_key("run.seed")), "0 to 9007199254740992");
  EXPECT_EQ(problems_with({"run.seed=9007199254740992"}), "none");
  EXPECT_NE(problems_with({"run.seed=9007199254740993"}).find("must lie between 0 and 9007199254740992"), std::string::npos);
  EXPECT_NE(problems_with({"run.seed=9223372036854775808"}).find("must lie between"), std::string::npos);
}

TEST(KeyLimits, ASnapshotIsTakenAtARecord) {
  EXPECT_NE(problems_with({"output.records=10", "output.snapshots=11"})
                .find("'output.snapshots' (11) must not exceed 'output.records' (10)"),
            std::string::npos);
  EXPECT_EQ(parse_scene(sized, "a.toml", ".", {"output.records=10"}).scene.output.snapshots, 10)
      << "the default, as far as it goes";
  EXPECT_EQ(parse_scene(sized, "a.toml", ".", {}).scene.output.snapshots, 15);
}

TEST(KeyLimits, ARecordMustBeNearThePeak) {
  auto const warnings = [](std::vector<std::string> const& overrides) {
    std::string all;
    for (std::string const& one : parse_scene(sized, "a.toml", ".", overrides).warnings) all += one + "\n";
    return all;
  };
  EXPECT_NE(warnings({"output.records=100"}).find("rows of history.csv are 0.15 % of strain apart: the volumetric strain"),
            std::string::npos);
  EXPECT_NE(warnings({"output.records=100"}).find("raise output.records to 150 or more"), std::string::npos);
  EXPECT_EQ(warnings({"output.records=150"}), "");
  EXPECT_EQ(warnings({"output.records=10", "test.axial_strain=1 %"}), "") << "no peak is there yet";
}

TEST(KeyLimits, HintsAreThoseOfTheKey) {
  EXPECT_NE(problems_with({"hydrate.saturation=41"}).find("this looks like percent: write 0.41"), std::string::npos);
  for (char const* const text : {"hydrate.saturation=1.1", "test.inertial_number=2"})
    EXPECT_EQ(problems_with({text}).find("percent"), std::string::npos) << text;
  EXPECT_NE(problems_with({"test.inertial_number=0"}).find("got 0; where the key is left out: 2e-04"), std::string::npos);
}

TEST(KeyNames, OfPapersAndOtherProgramsLeadToTheKey) {
  EXPECT_NE(problems_with({"grains.kn=1"}).find("did you mean 'grains.normal_stiffness'?"), std::string::npos);
  EXPECT_NE(problems_with({"mu=1"}).find("did you mean 'grains.friction'?"), std::string::npos);
  EXPECT_NE(problems_with({"test.sigma3=1"}).find("did you mean 'test.confining_stress'?"), std::string::npos);
  for (auto const& [name, hint] : std::vector<std::pair<std::string, std::string>>{
           {"young", "'grains.normal_stiffness' (of a contact, per metre thickness)?"},
           {"bond.young", "'hydrate.pore_pressure' (the stiffness of hydrate follows from its temperature, "},
           {"grains.friction_angle", "'grains.friction' (the tangent of the angle)?"},
           {"box", "'specimen.width' (and 'height')?"},
           {"specimen.box", "'specimen.width' (and 'height')?"},
           {"hydrate.rho", "'hydrate.density'?"},
           {"hydrat.densty", "'hydrate.density'?"},
           {"grains.stiffness", "'grains.normal_stiffness' or 'grains.shear_stiffness'?"},
           {"specimen.pressure", "'specimen.preparation_stress'?"},
           {"pressure", "'test.confining_stress'?"},
           {"grains.saturaton", "'hydrate.saturation'?"}})
    EXPECT_NE(problems_with({name + "=1"}).find("did you mean " + hint), std::string::npos) << problems_with({name + "=1"});
}

TEST(KeysStatedTwice, AreNamedWithBothLines) {
  auto const said = [](std::string const& text) {
    try {
      (void)parse_scene(text, "a.toml", ".", {});
    } catch (SceneProblems const& problems) {
      return std::string(problems.what());
    }
    return std::string("none");
  };
  EXPECT_EQ(said(sized + "[hydrate]\nsaturation = 0.3 # first\n\n\"saturation\" = 0.4\n"),
            "a.toml:6:1: error: 'hydrate.saturation' is stated twice, in lines 4 and 6: leave one of them out");
  EXPECT_EQ(said(sized + "[test]\naxial_strain = 0.1\n[specimen]\nwidth = 1\n"),
            "a.toml:5:1: error: the section [specimen] begins twice, in lines 1 and 5: write the keys of both below one");
  EXPECT_NE(said(sized + "[test.axial_strain]\na = 1\n[test]\naxial_strain = 2\n").find("a.toml:6:"), std::string::npos);
}

}  // namespace
}  // namespace clathra
