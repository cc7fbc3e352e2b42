/// Snapshots at strains of the user's choice, and a finished test that goes on to a larger strain.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "io/formats/text_file.hpp"
#include "io/results/events.hpp"
#include "io/results/run_results.hpp"
#include "io/results/snapshot_file.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

class ExtendedRun : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder); }
  void TearDown() override { fs::remove_all(folder); }
  CommandResult run(std::string const& name, std::string const& more) const {
    return run_clathra("run " CLATHRA_EXAMPLES "/quick.toml --threads 1 --set specimen.file=" CLATHRA_GOLDEN
                       "/specimen.h5 --set bond.preset=first_crack --set output.records=7 --set output.snapshots=2 --output '" +
                       (folder / name).string() + "' " + more);
  }
  nlohmann::json record(std::string const& name) const {
    return nlohmann::json::parse(read_text_file(folder / name / "run.json", 1 << 24));
  }
  std::string text(std::string const& name, char const* file) const { return read_text_file(folder / name / file, 1 << 24); }
  fs::path const folder = fs::temp_directory_path() / ("clathra_extended_" + std::to_string(::getpid()));
  std::string const one = "--set test.axial_strain='1 %' ", two = "--set test.axial_strain='2 %' ";
};

TEST_F(ExtendedRun, HasSnapshotsAtTheVeryStepsThatTheirStrainsAreReachedIn) {
  CommandResult const result =
      run("out", two + "--set output.snapshots_at='[\"0.123 %\", \"1.5 %\", \"2 %\"]' --set output.energy=true");
  ASSERT_EQ(result.code, 0) << result.output;
  std::vector<double> strains;
  std::size_t events = 0;
  std::int64_t before = -1;
  for (fs::path const& file : snapshot_files(folder / "out")) {
    Snapshot const snapshot = read_snapshot(file);
    strains.push_back(snapshot.eps1);
    events += snapshot.events.rows.size();
    for (BreakEvent const& event : snapshot.events.rows) EXPECT_TRUE(before < event.step && event.step <= snapshot.step) << file;
    before = snapshot.step;
  }
  double const step = 2e-2 / record("out").at("stages").at("plan").at("steps").get<double>();
  for (double const wanted : {0.00123, 0.015}) {
    auto const found = std::lower_bound(strains.begin(), strains.end(), wanted);
    ASSERT_NE(found, strains.end());
    EXPECT_LT(*found - wanted, 1.01 * step) << "one step, not one record";
  }
  EXPECT_EQ(strains.size(), 5u) << "0, 0.123 %, the first record after 1 %, 1.5 %, the end once";
  std::string const rows = text("out", "events.csv");
  EXPECT_EQ(events + 1, static_cast<std::size_t>(std::count(rows.begin(), rows.end(), '\n')))
      << "each broken bond in one snapshot";
  // They change nothing of what is computed or written elsewhere.
  ASSERT_EQ(run("plain", two + "--set output.energy=true").code, 0);
  for (char const* const file : {"history.csv", "events.csv"}) EXPECT_EQ(text("out", file), text("plain", file)) << file;
}

TEST_F(ExtendedRun, WithDetailsOfEventsIsTheSameButForTheirColumns) {
  ASSERT_EQ(run("plain", two).code, 0);
  ASSERT_EQ(run("out", two + "--set output.event_details=true").code, 0);
  EXPECT_EQ(text("out", "history.csv"), text("plain", "history.csv"));
  EXPECT_EQ(record("out").at("state_hash"), record("plain").at("state_hash"));
  BreakEvents const plain = read_events(folder / "plain" / "events.csv"), events = read_events(folder / "out" / "events.csv");
  EXPECT_FALSE(plain.detailed);
  ASSERT_TRUE(events.detailed);
  ASSERT_GT(events.rows.size(), 5u);
  ASSERT_EQ(events.rows.size(), plain.rows.size());
  HistoryTable const history(folder / "out" / "history.csv");
  BreakEvents in_snapshots;
  for (fs::path const& file : snapshot_files(folder / "out")) {
    BreakEvents const some = read_snapshot(file).events;
    EXPECT_TRUE(some.detailed) << file;
    in_snapshots.detailed = true;
    in_snapshots.add(some);
  }
  for (fs::path const& file : snapshot_files(folder / "plain")) EXPECT_FALSE(read_snapshot(file).events.detailed) << file;
  ASSERT_EQ(in_snapshots.details.size(), events.details.size());
  for (std::size_t k = 0; k < events.rows.size(); ++k) {
    EXPECT_EQ(events.rows[k].step, plain.rows[k].step);
    EXPECT_EQ(events.rows[k].x, plain.rows[k].x);
    for (BreakDetailColumn const& column : break_detail_columns)
      EXPECT_EQ(in_snapshots.details[k].*column.value, events.details[k].*column.value) << column.name;
    EXPECT_GE(events.details[k].utilisation, 1);
    auto const& steps = history["step"];
    auto const after = std::lower_bound(steps.begin(), steps.end(), static_cast<double>(events.rows[k].step)) - steps.begin();
    EXPECT_GE(events.details[k].eps1, k > 0 ? events.details[k - 1].eps1 : 0);
    EXPECT_LE(events.details[k].eps1, history["eps1"][static_cast<std::size_t>(after)]);
  }
  CommandResult const listed = run_clathra("events --csv " + (folder / "out").string());
  EXPECT_NE(listed.output.find("eps1,step,id_a,id_b,mode,x_m,y_m,orientation_deg,"), std::string::npos) << listed.output;
  CommandResult const unread = run("unread", one + "--set output.event_details=true --set output.events=false");
  EXPECT_NE(unread.output.find("output.event_details has no effect"), std::string::npos) << unread.output;
}

TEST_F(ExtendedRun, TakesSnapshotsOnlyAtGivenStrainsWhereThereAreNoRegularOnes) {
  ASSERT_EQ(run("out", one + "--set output.snapshots=0 --set output.snapshots_at='0.5 %,0.2 %'").code, 0);
  EXPECT_EQ(snapshot_files(folder / "out").size(), 2u);
  CommandResult const wrong = run("wrong", one + "--set output.snapshots_at='[\"1 mm\"]'");
  EXPECT_EQ(wrong.code, 64);
  EXPECT_NE(wrong.output.find("'output.snapshots_at' needs a plain number or a percentage"), std::string::npos) << wrong.output;
}

TEST_F(ExtendedRun, EndsInTheStateOfATestThatWentThatFarAtOnce) {
  ASSERT_EQ(run("out", one).code, 0);
  EXPECT_TRUE(fs::exists(folder / "out" / "ckpt" / "0.json"));
  EXPECT_FALSE(fs::exists(folder / "out" / "ckpt" / "1.json")) << "one generation is enough";
  EXPECT_NE(run("out", one + "--resume").output.find("this run is finished"), std::string::npos);
  CommandResult const extended = run("out", two + "--resume --set output.snapshots_at='1.5 %'");
  ASSERT_EQ(extended.code, 0) << extended.output;
  ASSERT_EQ(run("direct", two + "--set output.records=14").code, 0);
  EXPECT_EQ(record("out")["state_hash"], record("direct")["state_hash"]);
  EXPECT_EQ(record("out")["stages"]["plan"], record("direct")["stages"]["plan"]);
  EXPECT_EQ(text("out", "events.csv"), text("direct", "events.csv"));
  EXPECT_NEAR(HistoryTable(folder / "out" / "history.csv")["eps1"].back(), 0.02, 4e-6);
  EXPECT_EQ(record("out")["exit"]["reason"], "finished");
  EXPECT_EQ(run("out", two + "--resume --set output.snapshots_at='1.5 %'").code, 0) << "is finished now";
}

TEST_F(ExtendedRun, IsRefusedWhereItIsAnotherTestOrLiesBehind) {
  ASSERT_EQ(run("out", one).code, 0);
  std::string const before = text("out", "history.csv");
  CommandResult const other = run("out", two + "--resume --set damping.local=0.2");
  EXPECT_EQ(other.code, 73);
  EXPECT_NE(other.output.find("finished run of another scene"), std::string::npos) << other.output;
  EXPECT_EQ(run("out", "--resume --set test.axial_strain='0.5 %'").code, 73);
  ASSERT_EQ(run("none", one + "--set output.keep_checkpoint=false").code, 0);
  EXPECT_FALSE(fs::exists(folder / "none" / "ckpt"));
  CommandResult const none = run("none", two + "--resume");
  EXPECT_EQ(none.code, 73);
  EXPECT_NE(none.output.find("kept no checkpoint to be extended from (output.keep_checkpoint)"), std::string::npos)
      << none.output;
  EXPECT_EQ(text("out", "history.csv"), before);
}

}  // namespace
}  // namespace clathra
