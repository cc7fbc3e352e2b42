/// Named sets of keys: readings of the paper and points of the trade of speed for accuracy.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "io/scene/presets.hpp"
#include "io/scene/scene_comparison.hpp"
#include "io/scene/scene_file.hpp"
#include "io/scene/scene_value.hpp"
#include "io/scene/schema.hpp"
#include "loaded_scene.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;
TEST(ScenePresets, APresetStandsInForTheDefaultsThatAreNotStated) {
  for (PresetGroup const* const group : {&bond_presets(), &run_presets()})
    for (Preset const& preset : group->presets) {
      std::string const named = std::string(group->key) + "=" + std::string(preset.name);
      Texts const stated = {"bond.rolling_lever=0.3 B", "bond.contact_coupling=replaces_keeping_force",
                            "run.rotational_inertia_factor=2", "test.inertial_number=3e-4", "test.max_platen_wave_stress=0.3"};
      Scene const scene = load(sized, {named}).scene;
      Texts overrides = stated;
      overrides.push_back(named);
      Scene const other = load(sized, overrides).scene;
      EXPECT_EQ(other.bond.rolling_lever, (RollingLever{0, 0.3}));
      EXPECT_EQ(other.bond.contact_coupling, ContactCoupling::replaces_keeping_force);
      EXPECT_EQ(other.run.rotational_inertia_factor, 2);
      EXPECT_EQ(other.test.inertial_number, 3e-4);
      ASSERT_EQ(preset.keys.size(), group->presets.front().keys.size());
      for (PresetKey const& said : preset.keys) {
        EXPECT_EQ(said.key, group->presets.front().keys[static_cast<std::size_t>(&said - preset.keys.data())].key);
        Key const& key = *find_key(said.key);
        Scene wanted;
        set_stated(key, wanted, said.value);
        EXPECT_EQ(value_text(key, scene), value_text(key, wanted)) << preset.name << ": " << said.key;
        if (std::none_of(stated.begin(), stated.end(), [&](auto const& text) { return text.starts_with(said.key); })) {
          EXPECT_EQ(value_text(key, other), value_text(key, wanted)) << preset.name << ": " << said.key;
        }
      }
    }
}

TEST(ScenePresets, TheFirstPresetsAreTheDefaults) {
  Scene const defaults, usual = load(sized).scene;
  EXPECT_EQ(defaults.bond.preset, bond_presets().presets.front().name);
  EXPECT_EQ(defaults.run.preset, run_presets().presets.front().name);
  for (PresetGroup const* const group : {&bond_presets(), &run_presets()})
    for (PresetKey const& said : group->presets.front().keys)
      EXPECT_EQ(value_text(*find_key(said.key), defaults), value_text(*find_key(said.key), usual)) << said.key;
  for (auto const& [text, hint] : {std::pair("bond.preset=litteral", "literal"), std::pair("run.preset=standart", "standard")})
    try {
      load(sized, {text});
      ADD_FAILURE() << text;
    } catch (SceneProblems const& problems) {
      EXPECT_NE(std::string(problems.what()).find(std::string("did you mean '") + hint + "'?"), std::string::npos)
          << problems.what();
    }
}

TEST(ScenePresets, AStatedStrainRateIsNoAffairOfAnAccuracy) {
  for (std::string_view const name : run_presets().names) {
    std::string const accuracy = "[run]\npreset = \"" + std::string(name) + "\"\n";
    Scene const stated = load(sized + accuracy + "[test]\nstrain_rate = \"5 %/min\"\n").scene;
    EXPECT_EQ(stated.test.strain_rate, 0.05 / 60);
    EXPECT_EQ(stated.test.inertial_number, 0);
    EXPECT_EQ(stated.test.max_platen_wave_stress, 0);
    EXPECT_EQ(load(sized + accuracy, {"test.strain_rate=5 %/min"}).scene.test.max_platen_wave_stress, 0);
    EXPECT_GT(load(sized + accuracy + "[test]\nstrain_rate = 1\n", {"test.inertial_number=1e-3"}).scene.test.inertial_number, 0);
  }
}

TEST(ScenePresets, GrainsThatAreTooStiffForMixedPrecisionGetDouble) {
  std::string const stiff = sized + "[grains]\nnormal_stiffness = 1.1e10\n",
                    soft = sized + "[grains]\nnormal_stiffness = 0.9e10\n";
  for (std::string const name : {"standard", "draft"}) {
    EXPECT_EQ(load(stiff, {"run.preset=" + name}).scene.run.precision, Precision::full) << name;
    EXPECT_EQ(load(soft, {"run.preset=" + name}).scene.run.precision, Precision::mixed) << name;
    EXPECT_EQ(load(stiff, {"run.preset=" + name, "run.precision=mixed"}).scene.run.precision, Precision::mixed) << "stated";
  }
}

TEST(ScenePresets, TheEchoOfAnAccuracyLoadsToItsValues) {
  for (std::string_view const name : run_presets().names) {
    Scene const scene = load(sized, {"run.preset=" + std::string(name)}).scene;
    Scene const again = parse_scene(resolved_scene(scene, "."), "resolved.toml", ".").scene;
    for (Key const& key : schema()) EXPECT_EQ(value_text(key, scene), value_text(key, again)) << name << ": " << key.name;
  }
}

TEST(ScenePresets, TheNameOfAnAccuracyIsNoDifferenceItsValuesAre) {
  Scene const draft = load(sized, {"run.preset=draft"}).scene;
  Texts same;
  for (PresetKey const& said : run_presets().of("draft").keys)
    same.push_back(std::string(said.key) + "=" + std::string(said.value));
  EXPECT_EQ(scene_differences(scene_texts(draft, "."), load(sized, same).scene, "."), "");
  std::string const other = scene_differences(scene_texts(draft, "."), load(sized).scene, ".");
  EXPECT_NE(other.find("; test.inertial_number was "), std::string::npos) << other;
  EXPECT_EQ(other.find("accuracy"), std::string::npos) << other;
}

/// A run in each accuracy, and what becomes of it when it is resumed.
TEST(ScenePresets, EachAccuracyRunsAndIsResumedInItsOwnOnly) {
  fs::path const folder = fs::temp_directory_path() / ("clathra_accuracy_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  std::string const scene = (folder / "small.toml").string();
  std::ofstream(scene)
      << "[specimen]\nfile = \"" CLATHRA_GOLDEN
         "/specimen.h5\"\n[hydrate]\nsaturation = 0.55\n[test]\naxial_strain = \"0.1 %\"\n[output]\nrecords = 5\n";
  auto const run = [&](std::string const& accuracy, std::string const& more = "") {
    return run_clathra("run '" + scene + "' --threads 1 --set run.preset=" + accuracy + " --output '" +
                       (folder / "out").string() + "' " + more);
  };
  for (std::string const accuracy : {"standard", "draft"}) {
    CommandResult const first = run(accuracy, "--overwrite");
    ASSERT_EQ(first.code, 0) << first.output;
    auto const record = nlohmann::json::parse(std::ifstream(folder / "out" / "run.json"));
    EXPECT_EQ(record["scene"]["run"]["preset"], accuracy);
    for (PresetKey const& said : run_presets().of(accuracy).keys) {
      Scene wanted;
      set_stated(*find_key(said.key), wanted, said.value);
      Scene const resolved = load_scene(folder / "out" / "resolved.toml").scene;
      EXPECT_EQ(value_text(*find_key(said.key), resolved), value_text(*find_key(said.key), wanted)) << said.key;
    }
    CommandResult const again = run(accuracy, "--resume");
    EXPECT_EQ(again.code, 0) << again.output;
    EXPECT_NE(again.output.find("this run is finished"), std::string::npos) << again.output;
    CommandResult const other = run(accuracy == "draft" ? "standard" : "draft", "--resume");
    EXPECT_EQ(other.code, 73) << other.output;
    EXPECT_NE(other.output.find("test.inertial_number was"), std::string::npos) << other.output;
  }
  fs::remove_all(folder);
}

}  // namespace
}  // namespace clathra
