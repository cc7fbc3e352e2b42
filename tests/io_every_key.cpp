/// Each key of a scene, away from its default: 300 discs are sheared to 1 % with it, and it moves the specimen or leaves its
/// bits.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "command.hpp"
#include "file_content.hpp"
#include "io/scene/scene_file.hpp"
#include "io/scene/scene_value.hpp"
#include "io/scene/schema.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

/// What a key does to the state in which a test of the same seed ends.
enum class Effect { moves, leaves };

struct KeyTest {
  std::string key, value;
  Effect effect;
  std::string with = "";      ///< other settings that it needs, ; between them, which may differ from the base too
  bool new_specimen = false;  ///< one is made with the key; else the base's is read
};

using enum Effect;
std::vector<KeyTest> const key_tests = {
    {"specimen.generator", "compression", moves, "", true},
    {"specimen.particles", "320", moves, "", true},
    {"specimen.void_ratio", "0.26", moves, "", true},
    {"specimen.void_ratio_at", "test", moves, "", true},
    {"specimen.width", "2 mm", moves, "specimen.particles=", true},
    {"specimen.height", "3.8 mm", moves, "specimen.particles=", true},
    {"specimen.aspect_ratio", "1.5", moves, "", true},
    {"specimen.compaction_layers", "2", moves, "", true},
    {"specimen.file", "specimen.h5", leaves, "", false},
    {"grains.density", "2700", moves, "", true},
    {"grains.normal_stiffness", "0.4 GPa", moves},
    {"grains.shear_stiffness", "0.3 GPa", moves},
    {"bond.grain_stiffness_factor", "1", moves},
    {"grains.friction", "0.4", moves},
    {"grains.rolling_width_factor", "1.5", moves},
    {"damping.viscous_ratio", "0.1", moves},
    {"grading.table", "uniform", moves, "specimen.void_ratio=0.22", true},
    {"grading.file", "sizes.csv", moves, "", true},
    {"grading.d50", "0.2 mm", moves, "", true},
    {"hydrate.saturation", "41 %", moves},
    {"hydrate.temperature", "2 degC", moves},
    {"hydrate.pore_pressure", "6 MPa", moves},
    {"hydrate.density", "850", moves},
    {"hydrate.salinity", "20", leaves},
    {"hydrate.spread_of_loss", "10 %", moves, "test.kind=heating;test.increments=2;test.final_saturation=25 %"},
    {"hydrate.loss", "recession", moves, "test.kind=heating;test.increments=2;test.final_saturation=25 %"},
    {"hydrate.loss_exponent", "2", moves, "hydrate.loss=uniform;test.kind=heating;test.increments=2;test.final_saturation=25 %"},
    {"bond.preset", "long_lever", moves},
    {"bond.law", "constant_thickness", moves},
    {"bond.contact_coupling", "replaces", moves},
    {"bond.rolling_lever", "0.1 B", moves},
    {"bond.thickness_mapping", "scaled", moves},
    {"bond.friction_floor", "true", moves},
    {"bond.strength_from", "printed", moves},
    {"bond.strength_modulus", "5", moves},
    {"bond.strength_seed", "2", moves, "bond.strength_modulus=5"},
    {"bond.critical_thickness_from", "bond_area", moves},
    {"bond.critical_thickness", "15 um", moves, "bond.critical_thickness_from=given"},
    {"bond.constant_thickness", "10 um", moves, "bond.law=constant_thickness"},
    {"specimen.preparation_stress", "100 kPa", moves, "", true},
    {"bond.after_consolidation", "false", moves},
    {"test.kind", "constant_mean_stress", moves},
    {"test.confining_stress", "1.5 MPa", moves},
    {"test.axial_strain", "0.8 %", moves},
    {"test.inertial_number", "9e-4", moves},
    {"test.strain_rate", "50", moves},
    {"test.max_platen_wave_stress", "0.02", moves},
    {"test.wall_friction", "0.3", moves},
    {"test.consolidation_steps", "100000", leaves},
    {"test.largest_stress", "1.2 MPa", moves, "test.kind=oedometer"},
    {"test.increments", "2", moves, "test.kind=isotropic;test.largest_stress=1.2 MPa"},
    {"test.unload_at", "0.3 %", moves, "test.kind=unload_reload"},
    {"test.cyclic_deviator_stress", "0.1 MPa,0.5 MPa", moves, "test.kind=cyclic;test.cycles=2"},
    {"test.cycles", "2", moves, "test.kind=cyclic;test.axial_strain=0.2 %"},
    {"test.fluid_modulus", "100 MPa", moves, "test.kind=constant_volume"},
    {"test.dead_load", "0.5 MPa", moves, "test.kind=creep"},
    {"test.final_temperature", "9 degC", moves, "test.kind=heating;test.increments=2;test.dead_load=4 MPa"},
    {"test.final_pore_pressure", "5 MPa", moves, "test.kind=depressurisation;test.increments=2"},
    {"test.final_saturation", "40 %", moves, "test.kind=heating;test.increments=2"},
    {"run.preset", "reference", moves},
    {"run.seed", "2", moves, "", true},
    {"run.threads", "2", leaves},
    {"run.precision", "double", moves},
    {"run.time_step_rule", "fixed", moves},
    {"run.time_step_safety", "0.5", moves},
    {"damping.local", "0.2", moves},
    {"run.rotational_inertia_factor", "2", moves},
    {"run.mass_scaled_fraction", "0.1", moves},
    {"run.verlet_skin", "0.03 mm", moves},
    {"run.ignore_guards", "true", leaves},
    {"output.folder", "elsewhere", leaves},
    {"output.records", "7", leaves},
    {"output.snapshots", "2", leaves},
    {"output.snapshots_at", "0.5 %", leaves},
    {"output.energy", "true", leaves},
    {"output.events", "false", leaves},
    {"output.event_details", "true", leaves},
    {"output.lossless_snapshots", "true", leaves, "output.snapshots=2"},
    {"output.keep_checkpoint", "false", leaves},
};

class EveryKey : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    fs::create_directories(folder());
    std::ofstream(folder() / "base.toml")
        << "[specimen]\nparticles = 300\n[hydrate]\nsaturation = \"55 %\"\n[test]\naxial_strain = \"1 %\"\n"
           "inertial_number = 8e-4\n[bond]\nrolling_lever = \"0.02 B\"\n[output]\nrecords = 5\nsnapshots = 0\n";
    std::ofstream(folder() / "sizes.csv") << "d_mm,percent_finer\n0.12,0\n0.16,50\n0.28,100\n";
    ASSERT_EQ(run_clathra("generate " + scene() + " -o " + (folder() / "specimen.h5").string()).code, 0);
  }
  static void TearDownTestSuite() { fs::remove_all(folder()); }
  static fs::path folder() { return fs::temp_directory_path() / ("clathra_keys_" + std::to_string(::getpid())); }
  static std::string scene() { return (folder() / "base.toml").string(); }
  /// @param texts  of --set, ; between them
  static std::string set(std::string texts) {
    std::string options;
    while (!texts.empty()) {
      std::string const one = texts.substr(0, texts.find(';'));
      options += " --set '" + one + "'";
      texts.erase(0, std::min(texts.size(), one.size() + 1));
    }
    return options;
  }

  /// run.json of the base, or with a key.
  static nlohmann::json sheared(KeyTest const& test) {
    fs::path const out = folder() / (test.key.empty() ? "base" : test.key);
    std::string const specimen = (folder() / "specimen.h5").string();
    std::string command = "run " + scene() + " --output " + out.string() + set(test.with);
    if (!test.new_specimen) command += set("specimen.file=" + specimen);
    bool const is_file = test.key == "specimen.file" || test.key == "grading.file";
    if (!test.key.empty()) command += set(test.key + "=" + (is_file ? (folder() / test.value).string() : test.value));
    CommandResult const result = run_clathra(command);
    EXPECT_EQ(result.code, 0) << command << "\n" << result.output;
    return nlohmann::json::parse(content(out / "run.json"), nullptr, false);
  }
};

TEST_F(EveryKey, IsTested) {
  for (Key const& key : schema())
    EXPECT_EQ(std::count_if(key_tests.begin(), key_tests.end(), [&](KeyTest const& test) { return test.key == key.name; }), 1)
        << key.name;
}

TEST_F(EveryKey, RunsAwayFromItsDefaultAndMovesTheSpecimenOrLeavesItsBits) {
  nlohmann::json const base = sheared({"", "", leaves});
  for (KeyTest const& test : key_tests) {
    nlohmann::json const run = sheared(test);
    ASSERT_TRUE(run.is_object()) << test.key;
    EXPECT_EQ(run["exit"]["reason"], "finished") << test.key;
    EXPECT_EQ(run["state_hash"] == base["state_hash"], test.effect == leaves) << test.key << " = " << test.value;
    if (run["stages"].contains("shear") && run["scene"]["test"]["kind"] != "unload_reload") {
      double const strain = run["stages"]["shear"]["end_eps1"], wanted = run["scene"]["test"]["axial_strain"];
      EXPECT_NEAR(strain, wanted, 0.01 * wanted) << test.key;
      EXPECT_GT(run["stages"]["shear"]["peak_q_Pa"].get<double>(), 1e5) << test.key;
    }
    for (auto const& [stage, numbers] : run["stages"].items())
      for (auto const& [name, value] : numbers.items())
        EXPECT_NE(run["meaning"].value("stages." + stage + "." + name, ""), "") << stage << " " << name;
    // What was stated is what is recorded, and what the resolved scene says; only the folder is that of --output.
    if (test.key == "output.folder") continue;
    Key const& key = *find_key(test.key);
    fs::path const resolved = folder() / test.key / "resolved.toml";
    EXPECT_NE(value_text(key, load_scene(resolved).scene), value_text(key, load_scene(scene()).scene)) << test.key;
  }
}

}  // namespace
}  // namespace clathra
