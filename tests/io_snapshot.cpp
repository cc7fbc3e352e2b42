/// Snapshots: what they hold of a simulation, the way through their file, their XDMF index, and other programs' formats.
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>

#include "domain/generation/periodic_cell.hpp"
#include "domain/measurement/strain_field.hpp"
#include "domain/scene/specimen_design.hpp"
#include "file_content.hpp"
#include "io/formats/hdf5_file.hpp"
#include "io/results/export.hpp"
#include "io/results/snapshot_file.hpp"
#include "scenes.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

/// A bonded patch between walls that was squeezed until some of its bonds broke.
Simulation squeezed_patch() {
  Scene const scene = hydrate_scene(0.55, ContactCoupling::parallel);
  Specimen s = disordered_patch(12, 12, 0.02);
  enclose(s);
  bond_all(s, scene);
  SimulationLaws laws = bonded_laws(scene, s.critical_thickness);
  laws.wall.friction = 0.5;
  Simulation sim(s, laws, 0.1 * grain_d50);
  sim.time_step = 2e-8;
  sim.loading().y = AxisDrive::at_rate(1000);
  return sim;
}

class SnapshotFile : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder);
    Simulation sim = squeezed_patch();
    sim.mark_start();
    sim.step(4000);
    broken = sim.assembly().break_events(0);
    measures = sim.assembly().measures();
    area = sim.assembly().area();
    snapshot = take_snapshot(sim);
    snapshot.d50 = grain_d50;
    snapshot.events.rows = broken;
  }
  void TearDown() override { fs::remove_all(folder); }

  ExitCode code_of(std::function<void()> const& act) {
    try {
      act();
    } catch (FileProblem const& problem) {
      return problem.code;
    }
    return ExitCode::done;
  }

  fs::path const folder = fs::temp_directory_path() / ("clathra_snapshot_" + std::to_string(::getpid()));
  Snapshot snapshot;
  std::vector<BreakEvent> broken;
  Measures measures;
  double area = 0;
};

TEST_F(SnapshotFile, ShowsEveryBondAsIntactOrBrokenOnce) {
  ASSERT_GT(broken.size(), 5u);
  int intact = 0, gone = 0;
  for (std::uint8_t const state : snapshot.state) {
    intact += state == 1 ? 1 : 0;
    gone += state > 1 ? 1 : 0;
  }
  EXPECT_EQ(intact, std::lround(measures.bonded));
  EXPECT_EQ(gone, static_cast<int>(broken.size()));
  int initial = 0, left = 0;
  for (std::size_t i = 0; i < snapshot.id.size(); ++i) initial += snapshot.bonds_initial[i], left += snapshot.bonds_intact[i];
  EXPECT_EQ(initial - left, 2 * gone);
  EXPECT_EQ(left, 2 * intact);
}

TEST_F(SnapshotFile, StressOfTheDiscsAddsUpToThatOfTheSpecimen) {
  double xx = 0, yy = 0, xy = 0;
  for (std::size_t i = 0; i < snapshot.id.size(); ++i) {
    double const disc_area = pi * snapshot.radius[i] * double(snapshot.radius[i]);
    xx += snapshot.stress_xx[i] * disc_area;
    yy += snapshot.stress_yy[i] * disc_area;
    xy += snapshot.stress_xy[i] * disc_area;
  }
  EXPECT_NEAR(yy / measures.stress_area_yy, 1, 1e-5);
  EXPECT_NEAR(xx / measures.stress_area_xx, 1, 1e-5);
  EXPECT_NEAR(xy / yy, 0.5 * (measures.stress_area_xy + measures.stress_area_yx) / yy, 1e-6) << "with the shear of rough walls";
}

TEST_F(SnapshotFile, ReadsBackWithinItsStatedResolution) {
  write_snapshot(folder / "s.h5", snapshot);
  Snapshot const back = read_snapshot(folder / "s.h5");
  EXPECT_EQ(back.step, snapshot.step);
  EXPECT_EQ(back.id, snapshot.id);
  EXPECT_EQ(back.a, snapshot.a);
  EXPECT_EQ(back.b, snapshot.b);
  EXPECT_EQ(back.state, snapshot.state);
  EXPECT_EQ(back.coordination, snapshot.coordination);
  EXPECT_EQ(back.events.rows.size(), snapshot.events.rows.size());
  double force = 0;
  for (double const f : snapshot.normal_force) force += std::abs(f) / static_cast<double>(snapshot.normal_force.size());
  for (std::size_t i = 0; i < back.x.size(); ++i) {
    ASSERT_NEAR(back.x[i], snapshot.x[i], grain_d50 / 4096);
    ASSERT_NEAR(back.uy[i], snapshot.uy[i], grain_d50 / 512);
    ASSERT_NEAR(back.radius[i], snapshot.radius[i], grain_d50 / 8192);
  }
  for (std::size_t k = 0; k < back.a.size(); ++k) {
    ASSERT_NEAR(back.normal_force[k], snapshot.normal_force[k], force / 16);
    ASSERT_NEAR(back.gap[k], snapshot.gap[k], grain_d50 / 8192);
  }
}

TEST_F(SnapshotFile, KeepsEveryDigitOfPositionsAndForcesInFullPrecision) {
  write_snapshot(folder / "s.h5", snapshot, {}, SnapshotNumbers::full);
  Snapshot const back = read_snapshot(folder / "s.h5");
  EXPECT_EQ(back.x, snapshot.x);
  EXPECT_EQ(back.y, snapshot.y);
  EXPECT_EQ(back.radius, snapshot.radius);
  EXPECT_EQ(back.uy, snapshot.uy);
  EXPECT_EQ(back.stress_yy, snapshot.stress_yy);
  EXPECT_EQ(back.normal_force, snapshot.normal_force);
  EXPECT_EQ(back.shear_force, snapshot.shear_force);
  EXPECT_EQ(back.moment, snapshot.moment);
  EXPECT_EQ(back.gap, snapshot.gap);
  EXPECT_EQ(back.width, snapshot.width);
}

TEST_F(SnapshotFile, IsTakenWithMoreDigitsThanSinglePrecisionHolds) {
  std::size_t finer = 0;
  for (double const force : snapshot.normal_force) finer += double(float(force)) != force ? 1 : 0;
  EXPECT_GT(finer, snapshot.normal_force.size() / 2) << "more digits than single precision holds";
}

TEST_F(SnapshotFile, AFullDiskIsToldInTheWordsOfTheSystem) {
  rlimit unlimited{};
  ::getrlimit(RLIMIT_FSIZE, &unlimited);
  rlimit limited = unlimited;
  limited.rlim_cur = 5000;
  auto const previous = std::signal(SIGXFSZ, SIG_IGN);
  ::setrlimit(RLIMIT_FSIZE, &limited);
  std::string text = "written";
  try {
    write_snapshot(folder / "s.h5", snapshot);
  } catch (FileProblem const& problem) {
    text = problem.what();
  }
  ::setrlimit(RLIMIT_FSIZE, &unlimited);
  std::signal(SIGXFSZ, previous);
  EXPECT_EQ(text.find((folder / "s.h5").string() + ": cannot "), 0u) << text;
  EXPECT_TRUE(text.ends_with(": File too large")) << text;
}

TEST_F(SnapshotFile, DamageAndStrangersAreNamed) {
  EXPECT_EQ(code_of([&] { read_snapshot(folder / "none.h5"); }), ExitCode::file_missing);
  std::ofstream(folder / "text.h5") << "no HDF5";
  EXPECT_EQ(code_of([&] { read_snapshot(folder / "text.h5"); }), ExitCode::bad_input);
  Snapshot wrong = snapshot;
  wrong.b.back() = static_cast<std::int32_t>(wrong.id.size());
  write_snapshot(folder / "wrong.h5", wrong);
  EXPECT_EQ(code_of([&] { read_snapshot(folder / "wrong.h5"); }), ExitCode::bad_input);
  wrong = snapshot;
  wrong.state.front() = 17;
  write_snapshot(folder / "wrong.h5", wrong);
  EXPECT_EQ(code_of([&] { read_snapshot(folder / "wrong.h5"); }), ExitCode::bad_input);
}

/// Every data item of an index names a column that is there, with the rows and columns that it claims.
TEST_F(SnapshotFile, XdmfNamesColumnsThatExist) {
  SnapshotSeries series(folder);
  series.write(snapshot);
  snapshot.step += 100;
  series.write(snapshot);
  EXPECT_EQ(snapshot_files(folder).size(), 2u);
  int items = 0;
  for (char const* const index : {"particles.xdmf", "contacts.xdmf"}) {
    std::string const text = content(folder / index);
    std::regex const item("Dimensions=\"(\\d+)( (\\d+))?\" NumberType=\"(\\w+)\"[^>]*>([^:]+):/([^<]+)<");
    for (auto at = std::sregex_iterator(text.begin(), text.end(), item); at != std::sregex_iterator(); ++at, ++items) {
      std::size_t const rows = std::stoul((*at)[1]), width = (*at)[3].matched ? std::stoul((*at)[3]) : 1;
      Hdf5File const file = Hdf5File::open(folder / (*at)[5].str());
      EXPECT_EQ(file.read<double>((*at)[6], rows, width).size(), rows * width);
    }
  }
  EXPECT_EQ(items, 2 * (2 + 10 + 2 + 6));
}

TEST_F(SnapshotFile, LammpsDumpListsEveryDisc) {
  std::istringstream text(lammps_dump(snapshot));
  std::string line;
  for (int n = 0; n < 9; ++n) std::getline(text, line);
  EXPECT_EQ(line.substr(0, 24), "ITEM: ATOMS id type x y ");
  std::size_t rows = 0;
  for (; std::getline(text, line); ++rows) {
    std::istringstream cells(line);
    int id = 0, type = 0;
    double x = 0, y = 0, z = 0, radius = 0;
    cells >> id >> type >> x >> y >> z >> radius;
    ASSERT_EQ(id, snapshot.id[rows] + 1);
    ASSERT_EQ(x, snapshot.x[rows]);
    ASSERT_EQ(y, snapshot.y[rows]);
    ASSERT_EQ(static_cast<float>(radius), snapshot.radius[rows]);
  }
  EXPECT_EQ(rows, snapshot.id.size());
}

TEST_F(SnapshotFile, ExportsUnderNamesOfTheStep) {
  EXPECT_EQ(export_snapshot(snapshot, ExportFormat::csv, folder / "x").size(), 2u);
  EXPECT_EQ(export_snapshot(snapshot, ExportFormat::vtu, folder / "x").size(), 2u);
  EXPECT_TRUE(fs::exists(folder / "x" / "particles_000000004000.vtu"));
  std::string const pairs = content(folder / "x" / "contacts_000000004000.csv");
  EXPECT_EQ(static_cast<std::size_t>(std::count(pairs.begin(), pairs.end(), '\n')), snapshot.a.size() + 1);
  EXPECT_NE(pairs.find(",broken_"), std::string::npos);
  auto const particles = csv_rows(content(folder / "x" / "particles_000000004000.csv"));
  EXPECT_EQ(particles[0].back(), "shear_strain");
  std::vector<float> const shear = shear_strain(snapshot);
  ASSERT_EQ(particles.size(), shear.size() + 1);
  for (std::size_t i = 0; i < shear.size(); ++i) ASSERT_EQ(particles[i + 1].back(), fmt::format("{}", shear[i]));
  std::string const grid = content(folder / "x" / "contacts_000000004000.vtu");
  // 3 doubles a disc, 2 + 1 integers and 1 + 1 bytes and 5 doubles a pair, and ten lengths of 8 bytes lie behind the XML.
  std::size_t const raw = grid.rfind("\n</AppendedData>") - grid.find("_", grid.find("<AppendedData")) - 1;
  EXPECT_EQ(raw, snapshot.id.size() * 24 + snapshot.a.size() * (12 + 2 + 40) + 10 * 8);
}

/// A million bonded discs under stress, with the noise of real forces: a packed cell of 2,000 repeated.
Simulation million_discs() {
  Scene scene = hydrate_scene(0.55, ContactCoupling::parallel);
  scene.specimen.particles = 2000;
  scene.specimen.void_ratio = 0.23;
  scene.specimen.preparation_stress = 1e6;
  PackedSpecimen const cell = pack_periodic_cell(scene, design_sample(scene), 2000, {});
  double const area = 510 * cell.specimen.width() * cell.specimen.height(), width = std::sqrt(area / 2);
  Specimen s = replicate(cell.specimen, width, 2 * width);
  // Repeated discs would compress better than real ones.
  for (std::size_t i = 0; i < s.size(); ++i) {
    s.x[i] += 2e-9 * (uniform_random(1, 1, i) - 0.5);
    s.y[i] += 2e-9 * (uniform_random(1, 2, i) - 0.5);
    s.radius[i] *= 1 + 1e-3 * (uniform_random(1, 3, i) - 0.5);
    s.vx[i] = 1e-2 * (uniform_random(1, 4, i) - 0.5);
    s.vy[i] = 1e-2 * (uniform_random(1, 5, i) - 0.5);
    s.omega[i] = 100 * (uniform_random(1, 6, i) - 0.5);
    s.angle[i] = 0.1 * (uniform_random(1, 7, i) - 0.5);
  }
  bond_all(s, scene);
  Simulation sim(s, bonded_laws(scene, s.critical_thickness), 0.1 * grain_d50);
  sim.time_step = 1e-8;
  sim.step(20);
  return sim;
}

/// Half a per cent of strain, and a twentieth of a grain off it.
void strain(Field<Coord> const& places, double stretch, std::uint64_t stream) {
  auto const here = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), places);
  for (std::size_t i = 0; i < here.extent(0); ++i) here(i) = stretch * here(i) + 1e-5 * (uniform_random(2, stream, i) - 0.5);
  Kokkos::deep_copy(places, here);
}

TEST_F(SnapshotFile, LongAMillionDiscsAreWrittenInTenSecondsAndThirtyMegabytes) {
  Simulation sim = million_discs();
  sim.mark_start();
  strain(sim.assembly().start_x, 1.002, 1);
  strain(sim.assembly().start_y, 0.995, 2);
  ASSERT_NEAR(sim.assembly().discs(), 1e6, 2e4);
  auto const start = std::chrono::steady_clock::now();
  Snapshot big = take_snapshot(sim);
  big.d50 = grain_d50;
  write_snapshot(folder / "big.h5", big);
  double const seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  auto const bytes = static_cast<double>(fs::file_size(folder / "big.h5"));
  std::printf("%d particles, %zu pairs: %.1f s, %.1f MB\n", sim.assembly().discs(), big.a.size(), seconds, bytes * 1e-6);
  if (char const* const keep = std::getenv("CLATHRA_KEEP"))
    fs::copy_file(folder / "big.h5", keep, fs::copy_options::overwrite_existing);
  EXPECT_LT(seconds, 10);
  EXPECT_LT(bytes, 30e6);
}

}  // namespace
}  // namespace clathra
