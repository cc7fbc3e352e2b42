/// Specimen files whose numbers do not agree with their discs, whose discs can be no specimen, and those that other programs
/// make.
#include <gtest/gtest.h>
#include <hdf5.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>

#include "command.hpp"
#include "io/results/specimen_check.hpp"
#include "io/results/specimen_file.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

/// 100 discs at rest under 1 MPa, taken for a specimen that was just made: without bonds, not sheared.
Specimen resting() {
  Specimen s = read_specimen(fs::path(CLATHRA_GOLDEN) / "specimen.h5");
  s.axial_strain = 0;
  s.critical_thickness = 0;
  s.separate_bonds = false;
  s.contacts.clear();
  return s;
}

std::size_t place(Specimen const& s, int id) {
  return static_cast<std::size_t>(std::find(s.id.begin(), s.id.end(), id) - s.id.begin());
}

double area_of(Specimen const& s) {
  double area = 0;
  for (double const r : s.radius) area += std::numbers::pi * r * r;
  return area;
}

void scale_lengths(Specimen& s, double factor) {
  for (double* const at : {&s.left, &s.right, &s.bottom, &s.top, &s.d50}) *at *= factor;
  for (auto* const column : {&s.x, &s.y, &s.radius})
    for (double& value : *column) value *= factor;
}

class SpecimenCheck : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder); }
  void TearDown() override { fs::remove_all(folder); }

  void write(std::function<void(Specimen&)> const& change) {
    Specimen specimen = resting();
    change(specimen);
    write_specimen(file, specimen);
  }
  /// Takes attributes and data sets out of the file.
  void leave_out(std::vector<std::string> const& names) {
    hid_t const opened = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    for (std::string const& name : names) {
      bool const gone = H5Aexists(opened, name.c_str()) > 0 ? H5Adelete(opened, name.c_str()) >= 0
                                                            : H5Ldelete(opened, name.c_str(), H5P_DEFAULT) >= 0;
      EXPECT_TRUE(gone) << name;
    }
    H5Fclose(opened);
  }
  std::string complaint() {
    try {
      read_specimen(file);
    } catch (FileProblem const& problem) {
      EXPECT_EQ(problem.code, ExitCode::bad_input);
      return problem.what();
    }
    return "taken";
  }
  void refuses(std::string const& wanted, std::function<void(Specimen&)> const& change) {
    write(change);
    std::string const text = complaint();
    EXPECT_NE(text.find(wanted), std::string::npos) << "not said: " << wanted << "\n" << text;
  }
  void takes(std::function<void(Specimen&)> const& change) {
    write(change);
    EXPECT_EQ(complaint(), "taken");
  }
  /// Warnings of a test of the file by a scene.
  std::string warnings(double kn = 3e8) {
    Scene scene;
    scene.grains.kn = kn;
    CheckedSpecimen const read = read_checked_specimen(file);
    std::string text;
    for (std::string const& warning : oddities(file, read.specimen, read.facts)) text += warning + "\n";
    for (std::string const& warning : stress_oddities(file, read.specimen, read.facts, scene)) text += warning + "\n";
    return text;
  }
  CommandResult by_scene(std::string const& verb, std::string const& more = "") {
    std::ofstream(folder / "a.toml") << "[sample]\ngenerator = \"file\"\nfile = \"specimen.h5\"\n[hydrate]\nsaturation = 0\n";
    return run_clathra(verb + " '" + (folder / "a.toml").string() + "' " + more);
  }

  fs::path const folder = fs::temp_directory_path() / ("clathra_specimen_check_" + std::to_string(::getpid()));
  fs::path const file = folder / "specimen.h5";
};

TEST_F(SpecimenCheck, ASpecimenOfOursIsTakenWithoutAWord) {
  takes([](Specimen&) {});
  EXPECT_EQ(warnings(), "");
  SpecimenFacts const facts = read_checked_specimen(file).facts;
  EXPECT_EQ(facts.outline.discs, 100);
  EXPECT_NEAR(facts.overlaps.stress * 3e8 / 1e6, 0.77, 0.01);  // as scripts with h5py find it
  EXPECT_EQ(facts.overlaps.touching, 141);
}

TEST_F(SpecimenCheck, TheD50MustBeThatOfTheDiscs) {
  refuses("its attribute d50 is 0.3388 mm, that of its discs is 0.168976 mm", [](Specimen& s) { s.d50 *= 2; });
  refuses("its attribute d50 is 0.0001694 mm, that of its discs is 0.168976 mm", [](Specimen& s) { s.d50 *= 1e-3; });
  refuses("its attribute d50 is 169.4 mm, that of its discs is 0.168976 mm", [](Specimen& s) { s.d50 *= 1e3; });
  refuses("its attribute d50", [](Specimen& s) { s.d50 *= 0.9; });
  takes([](Specimen& s) { s.d50 *= 1.03; });
}

/// Ten discs of 0.8 mm and, of half of the sand, as many of 0.2 mm as that is.
std::function<void(Specimen&)> two_sizes(double d50) {
  return [d50](Specimen& s) {
    s = Specimen();
    auto const add = [&](double x, double y, double radius) {
      s.id.push_back(static_cast<int>(s.id.size()));
      s.x.push_back(x), s.y.push_back(y), s.radius.push_back(radius);
      for (auto* const column : {&s.angle, &s.vx, &s.vy, &s.omega}) column->push_back(0);
    };
    for (int i = 0; i < 10; ++i) add((2 * i + 1) * 4e-4, 4e-4, 4e-4);
    for (int i = 0; i < 165; ++i) add((2 * (i % 40) + 1) * 1e-4, 8e-4 + (2 * (i / 40) + 1) * 1e-4, 1e-4);
    s.right = 8e-3, s.top = 1.8e-3;
    s.d50 = d50;
    s.void_ratio = s.width() * s.height() / area_of(s) - 1;
  };
}

/// Either is the d50, and all between them.
TEST_F(SpecimenCheck, WhereTheCurveIsFlatTheD50MayBeAnyOfItsSizes) {
  for (double const d50 : {2e-4, 4e-4, 8e-4}) takes(two_sizes(d50));
  refuses("its attribute d50 is 1 mm, that of its discs is 0.2 mm", two_sizes(1e-3));
  refuses("its attribute d50 is 0.18 mm, that of its discs is 0.2 mm", two_sizes(1.8e-4));
}

TEST_F(SpecimenCheck, TheVoidRatioMustBeThatOfTheDiscsBetweenTheWalls) {
  refuses("its attribute void_ratio is 0.2684, that of its discs between its walls is 0.2664",
          [](Specimen& s) { s.void_ratio = 0.2684; });
  takes([](Specimen& s) { s.void_ratio += 0.9e-3; });
  refuses("that of its discs between its walls is", [](Specimen& s) {
    for (double& r : s.radius) r *= 1.15;
    s.d50 *= 1.15;
  });
  refuses("d50) from the nearest disc", [](Specimen& s) { s.top += s.height(); });
}

TEST_F(SpecimenCheck, DiscsMustLieBetweenTheWalls) {
  refuses("disc 17 has its centre 0.847 mm outside of the left wall",
          [](Specimen& s) { s.x[place(s, 17)] = s.left - 5 * 0.1694e-3; });
  refuses("outside of the right wall, 5", [](Specimen& s) { s.right = s.left + s.width() / 2; });
  refuses("disc 3 has its centre 1e-06 mm outside of the top wall", [](Specimen& s) { s.y[place(s, 3)] = s.top + 1e-9; });
}

TEST_F(SpecimenCheck, DiscsMustNotBeAtOnePlace) {
  auto const onto = [](double away) {
    return [away](Specimen& s) {
      std::size_t const a = place(s, 12), b = place(s, 60);
      s.x[b] = s.x[a] + away, s.y[b] = s.y[a];
    };
  };
  refuses("and disc 60 overlap by", onto(0));
  refuses("disc 12 at (", onto(1e-5));
}

TEST_F(SpecimenCheck, LengthsMustBeMetres) {
  refuses("larger than 0.169 m: these look like mm, lengths must be in m", [](Specimen& s) { scale_lengths(s, 1e3); });
  refuses("larger than 0.169 m: these look like mm", [](Specimen& s) {
    for (double& r : s.radius) r *= 1e3;
  });
  refuses("smaller than 1.69e-10 m: lengths must be in m", [](Specimen& s) { scale_lengths(s, 1e-6); });
}

TEST_F(SpecimenCheck, PlacesAndRadiiMustBeInTheSameUnit) {
  write([](Specimen& s) {
    for (double* const at : {&s.left, &s.right, &s.bottom, &s.top}) *at *= 1e3;
    for (auto* const column : {&s.x, &s.y})
      for (double& value : *column) value *= 1e3;
  });
  leave_out({"void_ratio"});
  EXPECT_NE(complaint().find("places, walls and radii must all be in m"), std::string::npos) << complaint();
  write([](Specimen& s) {
    for (double& r : s.radius) r *= 0.5;
    s.d50 *= 0.5;
  });
  leave_out({"void_ratio"});
  EXPECT_NE(warnings().find("its void ratio is 4.066; sand at rest has 0.05 to 1"), std::string::npos) << warnings();
}

TEST_F(SpecimenCheck, NumbersThatCannotBeAreRefused) {
  refuses("stress must not be below 0, got -50000", [](Specimen& s) { s.stress = -5e4; });
  refuses("critical_thickness must not be below 0, got -1", [](Specimen& s) { s.critical_thickness = -1; });
  write([](Specimen&) {});
  leave_out({"particles/id"});
  hid_t const opened = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  hsize_t const discs = 100;
  hid_t const space = H5Screate_simple(1, &discs, nullptr);
  hid_t const set = H5Dcreate2(opened, "particles/id", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  std::vector<double> halves;
  for (std::size_t i = 0; i < discs; ++i) halves.push_back(static_cast<double>(i) + 0.5);
  EXPECT_GE(H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, halves.data()), 0);
  H5Dclose(set), H5Sclose(space), H5Fclose(opened);
  EXPECT_NE(complaint().find("particles/id must hold whole numbers, got 0.5"), std::string::npos) << complaint();
}

/// Attributes of the file, as other programs may write them.
TEST_F(SpecimenCheck, AttributesThatCannotBeAreRefused) {
  struct Case {
    char const *name, *wanted;
    double value;
  };
  for (Case const& c : {Case{"version", "version must be a whole number, got 2.5", 2.5},
                        {"separate_bonds", "separate_bonds must be 0 or 1, got 7", 7},
                        {"periodic", "periodic must be 0 or 1, got -1", -1},
                        {"axial_strain", "axial_strain must lie between -1 and 1, got -1", -1},
                        {"axial_strain", "axial_strain must lie between -1 and 1, got 1000000000", 1e9}}) {
    write([](Specimen&) {});
    leave_out({c.name});
    hid_t const opened = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), one = H5Screate(H5S_SCALAR);
    hid_t const attribute = H5Acreate2(opened, c.name, H5T_NATIVE_DOUBLE, one, H5P_DEFAULT, H5P_DEFAULT);
    EXPECT_GE(H5Awrite(attribute, H5T_NATIVE_DOUBLE, &c.value), 0);
    H5Aclose(attribute), H5Sclose(one), H5Fclose(opened);
    EXPECT_NE(complaint().find(c.wanted), std::string::npos) << complaint();
  }
}

TEST_F(SpecimenCheck, MotionAndForcesThatCannotBeAreRefused) {
  refuses("disc 17 moves or spins at 1e+08 m/s", [](Specimen& s) { s.vx[place(s, 17)] = -1e8; });
  refuses("disc 3 moves or spins at", [](Specimen& s) { s.omega[place(s, 3)] = 1e9; });
  auto const contact = [](double SpecimenContact::*number, double value) {
    return [=](Specimen& s) { s.contacts.push_back({}), s.contacts.back().id_b = 1, s.contacts.back().*number = value; };
  };
  refuses("shear of contact 0 - 1 is 1e+300; with a d50 of", contact(&SpecimenContact::shear, 1e300));
  auto const bond = [](double critical_thickness, double overlap) {
    return [=](Specimen& s) {
      s.critical_thickness = critical_thickness;
      s.contacts.push_back({});
      s.contacts.back().id_b = 1, s.contacts.back().formation_overlap = overlap;
    };
  };
  refuses("formation_overlap of contact 0 - 1 is 1; with a d50 of", bond(1e-5, 1));
  refuses("the bond 0 - 1 has no h_max: critical_thickness is left out or 0", bond(0, -1e-6));
  refuses("the bond 0 - 1 formed across 12 um, h_max (critical_thickness) is 10 um", bond(1e-5, -1.2e-5));
  takes(bond(1e-5, -1e-5));
  refuses("contact 0 - 100 names a disc that is not there: ids go to 99",
          [](Specimen& s) { s.contacts.push_back({}), s.contacts.back().id_b = 100; });
  takes(contact(&SpecimenContact::shear, 1e4));
}

TEST_F(SpecimenCheck, ASpecimenThatIsNotAtRestIsWarnedOf) {
  write([](Specimen& s) { s.vx[place(s, 17)] = 30; });
  EXPECT_NE(warnings().find("disc 17 moves or spins at 30 m/s, worth 2340 kPa"), std::string::npos) << warnings();
  write([](Specimen& s) { s.vx[place(s, 17)] = 3, s.stress = 0; });
  EXPECT_NE(warnings().find("disc 17 moves or spins at 3 m/s"), std::string::npos) << warnings();
  write([](Specimen& s) { s.vx[place(s, 17)] = 0.1; });
  EXPECT_EQ(warnings(), "");
}

TEST_F(SpecimenCheck, ABoxSmallerThanItsSandIsWarnedOf) {
  write([](Specimen& s) { s.right -= 0.03e-3; });
  leave_out({"void_ratio"});
  EXPECT_NE(warnings().find("d50 into the right wall: the box is smaller than its sand"), std::string::npos) << warnings();
  write([](Specimen& s) { s.right -= 0.03e-3, s.axial_strain = 0.05; });  // platens press discs into themselves
  leave_out({"void_ratio"});
  EXPECT_EQ(warnings(), "");
}

TEST_F(SpecimenCheck, PlacesMustBeExactEnoughForOverlaps) {
  auto const move = [](double by) {
    return [by](Specimen& s) {
      s.left += by, s.right += by;
      for (double& x : s.x) x += by;
    };
  };
  refuses("it reaches to 1e+06 m from the origin, 5.92e+09 times the d50 of its discs", move(1e6));
  takes(move(1e3));
}

TEST_F(SpecimenCheck, ABoxLargerThanItsSandIsWarnedOf) {
  write([](Specimen& s) { s.top += s.height(); });
  leave_out({"void_ratio"});
  EXPECT_NE(warnings().find("d50) from the nearest disc: the box is larger than its sand"), std::string::npos) << warnings();
  EXPECT_TRUE(says(run_clathra("info '" + file.string() + "'"), "warning: " + file.string() + ": the top wall is "));
  EXPECT_TRUE(says(by_scene("check", "--force"), "the box is larger than its sand"));
  EXPECT_TRUE(says(by_scene("run", "--force --dry-run"), "the box is larger than its sand"));
}

TEST_F(SpecimenCheck, DiscsTooLargeForTheirPlacesAreWarnedOf) {
  write([](Specimen& s) {
    for (double& r : s.radius) r *= 1.15;
  });
  leave_out({"void_ratio", "d50"});
  EXPECT_NE(warnings().find("% of the pairs that touch overlap by more than a tenth of the smaller radius"), std::string::npos);
  EXPECT_NE(warnings().find("says that it rests under 1000 kPa; by the overlaps"), std::string::npos) << warnings();
}

/// As of the grading of a specimen that is made.
TEST_F(SpecimenCheck, SizesThatMakeOddTestsAreWarnedOf) {
  write([](Specimen& s) { scale_lengths(s, 1e-3); });
  EXPECT_NE(warnings().find("half of the grains are finer than 0.000169 mm, clay by size"), std::string::npos) << warnings();
  write(two_sizes(2e-4));
  EXPECT_NE(warnings().find("hardly any grains around 50 %: 49 % are finer than 0.2 mm, 51 % finer than 0.8 mm"),
            std::string::npos)
      << warnings();
  write([](Specimen& s) {
    for (double& r : s.radius) r = 5e-5;
  });
  leave_out({"void_ratio", "d50"});
  EXPECT_NE(warnings().find("the discs are as good as equal (d90 / d10 = 1)"), std::string::npos) << warnings();
}

TEST_F(SpecimenCheck, AStressThatTheOverlapsDoNotShowIsWarnedOf) {
  std::string const wanted = "says that it rests under 1000 kPa; by the overlaps of its discs and a kn of 100 MPa it carries";
  write([](Specimen&) {});
  EXPECT_NE(warnings(1e8).find(wanted), std::string::npos) << warnings(1e8);
  // The stiffness that it came to rest with is what counts, where the file says it.
  write([](Specimen& s) { s.provenance = R"({"made_of": {"grains.kn": "0.3 GPa"}})"; });
  EXPECT_EQ(warnings(1e8), "");
  for (auto const& change : std::vector<std::function<void(Specimen&)>>{[](Specimen& s) { s.axial_strain = 0.01; },
                                                                        [](Specimen& s) { s.critical_thickness = 1e-5; },
                                                                        [](Specimen& s) { s.stress = 0; }}) {
    write(change);
    EXPECT_EQ(warnings(1e8), "");
  }
}

TEST_F(SpecimenCheck, ATestTakesNoPeriodicCell) {
  write([](Specimen& s) { s.periodic = true; });
  EXPECT_TRUE(says(run_clathra("info '" + file.string() + "'"), ", periodic"));
  std::ofstream(folder / "study.toml") << "scene = \"a.toml\"\n";
  for (CommandResult const& result :
       {by_scene("check"), by_scene("run", "--dry-run"),
        run_clathra("study '" + (folder / "study.toml").string() + "' --output '" + (folder / "out").string() + "' --dry-run")}) {
    EXPECT_EQ(result.code, 65) << result.output;
    EXPECT_TRUE(says(result, "is a periodic cell: a test loads a specimen by its walls"));
  }
}

TEST_F(SpecimenCheck, EverythingThatIsMissingIsSaidAtOnce) {
  write([](Specimen&) {});
  leave_out({"version", "left", "density", "particles/x", "particles/radius"});
  EXPECT_EQ(complaint(), file.string() +
                             ": lacks what a specimen file must hold: the attributes version, left, density, and the data "
                             "sets particles/x, particles/radius (docs/specimen-file.md lists all)");
  EXPECT_TRUE(says(run_clathra("info '" + file.string() + "'"), "the attributes version, left, density, and the data sets"));
}

TEST_F(SpecimenCheck, WhatNeedNotBeThereHasDefaults) {
  Specimen const whole = resting();
  write([](Specimen&) {});
  leave_out({"particles", "contacts", "particles/angle", "particles/vx", "particles/vy", "particles/omega", "d50", "void_ratio"});
  leave_out({"stress", "axial_strain", "separate_bonds", "critical_thickness", "periodic", "provenance", "particles/id"});
  leave_out({"contacts"});  // the group
  Specimen const read = read_specimen(file);
  EXPECT_EQ(read.size(), 100u);
  EXPECT_EQ(read.id.back(), 99);
  EXPECT_EQ(read.x, whole.x);
  EXPECT_EQ(read.vx, std::vector<double>(100, 0.0));
  EXPECT_EQ(read.omega.size(), 100u);
  EXPECT_TRUE(read.contacts.empty());
  EXPECT_NEAR(read.d50, 0.168976e-3, 1e-9);
  EXPECT_NEAR(read.void_ratio, whole.void_ratio, 1e-12);
  EXPECT_EQ(read.axial_strain, 0);
  EXPECT_EQ(read.stress, 0);
  EXPECT_EQ(read.critical_thickness, 0);
  EXPECT_EQ(read.provenance, "");
  EXPECT_FALSE(read.periodic || read.separate_bonds);
}

/// Strings as h5py writes them, the unit columns as int64 and float.
TEST_F(SpecimenCheck, StringsOfVariableLengthAndOtherNumbersAreRead) {
  write([](Specimen&) {});
  leave_out({"format", "provenance", "particles/id", "particles/angle"});
  hid_t const opened = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), text = H5Tcopy(H5T_C_S1), one = H5Screate(H5S_SCALAR);
  H5Tset_size(text, H5T_VARIABLE);
  H5Tset_cset(text, H5T_CSET_UTF8);
  char const *format = "clathra specimen", *provenance = "{\"by\": \"hand\"}";
  hid_t const attribute = H5Acreate2(opened, "format", text, one, H5P_DEFAULT, H5P_DEFAULT);
  EXPECT_GE(H5Awrite(attribute, text, &format), 0);
  hid_t const set = H5Dcreate2(opened, "provenance", text, one, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  EXPECT_GE(H5Dwrite(set, text, H5S_ALL, H5S_ALL, H5P_DEFAULT, &provenance), 0);
  hsize_t const rows = 100;
  hid_t const column = H5Screate_simple(1, &rows, nullptr);
  Specimen const whole = resting();
  std::vector<long long> const ids(whole.id.begin(), whole.id.end());
  std::vector<float> const angles(100, 0.5f);
  hid_t const id = H5Dcreate2(opened, "particles/id", H5T_STD_I64LE, column, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  EXPECT_GE(H5Dwrite(id, H5T_NATIVE_LLONG, H5S_ALL, H5S_ALL, H5P_DEFAULT, ids.data()), 0);
  hid_t const angle = H5Dcreate2(opened, "particles/angle", H5T_IEEE_F32LE, column, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  EXPECT_GE(H5Dwrite(angle, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, angles.data()), 0);
  for (hid_t const data : {set, id, angle}) H5Dclose(data);
  H5Aclose(attribute), H5Tclose(text), H5Sclose(one), H5Sclose(column), H5Fclose(opened);
  Specimen const read = read_specimen(file);
  EXPECT_EQ(read.provenance, provenance);
  EXPECT_EQ(read.id, whole.id);
  EXPECT_EQ(read.angle[7], 0.5);
}

}  // namespace
}  // namespace clathra
