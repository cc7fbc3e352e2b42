#include <gtest/gtest.h>
#include <hdf5.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

#include "io/formats/digest.hpp"
#include "io/results/specimen_file.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

class SpecimenFile : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder); }
  void TearDown() override { fs::remove_all(folder); }

  /// What reading a specimen says that was written with something wrong in it.
  std::string complaint(std::function<void(Specimen&)> const& spoil) {
    Specimen specimen = small();
    spoil(specimen);
    write_specimen(file, specimen);
    return complaint();
  }
  std::string complaint() {
    try {
      read_specimen(file);
    } catch (FileProblem const& problem) {
      EXPECT_EQ(problem.code, ExitCode::bad_input);
      EXPECT_EQ(std::string(problem.what()).find(file.string() + ": "), 0u) << problem.what();
      return problem.what();
    }
    return "taken";
  }

  /// Discs that do not touch, in rows.
  static Specimen small(int count = 5) {
    constexpr double pitch = 1.8e-4;
    int const columns = static_cast<int>(std::ceil(std::sqrt(count))), rows = (count + columns - 1) / columns;
    Specimen s;
    s.left = -1e-3, s.right = s.left + columns * pitch, s.bottom = 0, s.top = rows * pitch;
    s.d50 = 0.1640e-3, s.stress = 5e4, s.critical_thickness = 1.5e-5;
    s.separate_bonds = true;
    s.provenance = "{\"seed\":1}";
    std::mt19937 random(1);
    std::uniform_real_distribution<double> number(-1, 1);
    double solid = 0;
    for (int i = 0; i < count; ++i) {
      s.id.push_back(static_cast<int>((i * std::int64_t{7} + 1) % count));  // in any order
      s.x.push_back(s.left + (i % columns + 0.5) * pitch + number(random) * 5e-6);
      s.y.push_back((i / columns + 0.5) * pitch + number(random) * 5e-6);
      for (auto* column : {&s.angle, &s.vx, &s.vy, &s.omega}) column->push_back(number(random) * 1e-3);
      s.radius.push_back(8e-5 + 1e-6 * (i % 5));
      solid += std::numbers::pi * s.radius.back() * s.radius.back();
    }
    s.void_ratio = s.width() * s.height() / solid - 1;
    s.contacts = {{0, 1, 1.5, -2e-5, 1e300, 0, 0}, {1, 4, 0.1, 3e-6, -1e-6, 7.5, 8e-5}};
    return s;
  }

  fs::path const folder = fs::temp_directory_path() / ("clathra_specimen_" + std::to_string(::getpid()));
  fs::path const file = folder / "specimen.h5";
};

TEST_F(SpecimenFile, KeepsEveryBit) {
  Specimen const written = small();
  write_specimen(file, written);
  Specimen const read = read_specimen(file);
  EXPECT_EQ(specimen_hash(read), specimen_hash(written));
  EXPECT_EQ(read.id, written.id);
  EXPECT_EQ(read.x, written.x);
  EXPECT_EQ(read.radius, written.radius);
  EXPECT_EQ(read.top, written.top);
  EXPECT_EQ(read.d50, written.d50);
  EXPECT_EQ(read.critical_thickness, written.critical_thickness);
  EXPECT_EQ(read.separate_bonds, written.separate_bonds);
  EXPECT_EQ(read.provenance, written.provenance);
  ASSERT_EQ(read.contacts.size(), 2u);
  EXPECT_EQ(read.contacts[1].formation_overlap, -1e-6);
  EXPECT_EQ(read.contacts[1].bond_moment, 8e-5);
  EXPECT_EQ(read.contacts[0].formation_overlap, 1e300);
}

TEST_F(SpecimenFile, TakesSpecimensOfManyChunksAndWithoutContactsOrProvenance) {
  Specimen specimen = small(200000);
  specimen.contacts.clear();
  specimen.provenance.clear();
  write_specimen(file, specimen);
  EXPECT_EQ(specimen_hash(read_specimen(file)), specimen_hash(specimen));
}

TEST_F(SpecimenFile, LeavesNothingButTheFile) {
  write_specimen(file, small());
  write_specimen(file, small());
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
}

TEST_F(SpecimenFile, TheHashDependsOnEveryValueButNotOnTheOrder) {
  Specimen const base = small();
  Specimen shuffled = base;
  for (auto* column : {&shuffled.x, &shuffled.y, &shuffled.angle, &shuffled.vx, &shuffled.vy, &shuffled.omega, &shuffled.radius})
    std::swap(column->at(0), column->at(3));
  std::swap(shuffled.id[0], shuffled.id[3]);
  std::swap(shuffled.contacts[0], shuffled.contacts[1]);
  EXPECT_EQ(specimen_hash(shuffled), specimen_hash(base));
  Specimen changed = base;
  changed.omega[2] = std::nextafter(changed.omega[2], 1);
  EXPECT_NE(specimen_hash(changed), specimen_hash(base));
  changed = base;
  changed.contacts[1].bond_shear += 1;
  EXPECT_NE(specimen_hash(changed), specimen_hash(base));
}

TEST_F(SpecimenFile, RefusesWhatNoSpecimenCanBe) {
  auto const expect = [&](char const* wanted, std::function<void(Specimen&)> const& spoil) {
    std::string const text = complaint(spoil);
    EXPECT_NE(text.find(wanted), std::string::npos) << text;
  };
  double const nan = std::numeric_limits<double>::quiet_NaN();
  expect("particle id 1 comes twice", [](Specimen& s) { s.id = {0, 1, 1, 2, 3}; });
  expect("particle id 5 is outside 0..4", [](Specimen& s) { s.id[0] = 5; });
  expect("particle id -1 is outside", [](Specimen& s) { s.id[0] = -1; });
  expect("vx of particle", [&](Specimen& s) { s.vx[2] = nan; });
  expect("y of particle", [](Specimen& s) { s.y[2] = std::numeric_limits<double>::infinity(); });
  expect("the radius of particle", [](Specimen& s) { s.radius[1] = 0; });
  expect("the radius of particle", [](Specimen& s) { s.radius[1] = -1e-4; });
  expect("contact 1 - 5 names a particle that is not there", [](Specimen& s) { s.contacts[1].id_b = 5; });
  expect("contact 1 - 1 is not between two particles", [](Specimen& s) { s.contacts[1].id_b = 1; });
  expect("contact 0 - 1 comes twice", [](Specimen& s) { s.contacts[1] = s.contacts[0]; });
  expect("moment of contact", [&](Specimen& s) { s.contacts[0].moment = nan; });
  expect("the walls enclose no area", [](Specimen& s) { s.right = s.left; });
  expect("stress is not a finite number", [&](Specimen& s) { s.stress = nan; });
  expect("density is not above 0", [](Specimen& s) { s.density = 0; });
  expect("particles/y has 4 rows instead of 5", [](Specimen& s) { s.y.pop_back(); });
  EXPECT_EQ(complaint([](Specimen&) {}), "taken");
}

TEST_F(SpecimenFile, RefusesOtherAndDamagedFiles) {
  EXPECT_THROW(read_specimen(folder / "none.h5"), FileProblem);
  EXPECT_THROW(read_specimen(folder), FileProblem);
  std::ofstream(file) << "particles = 2000\n";
  EXPECT_NE(complaint().find("not an HDF5 file"), std::string::npos);
  hid_t const other = H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  H5Fclose(other);
  EXPECT_NE(complaint().find("lacks what a specimen file must hold: the attributes format, version, left"), std::string::npos);
}

TEST_F(SpecimenFile, AFlippedByteOrATruncationNeverPassesForAnotherState) {
  Specimen const original = small(3000);
  write_specimen(file, original);
  std::ifstream in(file, std::ios::binary);
  std::string const bytes((std::istreambuf_iterator<char>(in)), {});
  std::mt19937 random(7);
  int refused = 0;
  for (int i = 0; i < 300; ++i) {
    std::string broken = bytes;
    if (i % 10 == 0)
      broken.resize(random() % bytes.size());
    else
      broken[random() % bytes.size()] ^= static_cast<char>(1 + random() % 255);
    std::ofstream(file, std::ios::binary) << broken;
    try {
      Specimen const read = read_specimen(file);
      // Bytes that hold nothing (padding, names of units) may change; the columns are under a checksum.
      EXPECT_EQ(read.x, original.x);
      EXPECT_EQ(read.radius, original.radius);
    } catch (FileProblem const&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 150);
}

TEST_F(SpecimenFile, AFullDiskIsReportedAndTheEarlierFileKept) {
  Specimen const earlier = small();
  write_specimen(file, earlier);
  rlimit unlimited{};
  ::getrlimit(RLIMIT_FSIZE, &unlimited);
  rlimit limited = unlimited;
  limited.rlim_cur = 100000;
  auto const previous = std::signal(SIGXFSZ, SIG_IGN);
  ::setrlimit(RLIMIT_FSIZE, &limited);
  std::string text = "written";
  ExitCode code = ExitCode::done;
  try {
    write_specimen(file, small(50000));
  } catch (FileProblem const& problem) {
    text = problem.what();
    code = problem.code;
  }
  ::setrlimit(RLIMIT_FSIZE, &unlimited);
  std::signal(SIGXFSZ, previous);
  EXPECT_EQ(code, ExitCode::io_error) << text;
  EXPECT_EQ(text.find(file.string() + ": "), 0u) << text;
  EXPECT_TRUE(text.ends_with(": File too large")) << "and nothing of HDF5's: " << text;
  EXPECT_EQ(specimen_hash(read_specimen(file)), specimen_hash(earlier));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
}

TEST_F(SpecimenFile, AFolderThatIsNotThereCannotBeWrittenTo) {
  try {
    write_specimen(folder / "none" / "specimen.h5", small());
    ADD_FAILURE();
  } catch (FileProblem const& problem) {
    EXPECT_EQ(problem.code, ExitCode::cannot_create);
    EXPECT_NE(std::string(problem.what()).find("No such file or directory"), std::string::npos) << problem.what();
    EXPECT_EQ(std::string(problem.what()).find("tmp-"), std::string::npos) << problem.what();
  }
}

TEST(Digest, IsThatOfTheReferenceImplementation) { EXPECT_EQ(text_digest(""), "99aa06d3014798d86001c324468d497f"); }

}  // namespace
}  // namespace clathra
