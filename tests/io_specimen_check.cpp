/// Specimen files whose numbers do not agree with their discs, whose discs can be no specimen, and those that other programs
/// make.
#include <gtest/gtest.h>

#include "specimen_in_a_file.hpp"

namespace clathra {
namespace {

TEST_F(SpecimenCheck, ASpecimenOfOursIsTakenWithoutAWord) {
  takes([](Specimen&) {});
  EXPECT_EQ(warnings(), "");
  SpecimenFacts const facts = read_checked_specimen(file).facts;
  EXPECT_EQ(facts.outline.discs, 100);
  EXPECT_NEAR(facts.overlaps.stress * 3e8 / 1e6, 0.77, 0.01);  // as scripts with h5py find it
  EXPECT_EQ(facts.overlaps.touching, 141);
}

TEST_F(SpecimenCheck, TheD50MustBeThatOfTheDiscs) {
  refuses("its attribute d50 is 0.3388 mm, that of its particles is 0.168976 mm", [](Specimen& s) { s.d50 *= 2; });
  refuses("its attribute d50 is 0.0001694 mm, that of its particles is 0.168976 mm", [](Specimen& s) { s.d50 *= 1e-3; });
  refuses("its attribute d50 is 169.4 mm, that of its particles is 0.168976 mm", [](Specimen& s) { s.d50 *= 1e3; });
  refuses("its attribute d50", [](Specimen& s) { s.d50 *= 0.9; });
  takes([](Specimen& s) { s.d50 *= 1.03; });
}

/// Either is the d50, and all between them.
TEST_F(SpecimenCheck, WhereTheCurveIsFlatTheD50MayBeAnyOfItsSizes) {
  for (double const d50 : {2e-4, 4e-4, 8e-4}) takes(two_sizes(d50));
  refuses("its attribute d50 is 1 mm, that of its particles is 0.2 mm", two_sizes(1e-3));
  refuses("its attribute d50 is 0.18 mm, that of its particles is 0.2 mm", two_sizes(1.8e-4));
}

TEST_F(SpecimenCheck, TheVoidRatioMustBeThatOfTheDiscsBetweenTheWalls) {
  refuses("its attribute void_ratio is 0.2684, that of its particles between its walls is 0.2664",
          [](Specimen& s) { s.void_ratio = 0.2684; });
  takes([](Specimen& s) { s.void_ratio += 0.9e-3; });
  refuses("that of its particles between its walls is", [](Specimen& s) {
    for (double& r : s.radius) r *= 1.15;
    s.d50 *= 1.15;
  });
  refuses("d50) from the nearest particle", [](Specimen& s) { s.top += s.height(); });
}

TEST_F(SpecimenCheck, DiscsMustLieBetweenTheWalls) {
  refuses("particle 17 has its centre 0.847 mm outside of the left wall",
          [](Specimen& s) { s.x[place(s, 17)] = s.left - 5 * 0.1694e-3; });
  refuses("outside of the right wall, 5", [](Specimen& s) { s.right = s.left + s.width() / 2; });
  refuses("particle 3 has its centre 1e-06 mm outside of the top wall", [](Specimen& s) { s.y[place(s, 3)] = s.top + 1e-9; });
}

TEST_F(SpecimenCheck, DiscsMustNotBeAtOnePlace) {
  auto const onto = [](double away) {
    return [away](Specimen& s) {
      std::size_t const a = place(s, 12), b = place(s, 60);
      s.x[b] = s.x[a] + away, s.y[b] = s.y[a];
    };
  };
  refuses("and particle 60 overlap by", onto(0));
  refuses("particle 12 at (", onto(1e-5));
}

TEST_F(SpecimenCheck, TheDensityMustBeThatOfGrains) {
  refuses("its attribute density is 2.6; grains have 100 to 30000 kg/m^3", [](Specimen& s) { s.density = 2.6; });
}

TEST_F(SpecimenCheck, SizesMustBeThoseOfOneSand) {
  refuses("around it may lie more neighbours than the", [](Specimen& s) { s.radius[0] = 1e-7; });
  refuses("around it may lie more neighbours than the", [](Specimen& s) { s.radius[0] = 1e-30; });
}

TEST_F(SpecimenCheck, LengthsMustBeMetres) {
  refuses("larger than 0.169 m: these look like mm, lengths must be in m", [](Specimen& s) { scale_lengths(s, 1e3); });
  refuses("larger than 0.169 m: these look like mm", [](Specimen& s) {
    for (double& r : s.radius) r *= 1e3;
  });
  refuses("smaller than 1.69e-10 m: lengths must be in m", [](Specimen& s) { scale_lengths(s, 1e-6); });
}

TEST_F(SpecimenCheck, UnitsThatAreStatedMustBeThoseOfTheFormat) {
  auto const refused = [&](std::string const& object, char const* attribute, std::string const& unit, std::string const& wanted) {
    write([](Specimen& s) { s.contacts.push_back({0, 1}); });
    restate(object, attribute, unit);
    EXPECT_EQ(complaint(), wanted.empty() ? "taken" : file.string() + ": " + wanted);
  };
  refused("particles/x", "unit", "mm", "particles/x is in 'mm' by its unit; it must be in m");
  refused("contacts/shear", "unit", "kN/m", "contacts/shear is in 'kN/m' by its unit; it must be in N/m");
  refused("/", "stress_unit",
          "\xc2\xb5"
          "Pa",
          "stress is in '\xc2\xb5"
          "Pa' by its unit; it must be in Pa");
  refused("contacts/formation_overlap", "unit", "m", "");
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
  refuses("particle 17 moves or spins at 1e+08 m/s", [](Specimen& s) { s.vx[place(s, 17)] = -1e8; });
  refuses("particle 3 moves or spins at", [](Specimen& s) { s.omega[place(s, 3)] = 1e9; });
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
  refuses("contact 0 - 100 names a particle that is not there: ids go to 99",
          [](Specimen& s) { s.contacts.push_back({}), s.contacts.back().id_b = 100; });
  takes(contact(&SpecimenContact::shear, 1e4));
}

TEST_F(SpecimenCheck, PlacesMustBeExactEnoughForOverlaps) {
  auto const move = [](double by) {
    return [by](Specimen& s) {
      s.left += by, s.right += by;
      for (double& x : s.x) x += by;
    };
  };
  refuses("it reaches to 1e+06 m from the origin, 5.92e+09 times the d50 of its particles", move(1e6));
  takes(move(1e3));
}

TEST_F(SpecimenCheck, ATestTakesNoPeriodicCell) {
  write([](Specimen& s) { s.periodic = true; });
  EXPECT_TRUE(says(run_clathra("info '" + file.string() + "'"), ", periodic"));
  std::ofstream(folder / "study.toml") << "scene = \"a.toml\"\n";
  for (CommandResult const& result :
       {by_scene("check"), by_scene("run"),
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
                             "sets particles/x, particles/radius (docs/reference/specimen-file.md lists all)");
  EXPECT_TRUE(says(run_clathra("info '" + file.string() + "'"), "the attributes version, left, density, and the data sets"));
  write([](Specimen& s) { s.contacts.push_back({0, 1}); });
  leave_out({"particles/y", "contacts/id_a", "contacts/id_b"});
  EXPECT_NE(complaint().find("the data sets particles/y, contacts/id_a, contacts/id_b"), std::string::npos) << complaint();
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
