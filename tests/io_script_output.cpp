/// What scripts read of the program: --json, --quiet, --version, exit codes, the modes of its files.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "terminal/status.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// What it prints to stdout alone.
CommandResult quiet_errors(std::string const& arguments) { return run_clathra(arguments + " 2>/dev/null; exit $?"); }

class ScriptOutput : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    fs::create_directories(folder());
    std::ofstream(folder() / "small.toml")
        << "[specimen]\nparticles = 300\ncompaction_layers = 1\n[hydrate]\nsaturation = \"55 %\"\n[bond]\nrolling_lever = \"0.02 "
           "B\"\n"
           "[test]\naxial_strain = \"1 %\"\ninertial_number = 1e-3\n[output]\nrecords = 10\nsnapshots = 2\n";
    std::ofstream(folder() / "study.toml") << "scene = \"small.toml\"\nseeds = 2\n[matrix]\ngrains.friction = [0.3, 0.5]\n";
    ran() = run_clathra("--version >/dev/null; umask 002; " + std::string(program_in_shell) + " run --quiet '" + scene() +
                        "' --output '" + out() + "'");
  }
  static void TearDownTestSuite() { fs::remove_all(folder()); }
  static fs::path folder() { return fs::temp_directory_path() / ("clathra_script_" + std::to_string(::getpid())); }
  static std::string scene() { return (folder() / "small.toml").string(); }
  static std::string out() { return (folder() / "out").string(); }
  static CommandResult& ran() {
    static CommandResult result;
    return result;
  }
};

TEST_F(ScriptOutput, OfAQuietRunIsNothingButWarnings) {
  EXPECT_EQ(ran().code, 0) << ran().output;
  std::size_t const warnings = Json::parse(std::ifstream(out() + "/run.json"))["warnings"].size();
  EXPECT_EQ(ran().output.empty(), warnings == 0) << ran().output;
  EXPECT_EQ(ran().output.find('%' + std::string(" eps1")), std::string::npos) << "no progress";
  EXPECT_EQ(ran().output.find("results "), std::string::npos) << "no summary";
  EXPECT_EQ(run_clathra("verify --quiet '" + out() + "'").output, "");
  EXPECT_EQ(run_clathra("check --quiet '" + scene() + "' --set test.inertial_number=0.5").code, 77);
}

TEST_F(ScriptOutput, FilesFollowTheUmask) {
  ASSERT_EQ(ran().code, 0);
  int files = 0;
  for (fs::directory_entry const& entry : fs::recursive_directory_iterator(out())) {
    if (!entry.is_regular_file()) continue;
    struct stat status = {};
    ASSERT_EQ(::stat(entry.path().c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777, 0664u) << entry.path();
    ++files;
  }
  EXPECT_GE(files, 10);
}

TEST_F(ScriptOutput, OfCheckIsTheForecastAsJson) {
  Json const valid = Json::parse(quiet_errors("check --json '" + scene() + "'").output);
  EXPECT_EQ(valid["verdict"], "valid");
  EXPECT_NEAR(valid["forecast"]["particles"].get<double>(), 300, 1);
  EXPECT_GT(valid["shear_seconds"].get<double>(), 0);
  EXPECT_TRUE(valid["refusals"].empty());
  EXPECT_TRUE(valid["error_of_peak_q"].is_null()) << "1 % strain was not measured";
  EXPECT_NE(valid["error_of_peak_q_not_measured"].get<std::string>(), "");
  CommandResult const refused = quiet_errors("check --json '" + scene() + "' --set test.inertial_number=0.5");
  EXPECT_EQ(refused.code, 77);
  EXPECT_EQ(Json::parse(refused.output)["verdict"], "refused");
  EXPECT_FALSE(Json::parse(refused.output)["refusals"].empty());
  CommandResult const ignored = quiet_errors("check --json '" + scene() + "' --set test.inertial_number=0.5 --ignore-guards");
  EXPECT_EQ(ignored.code, 0);
  EXPECT_EQ(Json::parse(ignored.output)["verdict"], "guards ignored");
  CommandResult const wrong = quiet_errors("check --json '" + scene() + "' --set grains.kn=1 --set test.axial_strain=15");
  EXPECT_EQ(wrong.code, 64);
  Json const problems = Json::parse(wrong.output)["problems"];
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_EQ(problems[0]["text"], "unknown key 'grains.kn'; did you mean 'grains.normal_stiffness'?");
  EXPECT_EQ(problems[1]["severity"], "error");
}

TEST_F(ScriptOutput, NothingThatIsRefusedIsCalledValid) {
  EXPECT_TRUE(says(run_clathra("check '" + scene() + "'"), "small.toml: valid"));
  CommandResult const refused = run_clathra("check '" + scene() + "' --set test.inertial_number=0.5");
  EXPECT_TRUE(says(refused, "small.toml: refused\n"));
  EXPECT_EQ(refused.output.find("valid"), std::string::npos);
}

TEST_F(ScriptOutput, OfInfoEventsAndVerifyIsJson) {
  Json const specimen = Json::parse(quiet_errors("info --json '" + out() + "/specimen.h5'").output);
  EXPECT_EQ(specimen["kind"], "specimen");
  EXPECT_EQ(specimen["particles"], 300);
  EXPECT_NEAR(specimen["void_ratio"].get<double>(), 0.24, 0.03);
  EXPECT_TRUE(specimen["provenance"].is_object());
  Json const snapshot = Json::parse(quiet_errors("info --json '" + out() + "/snap/000000000000.h5'").output);
  EXPECT_EQ(snapshot["particles"], 300);
  EXPECT_GT(snapshot["pairs"]["bonded"].get<int>(), 100);
  EXPECT_EQ(Json::parse(quiet_errors("info --json '" + out() + "'").output), Json::parse(std::ifstream(out() + "/run.json")));
  Json const events = Json::parse(quiet_errors("events --json --parts 4 --to '1 %' '" + out() + "'").output);
  ASSERT_EQ(events["parts"].size(), 4u);
  int broken = 0;
  for (Json const& part : events["parts"]) broken += part["all"].get<int>();
  EXPECT_GT(broken, 0);
  EXPECT_NEAR(events["parts"][3]["eps1_to"].get<double>(), 0.01, 1e-4);
  EXPECT_EQ(run_clathra("events '" + out() + "' --to 15").code, 64) << "15 is no fraction";
  Json const verified = Json::parse(quiet_errors("verify --json '" + out() + "'").output);
  EXPECT_EQ(verified["files_not_as_written"], 0);
  EXPECT_EQ(verified["files_checked"], verified["files"].size());
  EXPECT_GE(verified["files"].size(), 5u);
  EXPECT_EQ(verified["files"][0]["as_written"], true);
}

/// One object on stdout, whatever goes wrong.
TEST_F(ScriptOutput, OfWhatGoesWrongIsJsonToo) {
  std::string const none = "'" + (folder() / "none").string() + "'", study = "'" + (folder() / "study.toml").string() + "' ";
  std::ofstream(folder() / "wrong.toml") << "scene = \"small.toml\"\nseeds = 0\n";
  struct Case {
    std::string arguments;
    int code;
    char const *verdict, *severity, *text;
  };
  for (Case const& wrong :
       {Case{"check --json " + none, 66, "invalid", "missing file", "cannot be opened"},
        {"info --json " + none, 66, "invalid", "missing file", "no such file"},
        {"events --json " + none, 66, "invalid", "missing file", "is not the folder of a run"},
        {"verify --json " + none, 66, "invalid", "missing file", "is not the folder of a run"},
        {"events --json --to 15 '" + out() + "'", 64, "invalid", "error", "this looks like percent"},
        {"study --dry-run --json '" + (folder() / "wrong.toml").string() + "'", 65, "invalid", "error",
         "'seeds' must be between"},
        {"study --dry-run --json " + study + "--set grains.kn=1", 64, "invalid", "error", "unknown key 'grains.kn'"},
        {"bond --json --saturation 41", 64, "invalid", "error", "this looks like percent"},
        {"check --json", 64, "invalid", "error", "scene is required"}}) {
    CommandResult const result = quiet_errors(wrong.arguments);
    EXPECT_EQ(result.code, wrong.code) << wrong.arguments;
    Json const json = Json::parse(result.output, nullptr, false);
    ASSERT_TRUE(json.is_object()) << wrong.arguments << ": " << result.output;
    EXPECT_EQ(json["exit_code"], wrong.code) << wrong.arguments;
    EXPECT_EQ(json["verdict"], wrong.verdict) << wrong.arguments;
    ASSERT_EQ(json["problems"].size(), 1u) << json;
    EXPECT_EQ(json["problems"][0]["severity"], wrong.severity) << json;
    EXPECT_NE(json["problems"][0]["text"].get<std::string>().find(wrong.text), std::string::npos) << json;
  }
  Json const line = Json::parse(quiet_errors("study --dry-run --json '" + (folder() / "wrong.toml").string() + "'").output);
  EXPECT_EQ(line["problems"][0]["file"], (folder() / "wrong.toml").string());
  EXPECT_EQ(line["problems"][0]["line"], 2);
  CommandResult const refused = quiet_errors("study --dry-run --json " + study + "--set test.inertial_number=0.5");
  EXPECT_EQ(refused.code, 77);
  EXPECT_FALSE(Json::parse(refused.output)["members"][0]["refusals"].empty()) << "its forecast, not a second object";
}

TEST_F(ScriptOutput, OfADryRunIsJson) {
  Json const study = Json::parse(
      quiet_errors("study --dry-run --json '" + (folder() / "study.toml").string() + "' -o '" + (folder() / "s").string() + "'")
          .output);
  EXPECT_EQ(study["members"].size(), 4u);
  EXPECT_GT(study["shear_seconds"].get<double>(), 0);
  EXPECT_EQ(run_clathra("study --json '" + (folder() / "study.toml").string() + "'").code, 64) << "of a dry run only";
}

TEST_F(ScriptOutput, ExportsTablesAndASeries) {
  ASSERT_EQ(run_clathra("export --to spreadsheet '" + out() + "'").code, 0);
  std::ifstream table(out() + "/export/history-spreadsheet.csv");
  std::string heading;
  std::getline(table, heading);
  EXPECT_NE(heading.find(",eps1_pct,eps_v_pct,sigma1_kPa,"), std::string::npos) << heading;
  EXPECT_EQ(run_clathra("export --to spreadsheet '" + folder().string() + "'").code, 66);
  ASSERT_EQ(run_clathra("export --quiet --to vtu '" + out() + "'").output, "");
  std::string const series((std::istreambuf_iterator<char>(std::ifstream(out() + "/export/particles.pvd").rdbuf())), {});
  EXPECT_NE(series.find("<DataSet timestep=\"0\" file=\"particles_000000000000.vtu\"/>"), std::string::npos) << series;
  EXPECT_TRUE(fs::exists(out() + "/export/contacts.pvd"));
}

/// What is there and not a page or a table of ours stays.
TEST_F(ScriptOutput, NoReportTakesThePlaceOfAnotherFile) {
  ASSERT_EQ(run_clathra("report '" + out() + "'").code, 0) << "its own page is made again";
  for (std::string const& option : {std::string("-o "), std::string("--numbers ")})
    for (std::string const& file : {scene(), out() + "/run.json", out() + "/history.csv"}) {
      CommandResult const refused = run_clathra("report '" + out() + "' " + option + "'" + file + "'");
      EXPECT_EQ(refused.code, 73) << refused.output;
      EXPECT_TRUE(says(refused, "exists already and is left as it is; name another file"));
    }
  std::string const numbers = "report '" + out() + "' --numbers '" + (folder() / "n.json").string() + "'";
  for (int twice = 0; twice < 2; ++twice) EXPECT_EQ(run_clathra(numbers).code, 0);
  EXPECT_EQ(run_clathra("verify '" + out() + "'").code, 0);
}

TEST_F(ScriptOutput, OfAStudyTellsHowFarMembersAreAndWhyTheyFailed) {
  fs::path const file = folder() / "told.status";
  CommandResult const run = run_clathra("run --quiet --status '" + file.string() + "' '" + scene() + "' --output '" +
                                        (folder() / "told").string() + "'");
  EXPECT_EQ(run.code, 0) << run.output;
  RunStatus const done = read_status(file);
  EXPECT_EQ(done.stage, "shear");
  EXPECT_GT(done.fraction, 0.97);
  EXPECT_EQ(done.failed, "");
  EXPECT_EQ(run_clathra("run --status '" + file.string() + "' '" + scene() + "' --set specimen.void_ratio=0.1 --output '" +
                        (folder() / "loose").string() + "'")
                .code,
            77);
  EXPECT_NE(read_status(file).failed.find("looser than the 0.1 that was asked for"), std::string::npos)
      << read_status(file).failed;
  EXPECT_EQ(read_status(folder() / "nowhere").fraction, 0);
}

TEST_F(ScriptOutput, OfAStudysForecastHasTheWarningsOfItsScenesOnce) {
  std::ofstream(folder() / "dense.toml")
      << "scene = \"small.toml\"\nseeds = 2\n[matrix]\n\"specimen.void_ratio\" = [0.1, 0.24]\n\"output.records\" = [10, 20]\n";
  CommandResult const result = run_clathra("study --dry-run '" + (folder() / "dense.toml").string() + "'");
  EXPECT_EQ(result.code, 0) << result.output;
  std::size_t const warned = result.output.find("warning: a void ratio of 0.1 will hardly be reached");
  ASSERT_NE(warned, std::string::npos) << result.output;
  EXPECT_NE(result.output.find(" (in the groups ", warned), std::string::npos) << result.output;
  EXPECT_EQ(result.output.find("will hardly be reached", warned + 40), std::string::npos) << result.output;
  Json const json = Json::parse(quiet_errors("study --dry-run --json '" + (folder() / "dense.toml").string() + "'").output);
  ASSERT_EQ(json["warnings"].size(), 1u);
  EXPECT_TRUE(json["warnings"][0].get<std::string>().starts_with("a void ratio of 0.1 will hardly be reached"));
}

TEST_F(ScriptOutput, OfAStudyIsNotThatOfARun) {
  fs::path const study = folder() / "a_study";
  fs::create_directories(study);
  std::ofstream(study / "study.csv") << "row\n";
  for (std::string const verb : {"events", "info", "verify", "report"}) {
    CommandResult const result = run_clathra(verb + " '" + study.string() + "'");
    EXPECT_EQ(result.code, 66) << verb << result.output;
    EXPECT_TRUE(says(result, "is the folder of a study: name a run among its members")) << verb;
    EXPECT_EQ(run_clathra(verb + " '" + (folder() / "none").string() + "'").code, 66) << verb;
  }
}

TEST_F(ScriptOutput, WarnsOfADiskThatIsTooSmall) {
  CommandResult const check =
      run_clathra("check '" + scene() + "' --set specimen.particles=20000000 --set output.records=100000 " +
                  "--set output.snapshots=100000 --set output.lossless_snapshots=true --ignore-guards");
  EXPECT_TRUE(says(check, " of disk, "));
  EXPECT_EQ(run_clathra("check '" + scene() + "'").output.find(" of disk, "), std::string::npos);
}

TEST(ExitCodes, OfTooLittleMemoryIs71) {
  fs::path const scene = fs::temp_directory_path() / ("clathra_memory_" + std::to_string(::getpid()) + ".toml");
  std::ofstream(scene) << "[specimen]\nparticles = 1000000000\n";
  for (std::string const verb : {"run", "generate"}) {
    CommandResult const result =
        run_clathra(verb + " '" + scene.string() + "' -o /tmp/clathra_none_" + std::to_string(::getpid()));
    EXPECT_EQ(result.code, 71) << result.output;
    EXPECT_TRUE(says(result, "not enough memory: it needs about "));
  }
  fs::remove(scene);
}

TEST(Version, NamesTheLibrariesAndTheInstructionSet) {
  CommandResult const version = run_clathra("--version");
  EXPECT_EQ(version.code, 0);
  for (char const* const part : {"clathra ", "\nKokkos ", "\nMPI: ", "\nHDF5 ", "\ninstruction set: "})
    EXPECT_TRUE(says(version, part));
}

}  // namespace
}  // namespace clathra
