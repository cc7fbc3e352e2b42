#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "comma_locale.hpp"
#include "file_content.hpp"
#include "io/errors/problems.hpp"
#include "io/formats/digest.hpp"
#include "io/results/events.hpp"
#include "io/results/history.hpp"
#include "io/results/output_folder.hpp"
#include "io/results/run_record.hpp"
#include "kernels/real.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

class Output : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder); }
  void TearDown() override { fs::remove_all(folder); }
  static std::vector<std::string> split(std::string const& text, char at) {
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, at);) parts.push_back(part);
    return parts;
  }
  static ExitCode code_of(std::function<void()> const& act) {
    try {
      act();
    } catch (FileProblem const& problem) {
      return problem.code;
    }
    return ExitCode::done;
  }

  fs::path const folder = fs::temp_directory_path() / ("clathra_output_" + std::to_string(::getpid()));
};

using History = Output;
using Events = Output;
using Folder = Output;
using Record = Output;

TEST_F(History, HasTheColumnsThatTheDocumentationPromises) {
  HistoryFile(folder / "history.csv", false);
  auto const header = split(split(content(folder / "history.csv"), '\n').front(), ',');
  for (char const* const column : {"stage",
                                   "step",
                                   "time_s",
                                   "eps1",
                                   "eps_v",
                                   "sigma1_Pa",
                                   "sigma3_Pa",
                                   "q_Pa",
                                   "p_Pa",
                                   "void_ratio",
                                   "bonds_intact",
                                   "bonds_intact_pct",
                                   "bonded_contacts_pct",
                                   "broken_tension",
                                   "broken_compression",
                                   "broken_shear",
                                   "broken_rolling",
                                   "coordination",
                                   "inertial_number",
                                   "platen_wave_stress",
                                   "unbalanced"})
    EXPECT_EQ(std::count(header.begin(), header.end(), column), 1) << column;
  EXPECT_EQ(std::count(header.begin(), header.end(), "residual_J_per_m"), 0);
}

TEST_F(History, WritesNumbersThatReadBackToTheSameBits) {
  HistoryRow row;
  row.step = 1234567890123;
  row.eps1 = 0.1;
  row.q_Pa = 1.0 / 3;
  row.sigma3_Pa = 1e6;
  row.unbalanced = 5e-324;
  HistoryFile file(folder / "history.csv", false);
  file.write(row);
  file.close();
  auto const lines = split(content(folder / "history.csv"), '\n');
  ASSERT_EQ(lines.size(), 2u);
  auto const names = split(lines[0], ','), cells = split(lines[1], ',');
  ASSERT_EQ(names.size(), cells.size());
  auto const cell = [&](std::string const& name) {
    return cells[static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin())];
  };
  EXPECT_EQ(cell("step"), "1234567890123");
  EXPECT_EQ(cell("eps1"), "0.1");
  EXPECT_EQ(cell("sigma3_Pa"), "1000000");
  EXPECT_EQ(std::strtod(cell("q_Pa").c_str(), nullptr), 1.0 / 3);
  EXPECT_EQ(std::strtod(cell("unbalanced").c_str(), nullptr), 5e-324);
}

TEST_F(History, AppendsTheEnergyLedgerWhereThereIsOne) {
  HistoryFile file(folder / "history.csv", true);
  EnergyRow energy;
  energy.residual = 7;
  file.write({}, energy);
  file.close();
  auto const lines = split(content(folder / "history.csv"), '\n');
  auto const names = split(lines[0], ','), cells = split(lines[1], ',');
  ASSERT_EQ(names.size(), cells.size());
  EXPECT_EQ(names.back(), "residual_J_per_m");
  EXPECT_EQ(cells.back(), "7");
  EXPECT_EQ(names[names.size() - 12], "boundary_work_J_per_m");
}

TEST_F(History, GoesOnWithItsOwnColumns) {
  fs::path const path = folder / "history.csv";
  HistoryRow row;
  row.step = 3, row.q_Pa = 5e6, row.bonded_contacts_pct = 12.5, row.mechanical_coordination = 4, row.unbalanced = 0.25;
  {
    HistoryFile file(path, false);
    file.write(row);
  }
  std::string const text = content(path);
  {
    HistoryFile file(path, text.size());
    row.step = 4;
    file.write(row);
  }
  auto const lines = split(content(path), '\n');
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ("shear,4" + lines[1].substr(7), lines[2]) << "the same cells";
  std::vector<HistoryEntry> const entries = read_history(path, content(path).size());
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_EQ(entries[1].row.step, 4);
  EXPECT_EQ(entries[1].row.bonded_contacts_pct, 12.5);
  EXPECT_EQ(entries[1].row.unbalanced, 0.25);
  for (char const* const column : {"unbalanced", "mechanical_coordination"}) {
    std::string const lacking = std::regex_replace(text, std::regex(column), "other");
    std::ofstream(path) << lacking;
    EXPECT_EQ(code_of([&] { (void)read_history(path, lacking.size()); }), ExitCode::bad_input) << column;
  }
}

TEST_F(History, IsTheSameInEveryLocale) {
  HistoryRow row;
  row.eps1 = 0.5;
  {
    CommaLocale const locale;
    ASSERT_TRUE(locale.works()) << "no locale with a decimal comma: Debian's package locales has one";
    HistoryFile file(folder / "history.csv", false);
    file.write(row);
  }
  EXPECT_NE(content(folder / "history.csv").find("0,0,0.5,0"), std::string::npos);
}

TEST_F(History, NamesTheFileThatCannotBeMadeOrWritten) {
  EXPECT_EQ(code_of([&] { HistoryFile(folder / "none" / "history.csv", false); }), ExitCode::cannot_create);
  rlimit unlimited{};
  ::getrlimit(RLIMIT_FSIZE, &unlimited);
  rlimit limited = unlimited;
  limited.rlim_cur = 2000;
  auto const previous = std::signal(SIGXFSZ, SIG_IGN);
  ::setrlimit(RLIMIT_FSIZE, &limited);
  ExitCode const code = code_of([&] {
    HistoryFile file(folder / "history.csv", false);
    for (int i = 0; i < 1000; ++i) file.write({});
  });
  ::setrlimit(RLIMIT_FSIZE, &unlimited);
  std::signal(SIGXFSZ, previous);
  EXPECT_EQ(code, ExitCode::io_error);
}

TEST_F(History, DoesNotWriteThroughALink) {
  std::ofstream(folder / "precious.txt") << "keep me";
  fs::create_symlink(folder / "precious.txt", folder / "history.csv");
  HistoryFile(folder / "history.csv", false);
  EXPECT_EQ(content(folder / "precious.txt"), "keep me");
}

TEST_F(Events, ReadBackAsWrittenAndDamageIsNamedByLine) {
  BreakEvents const events{false, {{7, 1, 5, 1, 0.25, -1e-3}, {9, 2, 3, 4, 1e-5, 0}}, {}};
  EventsFile file(folder / "events.csv");
  file.write("shear", events);
  file.close();
  auto const back = read_events(folder / "events.csv");
  EXPECT_FALSE(back.detailed);
  EXPECT_TRUE(back.details.empty());
  ASSERT_EQ(back.rows.size(), 2u);
  EXPECT_EQ(back.rows[1].step, 9);
  EXPECT_EQ(back.rows[1].id_b, 3);
  EXPECT_EQ(back.rows[1].mode, 4);
  EXPECT_EQ(back.rows[0].y, -1e-3);
  for (char const* const row : {"shear,7,1,5,tension,0.25\n", "shear,7,1,5,tension,0.25,0,0\n", "shear,7,1,5,boredom,0.25,0\n",
                                "shear,x,1,5,shear,0.25,0\n"}) {
    std::ofstream(folder / "wrong.csv") << "stage,step,id_a,id_b,mode,x_m,y_m\n" << row;
    EXPECT_EQ(code_of([&] { read_events(folder / "wrong.csv"); }), ExitCode::bad_input) << row;
  }
  EXPECT_EQ(code_of([&] { read_events(folder / "none.csv"); }), ExitCode::file_missing);
}

TEST_F(Events, WithDetailsReadBackAsWritten) {
  BreakEvents events{true, {{7, 1, 5, 1, 0.25, -1e-3}}, {{0.01, 90, 9e-6, 6e-5, 1.001, 1.0 / 3, -1e-4}}};
  EventsFile file(folder / "events.csv", true);
  file.write("shear", events);
  file.close();
  std::string const header =
      "stage,step,id_a,id_b,mode,x_m,y_m,eps1,orientation_deg,thickness_m,width_m,utilisation,energy_J_per_m,relative_rotation_"
      "rad\n";
  EXPECT_EQ(content(folder / "events.csv"),
            header + "shear,7,1,5,tension,0.25,-0.001,0.01,90,9e-06,6e-05,1.001,0.3333333333333333,-0.0001\n");
  BreakEvents const back = read_events(folder / "events.csv");
  ASSERT_TRUE(back.detailed);
  ASSERT_EQ(back.details.size(), 1u);
  for (BreakDetailColumn const& column : break_detail_columns)
    EXPECT_EQ(back.details[0].*column.value, events.details[0].*column.value) << column.heading;
  std::ofstream(folder / "wrong.csv") << header << "shear,7,1,5,tension,0.25,0\n";
  EXPECT_EQ(code_of([&] { read_events(folder / "wrong.csv"); }), ExitCode::bad_input);
}

TEST_F(Events, AreOneRowEach) {
  EventsFile file(folder / "events.csv");
  file.write("shear", {});
  file.write("unloading", {false,
                           {{12, 3, 4, static_cast<int>(BreakMode::tension), 0.5, 1e-3},
                            {13, 1, 2, static_cast<int>(BreakMode::rolling), 0, 0}},
                           {}});
  file.close();
  EXPECT_EQ(content(folder / "events.csv"),
            "stage,step,id_a,id_b,mode,x_m,y_m\nunloading,12,3,4,tension,0.5,0.001\nunloading,13,1,2,rolling,0,0\n");
}

/// A folder as a new run takes it.
struct ClearedFolder : OutputFolder {
  ClearedFolder(fs::path const& folder, fs::path const& keep) : OutputFolder(folder, "run") { clear(keep); }
};

TEST_F(Folder, IsMadeLockedAndClearedOfAnEarlierRun) {
  fs::path const out = folder / "a" / "b";
  {
    ClearedFolder const first(out, {});
    std::ofstream(out / "run.json") << "{}";
    std::ofstream(out / "notes.txt") << "mine";
    EXPECT_EQ(code_of([&] { ClearedFolder(out, {}); }), ExitCode::cannot_create) << "two runs in one folder";
  }
  ClearedFolder const second(out, {});
  EXPECT_FALSE(fs::exists(out / "run.json"));
  EXPECT_TRUE(fs::exists(out / "notes.txt"));
}

TEST_F(Folder, KeepsTheSpecimenThatTheRunReads) {
  fs::path const out = folder / "a";
  { ClearedFolder const first(out, {}); }
  std::ofstream(out / "specimen.h5") << "x";
  { ClearedFolder const second(out, out / "specimen.h5"); }
  EXPECT_TRUE(fs::exists(out / "specimen.h5"));
  { ClearedFolder const third(out, {}); }
  EXPECT_FALSE(fs::exists(out / "specimen.h5"));
}

TEST_F(Folder, ThatBelongsToOthersIsRefused) {
  std::ofstream(folder / "thesis.tex") << "x";
  EXPECT_EQ(code_of([&] { ClearedFolder(folder, {}); }), ExitCode::cannot_create);
  fs::create_directories(folder / "empty");
  fs::create_directory_symlink(folder / "empty", folder / "link");
  EXPECT_EQ(code_of([&] { ClearedFolder(folder / "link", {}); }), ExitCode::cannot_create);
  EXPECT_EQ(code_of([&] { ClearedFolder(folder / "link/", {}); }), ExitCode::cannot_create);
  EXPECT_EQ(code_of([&] { ClearedFolder(folder / "thesis.tex", {}); }), ExitCode::cannot_create);
  EXPECT_EQ(code_of([&] { ClearedFolder(folder / "empty", {}); }), ExitCode::done);
}

TEST_F(Record, HoldsWhatARunNeedsToBeRepeated) {
  RunRecord record;
  record.version = "0.1.0";
  record.input = parse_scene("[specimen]\nparticles = 2000\n", "my.toml", "", {"run.seed=7"});
  record.input.scene.test.inertial_number = 0;  // as where a strain rate is given
  record.stages["generate"]["void_ratio"] = 0.24;
  record.state_hash = 0xabcull;
  record.exit_reason = "finished";
  record.warnings = {"a \xff byte"};
  write_run_record(folder / "run.json", record);
  auto const json = nlohmann::json::parse(content(folder / "run.json"));
  EXPECT_EQ(json["input"]["digest_xxh3_128"], text_digest("[specimen]\nparticles = 2000\n"));
  EXPECT_EQ(json["input"]["overrides"][0], "run.seed=7");
  EXPECT_EQ(json["seed"], 7);
  EXPECT_EQ(json["scene"]["specimen"]["particles"], 2000);
  EXPECT_TRUE(json["scene"]["specimen"]["width"].is_null()) << "not given, not zero";
  EXPECT_TRUE(json["scene"]["specimen"]["file"].is_null());
  EXPECT_EQ(json["scene"]["damping"]["viscous_ratio"], 0) << "zero, not left out";
  EXPECT_EQ(resolved_scene(scene_of(json["scene"]), folder), resolved_scene(record.input.scene, folder));
  EXPECT_EQ(json["scene"]["bond"]["contact_coupling"], "parallel");
  EXPECT_EQ(json["state_hash"], "0x0000000000000abc");
  EXPECT_EQ(json["exit"]["reason"], "finished");
  EXPECT_EQ(json["program"]["backend"], ExecutionSpace::name());
  EXPECT_EQ(json["program"]["precision"], "mixed") << "that of the scene, which has it by default";
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
}

}  // namespace
}  // namespace clathra
