#pragma once
/// A specimen file that tests change and then read as the program does.
#include <gtest/gtest.h>
#include <hdf5.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "command.hpp"
#include "io/results/specimen_check.hpp"
#include "io/results/specimen_file.hpp"

namespace clathra {

namespace fs = std::filesystem;

/// 100 discs at rest under 1 MPa, taken for a specimen that was just made: without bonds, not sheared.
inline Specimen resting() {
  Specimen s = read_specimen(fs::path(CLATHRA_GOLDEN) / "specimen.h5");
  s.axial_strain = 0;
  s.critical_thickness = 0;
  s.separate_bonds = false;
  s.contacts.clear();
  return s;
}

inline std::size_t place(Specimen const& s, int id) {
  return static_cast<std::size_t>(std::find(s.id.begin(), s.id.end(), id) - s.id.begin());
}

inline double area_of(Specimen const& s) {
  double area = 0;
  for (double const r : s.radius) area += std::numbers::pi * r * r;
  return area;
}

inline void scale_lengths(Specimen& s, double factor) {
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
  /// Changes a text that the file or one of its columns ("/" for none) states.
  void restate(std::string const& object, char const* attribute, std::string const& text) {
    hid_t const opened = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), at = H5Oopen(opened, object.c_str(), H5P_DEFAULT);
    hid_t const type = H5Tcopy(H5T_C_S1), one = H5Screate(H5S_SCALAR);
    H5Tset_size(type, text.size());
    EXPECT_GE(H5Adelete(at, attribute), 0);
    hid_t const made = H5Acreate2(at, attribute, type, one, H5P_DEFAULT, H5P_DEFAULT);
    EXPECT_GE(H5Awrite(made, type, text.c_str()), 0);
    H5Aclose(made), H5Tclose(type), H5Sclose(one), H5Oclose(at), H5Fclose(opened);
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
    scene.grains.normal_stiffness = kn;
    CheckedSpecimen const read = read_checked_specimen(file);
    std::string text;
    for (std::string const& warning : oddities(file, read.specimen, read.facts)) text += warning + "\n";
    for (std::string const& warning : stress_oddities(file, read.specimen, read.facts, scene.grains.normal_stiffness))
      text += warning + "\n";
    return text;
  }
  CommandResult by_scene(std::string const& verb, std::string const& more = "") {
    std::ofstream(folder / "a.toml") << "[specimen]\nfile = \"specimen.h5\"\n[hydrate]\nsaturation = 0\n";
    return run_clathra(verb + " '" + (folder / "a.toml").string() + "' " + more);
  }

  fs::path const folder = fs::temp_directory_path() / ("clathra_specimen_check_" + std::to_string(::getpid()));
  fs::path const file = folder / "specimen.h5";
};

/// Ten discs of 0.8 mm and, of half of the sand, as many of 0.2 mm as that is.
inline std::function<void(Specimen&)> two_sizes(double d50) {
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

}  // namespace clathra
