/// `clathra tune` on scenes so small that its runs take a moment each.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>

#include "command.hpp"
#include "io/formats/text_file.hpp"
#include "io/scene/scene_file.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

class TuneCommand : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder);
    std::ofstream(scene) << "# mine\n[specimen]\nparticles = 300\ncompaction_layers = 2\n[test]\naxial_strain = \"0.2 %\"\n"
                            "inertial_number = 2e-4  # as ever\n[output]\nrecords = 10\nsnapshots = 0\n";
  }
  void TearDown() override { fs::remove_all(folder); }
  CommandResult tune(std::string const& more) const {
    return run_clathra("tune '" + scene.string() + "' -o '" + tuned.string() + "' --folder '" + (folder / "runs").string() +
                       "' " + more);
  }

  fs::path const folder = fs::temp_directory_path() / ("clathra_tune_command_" + std::to_string(::getpid()));
  fs::path const scene = folder / "mine.toml", tuned = folder / "tuned.toml";
};

TEST_F(TuneCommand, WritesASceneWithTheCheapestSettingThatIsWithinTheTolerance) {
  // Costs follow the measured speed of the machine, which tests beside this one may measure anew between its two searches.
  ::setenv("XDG_CACHE_HOME", (folder / "cache").c_str(), 1);
  CommandResult const result = tune("--tolerance 60% --quantity peak_q --max-walltime 10min");
  ASSERT_EQ(result.code, 0) << result.output;
  EXPECT_NE(result.output.find("mine.toml: error of peak_q_Pa, tests of 300 particles\n"), std::string::npos) << result.output;
  EXPECT_TRUE(std::regex_search(result.output, std::regex("\n  0\\.003 +\\S+ +double  0\\.475  x1 +[5-9] +[+-]\\S+ ± ")))
      << result.output;
  EXPECT_TRUE(std::regex_search(result.output, std::regex("\n  0\\.0002 +\\S+ +mixed   usual  x3 .* 1  \\S+, as it stands\n")))
      << result.output;
  EXPECT_TRUE(std::regex_search(result.output, std::regex(", chosen\n"))) << result.output;
  EXPECT_TRUE(std::regex_search(result.output,
                                std::regex("choice    peak_q_Pa [+-]\\S+ ± \\S+ % \\(95 %, [5-9] seeds of 300 particles\\); "
                                           "0\\.\\S+ of the cost as it stands\n")))
      << result.output;
  EXPECT_TRUE(std::regex_search(
      result.output, std::regex("\ntime      [0-9]+ tests were made within the time allowed \\(--max-walltime 10 min\\)\n")))
      << result.output;
  LoadedScene const loaded = load_scene(tuned);
  EXPECT_GT(loaded.scene.test.inertial_number, 2e-4) << "60 % is soon reached";
  EXPECT_GT(loaded.scene.test.max_platen_wave_stress, 0);
  EXPECT_EQ(loaded.scene.specimen.particles, 300);
  std::string const text = read_text_file(tuned, 1 << 20);
  EXPECT_TRUE(text.starts_with("# mine\n")) << text;
  EXPECT_NE(text.find("# inertial_number = 2e-4  # as ever\n# clathra tune, within 60 %: with all its keys peak_q_Pa "),
            std::string::npos)
      << text;
  for (char const* const key : {"precision", "time_step_safety", "rotational_inertia_factor", "mass_scaled_fraction"})
    EXPECT_TRUE(std::regex_search(text, std::regex(std::string("# measured with these keys: [+-]\\S+ ± \\S+ %\n") + key + " = ")))
        << key << "\n"
        << text;
  CommandResult const run = run_clathra("run '" + tuned.string() + "' --threads 1 --output '" + (folder / "out").string() + "'");
  EXPECT_EQ(run.code, 0) << run.output;
  EXPECT_EQ(tune("").code, 73) << "what is written is left as it is";
  // What was run is not run again.
  fs::remove(tuned);
  auto const before = fs::last_write_time(folder / "runs" / "members");
  CommandResult const again = tune("--tolerance 60%");
  EXPECT_EQ(again.code, 0) << again.output;
  EXPECT_EQ(fs::last_write_time(folder / "runs" / "members"), before);
  EXPECT_EQ(read_text_file(tuned, 1 << 20), text);
}

TEST_F(TuneCommand, SaysSoWhereTheBudgetDoesNotTellAndWritesNothing) {
  CommandResult const result = tune("--tolerance 0.001% --max-walltime 1s");
  EXPECT_EQ(result.code, 79) << result.output;
  EXPECT_NE(result.output.find("undetermined: the first 5 seeds need about "), std::string::npos) << result.output;
  EXPECT_TRUE(says(result, "0 tests were made within the time allowed (--max-walltime 1 s); more time may change the choice\n"));
  EXPECT_FALSE(fs::exists(tuned));
}

/// 20,000 discs, six of the largest grains high: a level of 60 would be two high.
TEST_F(TuneCommand, GivesFlatSpecimensRungsOfEnoughGrainsAcross) {
  std::ofstream(scene)
      << "[specimen]\nwidth = \"210 mm\"\nheight = \"1.81 mm\"\nvoid_ratio = 0.26\ncompaction_layers = 2\n[test]\n"
         "axial_strain = \"0.2 %\"\n[output]\nrecords = 10\nsnapshots = 0\n";
  CommandResult const result = tune("--tolerance 0.001% --max-walltime 1s --particles 60");
  EXPECT_EQ(result.code, 79) << result.output;
  EXPECT_NE(result.output.find("undetermined: the first 5 seeds need about "), std::string::npos) << result.output;
}

TEST_F(TuneCommand, RefusesWhatItCannotTune) {
  CommandResult const tolerance = tune("--tolerance 1mm");
  EXPECT_EQ(tolerance.code, 64);
  EXPECT_TRUE(says(tolerance, "--tolerance: error: needs a plain number or a percentage, got a length ('1mm')"));
  CommandResult const quantity = tune("--quantity peek_q");
  EXPECT_EQ(quantity.code, 64);
  EXPECT_TRUE(says(quantity, "--quantity: error: names no number of a test: 'peek_q'; did you mean 'peak_q'?\n"));
  EXPECT_EQ(tune("--max-walltime soon").code, 64);
  CommandResult const file = tune("--set specimen.file=" CLATHRA_GOLDEN "/specimen.h5");
  EXPECT_EQ(file.code, 77);
  EXPECT_NE(file.output.find("tune needs specimens of several seeds"), std::string::npos) << file.output;
  EXPECT_EQ(run_clathra("tune '" + (folder / "none.toml").string() + "'").code, 66);
}

}  // namespace
}  // namespace clathra
