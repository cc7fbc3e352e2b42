/// What a run that diverges leaves for whoever has to find out why.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "command.hpp"
#include "io/results/snapshot_file.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

TEST(DivergedRun, LeavesTheSurroundingsOfTheDiscForParaView) {
  fs::path const folder = fs::temp_directory_path() / ("clathra_diverged_" + std::to_string(::getpid()));
  std::string const soft = "run " CLATHRA_EXAMPLES "/quick.toml --threads 1 --set specimen.file=" CLATHRA_GOLDEN
                           "/specimen.h5 --output '" +
                           folder.string() + "' --set test.axial_strain='0.1 %' ";
  CommandResult const result =
      run_clathra(soft + "--ignore-guards --set grains.normal_stiffness='1 MPa' --set grains.shear_stiffness='1 MPa'");
  EXPECT_EQ(result.code, 76) << result.output;
  for (char const* const part : {"clathra: diverged: step ", ", since a step after ", "; it is at (",
                                 "the grains are too soft for this stress", "diverged/particles.xdmf (ParaView)"})
    EXPECT_NE(result.output.find(part), std::string::npos) << part << " is not in\n" << result.output;
  std::vector<fs::path> const files = snapshot_files(folder / "diverged");
  ASSERT_EQ(files.size(), 1u);
  Snapshot const around = read_snapshot(files.front());
  EXPECT_GT(around.id.size(), 20u);
  EXPECT_GT(around.a.size(), 20u);
  std::size_t const at = result.output.find("it is at (");
  double const x = std::stod(result.output.substr(at + 10)) * 1e-3;
  for (double const other : around.x) EXPECT_LE(std::abs(other - x), 12.1 * around.d50 + 12 * 1.7e-4);
  // The next run into the folder clears it.
  EXPECT_EQ(run_clathra(soft + "--overwrite").code, 0);
  EXPECT_FALSE(fs::exists(folder / "diverged"));
  fs::remove_all(folder);
}

}  // namespace
}  // namespace clathra
