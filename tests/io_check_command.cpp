#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "command.hpp"
#include "printed_number.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;
using Lines = std::vector<std::string>;

/// What follows "warning: " in the lines of an output.
Lines warnings_in(std::string const& output) {
  Lines found;
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);)
    if (line.rfind("warning: ", 0) == 0) found.push_back(line.substr(9));
  return found;
}

bool holds(std::string const& text, std::string const& part) { return text.find(part) != std::string::npos; }

class CheckCommand : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder);
    std::ofstream(scene) << "[specimen]\nparticles = 300\n[test]\naxial_strain = \"0.2 %\"\n[output]\nrecords = 10\n";
  }
  void TearDown() override { fs::remove_all(folder); }

  CommandResult clathra(std::string const& verb, std::string const& more) {
    return run_clathra(verb + " '" + scene.string() + "' " + more);
  }

  fs::path const folder = fs::temp_directory_path() / ("clathra_check_" + std::to_string(::getpid()));
  fs::path const scene = folder / "small.toml";
};

/// Small specimens step slower: what a step costs besides its particles shows.
TEST_F(CheckCommand, MeasuresTheMachineAtTheSizeOfTheSpecimen) {
  ::setenv("XDG_CACHE_HOME", folder.c_str(), 1);
  EXPECT_EQ(clathra("check", "").code, 0);
  EXPECT_EQ(clathra("check", "--set specimen.particles=1999").code, 0);
  ::unsetenv("XDG_CACHE_HOME");
  std::ifstream file(folder / "clathra" / "throughput.json");
  nlohmann::json const kept = nlohmann::json::parse(file);
  Lines sizes;
  for (auto const& [key, rate] : kept.items()) sizes.push_back(key.substr(key.rfind(", ") + 2));
  EXPECT_EQ(sizes, (Lines{"1000 particles", "250 particles"}));
}

TEST_F(CheckCommand, WarnsOfTheSameAsTheRunItself) {
  std::string const worrying =
      "--ignore-guards --set hydrate.saturation=0.75 --set grains.normal_stiffness='40 MPa' --set bond.constant_thickness='1 um' "
      "--set test.inertial_number=2e-2 --set run.threads=1";
  CommandResult const check = clathra("check", worrying);
  ASSERT_EQ(check.code, 0) << check.output;
  Lines const wanted = warnings_in(check.output);
  EXPECT_EQ(wanted.size(), 5u) << check.output;
  CommandResult const run = clathra("run", worrying + " --output '" + (folder / "out").string() + "'");
  ASSERT_EQ(run.code, 0) << run.output;
  Lines of_the_run = nlohmann::json::parse(std::ifstream(folder / "out" / "run.json"))["warnings"].get<Lines>();
  ASSERT_GE(of_the_run.size(), wanted.size());
  of_the_run.resize(wanted.size());  // what the run itself met comes last
  EXPECT_EQ(of_the_run, wanted);
}

TEST_F(CheckCommand, SaysWhatAWaveNumberMakesOfTheRateAndTheRunKeepsIt) {
  CommandResult const free = clathra("check", "--particle-steps-per-second 1e6");
  EXPECT_TRUE(holds(free.output, "inertial number I  0.0002 (quasi-static below 0.00035)\n")) << free.output;
  std::string const bounded = "--set test.max_platen_wave_stress=1e-3 --set test.inertial_number=1e-3 ";
  CommandResult const check = clathra("check", bounded + "--particle-steps-per-second 1e6");
  EXPECT_TRUE(holds(check.output, "(lowered from 0.001 by test.max_platen_wave_stress; quasi-static below 0.00035)\n"))
      << check.output;
  EXPECT_TRUE(holds(check.output, "wave stress W      0.001 (")) << check.output;
  CommandResult const run =
      clathra("run", bounded + "--set test.axial_strain=1e-4 --threads 1 --output '" + (folder / "out").string() + "'");
  ASSERT_EQ(run.code, 0) << run.output;
  auto const record = nlohmann::json::parse(std::ifstream(folder / "out" / "run.json"));
  EXPECT_EQ(record["stages"]["plan"]["platen_wave_stress"].get<double>(), 1e-3);
  EXPECT_EQ(record["scene"]["test"]["max_platen_wave_stress"].get<double>(), 1e-3);
  double const share = record["stages"]["prepare"]["rate_share"].get<double>();
  EXPECT_NEAR(record["stages"]["plan"]["inertial_number"].get<double>(), share * 1e-3, 1e-15);
  EXPECT_LT(share, 0.3);
}

TEST_F(CheckCommand, SaysWhichErrorOfThePeakToExpectOrThatItWasNotMeasured) {
  std::string const row = "  error of peak q    ",
                    measured = "--set specimen.particles=2000 --set test.axial_strain=0.1 --particle-steps-per-second 1e6";
  CommandResult const usual = clathra("check", measured);
  EXPECT_TRUE(holds(usual.output, row + "+") || holds(usual.output, row + "-")) << usual.output;
  EXPECT_TRUE(holds(usual.output, " % against slow shear in double precision (2000 particles at 1 MPa)\n")) << usual.output;
  CommandResult const damped = clathra("check", measured + " --set damping.local=0.7");
  EXPECT_TRUE(holds(damped.output, row + "not measured: damping.local\n")) << damped.output;
  CommandResult const fast = clathra("check", measured + " --set test.inertial_number=0.05 --ignore-guards");
  EXPECT_TRUE(holds(fast.output, row + "not measured: only up to I = ")) << fast.output;
  CommandResult const small = clathra("check", "--particle-steps-per-second 1e6");
  EXPECT_TRUE(holds(small.output, row + "not measured: test.axial_strain, specimen.particles\n")) << small.output;
}

/// As a run writes its scene down with all keys.
TEST_F(CheckCommand, WarnsOfNoKeyThatIsAsByDefault) {
  std::string const text = "the [bond] section has no effect";
  EXPECT_FALSE(holds(clathra("check", "--set bond.contact_coupling=parallel").output, text));
  EXPECT_TRUE(holds(clathra("check", "--set bond.contact_coupling=replaces_keeping_force").output, text));
}

TEST_F(CheckCommand, SaysWhatTheRunLeavesOnTheDisk) {
  for (std::string const more : {"", "--set output.snapshots=0 ", "--set hydrate.saturation=0.55 --set output.records=300 "}) {
    std::string const keys = more + "--set test.axial_strain=0.03 ";
    double const said = number_after(clathra("check", keys + "--particle-steps-per-second 1e6").output, "disk               ");
    fs::path const out = folder / "out";
    ASSERT_EQ(clathra("run", keys + "--overwrite --threads 1 --output '" + out.string() + "'").code, 0);
    double left = 0;
    for (auto const& entry : fs::recursive_directory_iterator(out))
      if (entry.is_regular_file()) left += 1e-6 * static_cast<double>(entry.file_size());
    EXPECT_NEAR(said / left, 1, 0.15) << keys;
  }
}

TEST_F(CheckCommand, RefusesGrainsTooSoftForTheirStress) {
  std::string const soft = "--set test.confining_stress='100 MPa'";
  std::string const text =
      "kn / sigma_1 = 0.909 with a sigma_1 of 330 MPa, as is to be expected, is below 5: grains overlap by a fifth of their "
      "diameter";
  for (char const* const verb : {"check", "run"}) {
    CommandResult const refused =
        clathra(verb, soft + (verb == std::string("run") ? " --output '" + folder.string() + "/out'" : ""));
    EXPECT_EQ(refused.code, 77) << verb << ": " << refused.output;
    EXPECT_TRUE(holds(refused.output, text)) << refused.output;
  }
  EXPECT_FALSE(fs::exists(folder / "out")) << "refused before anything is written";
  CommandResult const ignored = clathra("check", soft + " --ignore-guards");
  EXPECT_EQ(ignored.code, 0) << ignored.output;
  EXPECT_TRUE(holds(ignored.output, ": guards ignored, ")) << ignored.output;
  EXPECT_TRUE(holds(ignored.output, "warning: guard ignored: " + text)) << ignored.output;
  EXPECT_EQ(clathra("check", "--set test.confining_stress='15 MPa'").code, 0);
}

TEST_F(CheckCommand, RefusesASpecimenNarrowerThanThreeGrains) {
  std::string const narrow = "--set specimen.width='0.6 mm'";
  std::string const text = "the specimen is 0.6 mm wide, 2 times its largest grain (0.3 mm): at least 3 times are needed";
  for (char const* const verb : {"check", "run", "generate"}) {
    CommandResult const refused = clathra(verb, narrow);
    EXPECT_EQ(refused.code, 77) << verb << ": " << refused.output;
    EXPECT_TRUE(holds(refused.output, text)) << refused.output;
  }
  CommandResult const ignored = clathra("check", narrow + " --ignore-guards");
  EXPECT_EQ(ignored.code, 0) << ignored.output;
  EXPECT_TRUE(holds(ignored.output, ": guards ignored, ")) << ignored.output;
  EXPECT_TRUE(holds(ignored.output, "warning: guard ignored: " + text)) << ignored.output;
  EXPECT_EQ(clathra("check", "--set specimen.width='0.9 mm'").code, 0);
  EXPECT_TRUE(holds(clathra("check", "--set specimen.height='0.6 mm'").output, "the specimen is 0.6 mm high"));
  EXPECT_TRUE(holds(clathra("check", "--set specimen.width='0.25 mm' --ignore-guards").output, "no grain of 0.3 mm fits"));
}

TEST_F(CheckCommand, RefusesASpecimenFileNarrowerThanThreeGrains) {
  std::string const file = "'" + (folder / "narrow.h5").string() + "'";
  std::string const loose =
      "--set specimen.particles=100 --set specimen.width='0.7 mm' --set specimen.void_ratio=0.32 --ignore-guards";
  CommandResult const made = clathra("generate", loose + " -o " + file);
  ASSERT_EQ(made.code, 0) << made.output;
  std::string const read = "--set specimen.file=" + file;
  for (std::string const verb : {std::string("check"), "run --output '" + (folder / "out").string() + "'"}) {
    CommandResult const refused = clathra(verb, read);
    EXPECT_EQ(refused.code, 77) << verb << ": " << refused.output;
    EXPECT_TRUE(holds(refused.output, "mm wide, 2.")) << refused.output;
    EXPECT_TRUE(holds(refused.output, "times its largest grain")) << refused.output;
    EXPECT_EQ(clathra("check", read + " --ignore-guards").code, 0);
  }
}

TEST_F(CheckCommand, AndBondWarnOfSaturationsThatEq3DoesNotCover) {
  struct Case {
    char const *saturation, *warning;
  };
  for (Case const& c :
       {Case{"0.2", "a saturation of 20 % makes no bonds: Eq. 3 has none up to 20 %"}, Case{"0.21", ""}, Case{"0.7", ""},
        Case{"0.71",
             "a saturation of 71 % is above the range of Eq. 3, which ends at 70 %: the critical thickness stays at 0.1 d50"}}) {
    CommandResult const check = clathra("check", std::string("--set hydrate.saturation=") + c.saturation);
    CommandResult const bond = run_clathra(std::string("bond --saturation ") + c.saturation);
    EXPECT_EQ(check.code, 0);
    EXPECT_EQ(bond.code, 0);
    if (*c.warning) {
      EXPECT_EQ(warnings_in(check.output), Lines{c.warning}) << c.saturation;
      EXPECT_TRUE(holds(bond.output, std::string("note: ") + c.warning)) << bond.output;
    } else {
      EXPECT_EQ(warnings_in(check.output), Lines{}) << c.saturation;
      EXPECT_FALSE(holds(bond.output, "note: ")) << bond.output;
    }
  }
}

}  // namespace
}  // namespace clathra
