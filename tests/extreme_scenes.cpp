/// Biaxial tests at the ends of what a scene may ask for, and a hair beyond.
#include <algorithm>
#include <cmath>
#include <functional>

#include "domain/biaxial/biaxial_test.hpp"
#include "domain/measurement/history_row.hpp"
#include "domain/scene/hydrate.hpp"
#include "domain/scene/phase_boundary.hpp"
#include "extreme_rows.hpp"
#include "packing.hpp"
#include "scenes.hpp"

namespace clathra {
namespace {

/// Sand at 1 MPa to 1 % axial strain.
Scene sand_scene() {
  Scene scene;
  scene.run.precision = tested_precision();
  scene.test.axial_strain = 0.01;
  scene.test.inertial_number = 2e-4;
  scene.test.max_platen_wave_stress = 0;  // as fast as a test here says
  scene.output.records = 20;
  scene.output.energy = true;
  return scene;
}
Scene bonded_scene(double saturation) {
  Scene scene = sand_scene();
  scene.hydrate.saturation = saturation;
  return scene;
}

struct Shear {
  double peak_ratio = 0;  ///< q / p
  double void_ratio = 0, residual = 0, held = 0, largest_error = 0;
  double bonds = 0, broken = 0;
};

Shear shear(Scene const& scene, Specimen const& specimen = packing()) {
  BiaxialTest test(scene, specimen, {});
  Shear s;
  int records = 0;
  HistoryRow row;
  while (!test.finished()) {
    if (!test.advance(1 << 20)) continue;
    row = test.record();
    s.peak_ratio = std::max(s.peak_ratio, row.q_Pa / row.p_Pa);
    double const error = std::abs(row.sigma3_Pa / scene.test.confining_stress - 1);
    s.held += error < 0.01 ? 1 : 0;
    s.largest_error = std::max(s.largest_error, error);
    ++records;
  }
  EnergyRow const energy = test.energy();
  s.residual = std::abs(energy.residual) / std::abs(energy.boundary_work);
  s.held *= 100.0 / records;
  s.void_ratio = row.void_ratio;
  s.bonds = static_cast<double>(row.bonds_intact);
  s.broken = static_cast<double>(row.broken.total());
  return s;
}

/// Every test must hold its stress and keep its books, whatever the grains are.
Shear expect_sound(std::string const& what, Scene const& scene) {
  Shear const s = shear(scene);
  // Where nothing slides or turns for good the error of the step itself shows: 0.0002 to 0.010 at eight steps without friction.
  expect_row(what, "energy residual over boundary work", s.residual, 0, 1.5e-2);
  expect_row(what, "records with sigma_3 within 1 % [%]", s.held, 90, 100);
  return s;
}

TEST(ExtremeScenes, WithoutFrictionAndWithTooMuch) {
  Scene scene = sand_scene();
  double const usual = shear(scene).peak_ratio;
  scene.grains.friction = 0;
  expect_row("friction 0", "peak q/p", expect_sound("friction 0", scene).peak_ratio, 0, usual);
  scene.grains.friction = 10;
  expect_row("friction 10, where sliding vibrates faster than sticking", "peak q/p",
             expect_sound("friction 10", scene).peak_ratio, usual, 2);
}

TEST(ExtremeScenes, WithoutShearStiffnessAndWithAsMuchAsNormal) {
  Scene scene = sand_scene();
  scene.grains.shear_stiffness = 0;
  expect_row("k_s = 0", "peak q/p", expect_sound("k_s = 0", scene).peak_ratio, 0, 1);
  scene.grains.shear_stiffness = scene.grains.normal_stiffness;
  expect_row("k_s = k_n", "peak q/p", expect_sound("k_s = k_n", scene).peak_ratio, 0.3, 1.5);
}

TEST(ExtremeScenes, WithoutRollingResistanceAndWithTooMuch) {
  Scene scene = sand_scene();
  scene.grains.rolling_width_factor = 0;
  double const round = expect_sound("shape factor 0", scene).peak_ratio;
  // Of so few discs by chance: 0.09 to 0.33 were seen, with other specimens.
  expect_row("shape factor 0", "peak q/p", round, 0.05, 1);
  scene.grains.rolling_width_factor = 10;
  expect_row("shape factor 10", "peak q/p", expect_sound("shape factor 10", scene).peak_ratio, round, 2);
}

TEST(ExtremeScenes, FromOneKilopascalToAHundredMegapascals) {
  Scene scene = sand_scene();
  scene.specimen.particles = 100;
  scene.specimen.void_ratio = 0.3;  // looser than 0.32 such a specimen is made or refused by chance
  scene.specimen.compaction_layers = 1;
  scene.specimen.preparation_stress = scene.test.confining_stress = 1e3;
  if (tested_precision() == Precision::mixed) {
    expect_refusal<Refused>("sigma_3 = 1 kPa in mixed precision, k_n/p = 3e5", "does not resolve",
                            [&] { shear(scene, generate_specimen(scene, {}).specimen); });
    scene.specimen.preparation_stress = scene.test.confining_stress = 30e3;
  }
  Shear const soft = shear(scene, generate_specimen(scene, {}).specimen);
  std::string const least = "sigma_3 = " + short_text(scene.test.confining_stress / 1e3) + " kPa";
  expect_row(least, "energy residual over boundary work", soft.residual, 0, 2e-3);
  expect_row(least, "peak q/p", soft.peak_ratio, 0.3, 1.5);
  scene = sand_scene();
  scene.test.confining_stress = 1e7;
  expect_row("sigma_3 = 10 MPa, k_n/p = 30", "peak q/p", expect_sound("sigma_3 = 10 MPa", scene).peak_ratio, 0.05, 1.5);
  scene.test.confining_stress = 1e8;
  expect_refusal<Refused>("sigma_3 = 100 MPa, k_n/p = 3", "kn / sigma_1", [&] { shear(scene); });
}

// Nothing but k_n/p and I counts: the same digits until round-off has grown.
TEST(ExtremeScenes, AThousandTimesSofterAndStifferUnderStressesToMatch) {
  double ratios[3];
  int n = 0;
  for (double const factor : {1.0, 1e-3, 1e3}) {
    Scene scene = sand_scene();
    scene.test.axial_strain = 1e-4;
    scene.test.inertial_number = 1e-3;
    for (double* stress : {&scene.grains.normal_stiffness, &scene.grains.shear_stiffness, &scene.test.confining_stress,
                           &scene.specimen.preparation_stress})
      *stress *= factor;
    scene.specimen.particles = 100;
    scene.specimen.void_ratio = 0.3;  // looser than 0.32 such a specimen is made or refused by chance
    scene.specimen.compaction_layers = 1;
    ratios[n++] = shear(scene, generate_specimen(scene, {}).specimen).void_ratio;
  }
  expect_row("k_n and stresses 1,000 times less", "void ratio over the usual", ratios[1] / ratios[0], 0.98, 1.02);
  expect_row("k_n and stresses 1,000 times more", "void ratio over the usual", ratios[2] / ratios[0], 0.98, 1.02);
}

TEST(ExtremeScenes, SaturationsAtTheEdgesOfEquation3) {
  for (double const saturation : {0.2 + 1e-9, 0.7 + 1e-9, 1.0}) {
    std::string const what = "saturation " + short_text(saturation * 100) + (saturation < 1 ? " % and a hair" : " %");
    expect_row(what, "bonds", expect_sound(what, bonded_scene(saturation)).bonds, 1, 1e99);
  }
}

TEST(ExtremeScenes, HydrateAtItsStabilityLineAndAHairPast) {
  HydrateScene hydrate;
  hydrate.saturation = 0.55;
  hydrate.temperature = equilibrium_temperature(hydrate.pore_pressure, hydrate.salinity);
  EXPECT_EQ(stability_problem(hydrate), "");
  print_row("temperature at the stability line", "goes on", "goes on");
  hydrate.temperature = std::nextafter(hydrate.temperature, 100);
  expect_refusal<std::runtime_error>("temperature a hair past it", "stable", [&] {
    if (std::string const problem = stability_problem(hydrate); !problem.empty()) throw std::runtime_error(problem);
  });
  hydrate.temperature = equilibrium_temperature(hydrate.pore_pressure, hydrate.salinity);
  hydrate.pore_pressure *= 1 - 1e-7;
  expect_refusal<std::runtime_error>("pore pressure a hair below it", "stable", [&] {
    if (std::string const problem = stability_problem(hydrate); !problem.empty()) throw std::runtime_error(problem);
  });
}

TEST(ExtremeScenes, FiftyPercentStrain) {
  Scene scene = bonded_scene(0.55);
  scene.test.axial_strain = 0.5;
  scene.test.inertial_number = 1e-3;
  scene.run.ignore_guards = true;
  Shear const s = shear(scene);
  expect_row("50 % axial strain, 55 % hydrate", "energy residual over boundary work", s.residual, 0, 2e-3);
  expect_row("50 % axial strain, 55 % hydrate", "bonds broken", s.broken, 100, 1e99);
}

// The side walls must give way as fast as a brittle specimen widens that fails.
TEST(ExtremeScenes, BrittleFailureKeepsTheConfiningStress) {
  Scene scene = bonded_scene(0.55);
  scene.test.axial_strain = 0.06;
  scene.test.inertial_number = 1e-4;
  scene.output.records = 300;
  Shear const s = shear(scene);
  expect_row("brittle failure", "records with sigma_3 within 1 % [%]", s.held, 98.5, 100);
  expect_row("brittle failure", "largest error of sigma_3 [%]", s.largest_error * 100, 0, 15);
  expect_row("brittle failure", "bonds broken", s.broken, 100, 1e99);
}

TEST(ExtremeScenes, ScaledMassesThatMoveTooFastEndTheTest) {
  Scene scene = sand_scene();
  scene.run.rotational_inertia_factor = 3;
  scene.run.mass_scaled_fraction = 0.1;
  expect_row("inertias times 3, the smallest 10 % heavier", "energy residual over boundary work", shear(scene).residual, 0, 2e-3);
  scene.test.inertial_number = 5e-3;
  scene.test.axial_strain = 0.05;
  expect_refusal<Refused>("the same at I = 5e-3", "kinetic energy of the scaled masses", [&] { shear(scene); });
}

}  // namespace
}  // namespace clathra
