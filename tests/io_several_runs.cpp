/// One process makes several runs, one after the other: whoever computes begins Kokkos once, a run does not.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "run/biaxial_run.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

std::string state_hash(fs::path const& folder, std::string const& saturation, std::string const& name) {
  LoadedScene input = parse_scene("[specimen]\nparticles = 300\n[test]\naxial_strain = \"0.5 %\"\n[output]\nrecords = 10\n",
                                  "small.toml", folder);
  input.scene.hydrate.saturation = saturation == "clean" ? 0 : 0.41;
  input.scene.output.folder = (folder / name).string();
  BiaxialRun run(std::move(input), std::nullopt, {}, Ranks());
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  ExitCode const code = run.run();
  std::string const said = testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr();
  EXPECT_EQ(code, ExitCode::done) << said;
  std::ifstream record(folder / name / "run.json");
  return nlohmann::json::parse(record).at("state_hash");
}

TEST(SeveralRuns, InOneProcessDoNotKnowOfEachOther) {
  fs::path const folder = fs::temp_directory_path() / ("clathra_several_runs_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  std::string const first = state_hash(folder, "bonded", "first"), other = state_hash(folder, "clean", "other");
  EXPECT_NE(first, other);
  EXPECT_EQ(state_hash(folder, "bonded", "again"), first);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace clathra
