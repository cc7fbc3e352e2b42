/// How fast hydrate goes beyond the boundary of stability, and where a stage has come to.
#include <gtest/gtest.h>

#include <utility>

#include "domain/scene/dissociation.hpp"
#include "domain/scene/hydrate_loss.hpp"
#include "domain/scene/phase_boundary.hpp"
#include "kernels/bond_law.hpp"

namespace clathra {
namespace {

constexpr double median = 0.1694e-3, hour = 3600;

Scene fresh_water() {
  Scene scene;
  scene.hydrate.saturation = 0.55;
  scene.hydrate.salinity = 0;
  return scene;
}

double formed_thickness(Scene const& scene) { return critical_thickness_ratio(scene.hydrate.saturation) * median; }

/// At 3 MPa and 5 degC in fresh water, 1.27 MPa below the boundary.
HydratePath below_the_boundary(Scene const& scene, double hours, Dissociation by = Dissociation::clarke_2001) {
  HydrateChange change;
  change.dissociation = by;
  change.duration = hours * hour;
  return {scene, median, formed_thickness(scene), change, {5, 3e6, scene.hydrate.saturation}};
}

/// k_0 exp(-E_a / R T) (p_eq - p) M / rho by hand: 2.215e-11, 2.451e-10 and 1.765e-14 mol/(m^2 Pa s) at 278.15 K.
TEST(DissociationRate, IsThatOfItsSource) {
  HydrateScene hydrate;
  for (auto const& [by, moles] : {std::pair{Dissociation::clarke_2001, 2.215e-11}, std::pair{Dissociation::kim_1987, 2.451e-10},
                                  std::pair{Dissociation::slow, 1.765e-14}}) {
    double const below = equilibrium_pressure(5, 35) - 1e6, speed = moles * 1e6 * 0.12413 / 900;
    EXPECT_NEAR(recession_speed(by, hydrate, 5, below), speed, 2e-3 * speed);
    EXPECT_EQ(recession_speed(by, hydrate, 5, below + 1e6), 0);
    EXPECT_EQ(recession_speed(by, hydrate, 5, 8e6), 0) << "hydrate is stable";
  }
  EXPECT_NEAR(recession_speed(Dissociation::clarke_2001, hydrate, 5, equilibrium_pressure(5, 35) - 1e6), 3.05e-9, 0.02e-9);
}

TEST(DissociationRate, TakesTheBondOfTouchingGrainsIn2AndAHalfHoursAt3MPa) {
  Scene const scene = fresh_water();
  double const width = bond_width(0.5 * median, formed_thickness(scene)),
               speed = recession_speed(Dissociation::clarke_2001, scene.hydrate, 5, 3e6), lasts = width / (2 * speed) / hour;
  EXPECT_NEAR(width, 69.5e-6, 0.1e-6);
  EXPECT_NEAR(lasts, 2.48, 0.01);
  EXPECT_GT(below_the_boundary(scene, 0.999 * lasts).at(1).saturation, 0.2);
  EXPECT_EQ(below_the_boundary(scene, 1.001 * lasts).at(1).saturation, 0.2);
}

/// At constant temperature and pressure the bond of reference gets narrower linearly in time.
TEST(HydratePath, ByARateNarrowsTheReferenceBondByTwiceTheSpeed) {
  Scene const scene = fresh_water();
  HydratePath const path = below_the_boundary(scene, 2);
  double const formed = formed_thickness(scene), first = bond_width(0.5 * median, formed),
               speed = recession_speed(Dissociation::clarke_2001, scene.hydrate, 5, 3e6);
  EXPECT_EQ(path.at(0).saturation, 0.55);
  for (double const part : {0.0001, 0.25, 0.5003, 0.75, 1.0}) {
    HydrateState const state = path.at(part);
    double const width = first - 2 * speed * part * 2 * hour;
    EXPECT_NEAR(reference_width(scene, median, formed, state.saturation), width, 1e-12 * first) << part;
    if (state.saturation < 0.22) continue;  // where the jump of Eq. 3 is spread
    HydrateScene now = scene.hydrate;
    now.saturation = state.saturation;
    Scene receding = scene;
    receding.hydrate.loss = HydrateLoss::recession;
    BondLaw const law = changed_bond_law(receding, median, make_bond_law(receding, median, formed), now);
    EXPECT_NEAR(law.width_lost, first - width, 1e-12 * first) << "each bond, B = B_0 - 2 v t";
    EXPECT_EQ(law.width_share, 1);
  }
}

TEST(HydratePath, KnowsTheSaturationOfAWidth) {
  Scene const scene = fresh_water();
  double const formed = formed_thickness(scene);
  for (double const saturation : {0.2, 0.2001, 0.21, 0.22, 0.221, 0.3, 0.41, 0.55})
    EXPECT_NEAR(saturation_of_width(scene, median, formed, reference_width(scene, median, formed, saturation)), saturation,
                1e-13);
  EXPECT_EQ(saturation_of_width(scene, median, formed, -1e-6), 0.2);
}

/// A pressure that falls across the boundary: v is linear in it at one temperature, its integral a parabola from there on.
TEST(HydratePath, ByARateIntegratesOverTheWay) {
  Scene const scene = fresh_water();
  HydratePath path = below_the_boundary(scene, 1);
  path.change.pore_pressure = 3e6;
  path.from.pore_pressure = 5e6;
  double const formed = formed_thickness(scene), first = bond_width(0.5 * median, formed),
               met = (5e6 - equilibrium_pressure(5, 0)) / 2e6,
               per_MPa = recession_speed(Dissociation::clarke_2001, scene.hydrate, 5, 3e6) / (equilibrium_pressure(5, 0) - 3e6);
  EXPECT_EQ(path.at(0.9 * met).saturation, 0.55) << "stable until then";
  double last = 0.55;
  for (int n = 0; n <= 50; ++n) {
    double const part = n / 50.0, beyond = std::max(0.0, part - met), lost = hour * per_MPa * 2e6 * beyond * beyond;
    HydrateState const state = path.at(part);
    EXPECT_NEAR(reference_width(scene, median, formed, state.saturation), first - lost, 2e-6 * first) << part;
    EXPECT_LE(state.saturation, last) << "never back";
    EXPECT_NEAR(state.pore_pressure, 5e6 - part * 2e6, 1e-3);
    last = state.saturation;
  }
}

/// Temperature and pressure wait at the boundary while the hydrate goes.
TEST(HydratePath, AtOnceLosesItsHydrateOnTheBoundary) {
  Scene const scene = fresh_water();
  HydratePath path = below_the_boundary(scene, 0, Dissociation::instant);
  path.from = {5, 8e6, 0.55};
  path.change.temperature = 15;
  double const met = (equilibrium_temperature(8e6, 0) - 5) / 10;
  EXPECT_EQ(path.at(0), path.from);
  EXPECT_EQ(path.at(0.49 * met).saturation, 0.55);
  EXPECT_NEAR(path.at(0.5 * met + 0.25).saturation, 0.375, 1e-9);
  EXPECT_NEAR(path.at(0.5 * met + 0.25).temperature, equilibrium_temperature(8e6, 0), 1e-6);
  EXPECT_NEAR(path.at(0.5 * met + 0.499999).temperature, equilibrium_temperature(8e6, 0), 1e-6);
  EXPECT_EQ(path.at(0.5 * met + 0.501).saturation, 0.2);
  EXPECT_EQ(path.at(1).temperature, 15);
  EXPECT_EQ(path.at(1).saturation, 0.2);
  path.change.temperature = 6;
  EXPECT_EQ(path.at(1).saturation, 0.55) << "stable all the way";
  EXPECT_EQ(path.at(1).temperature, 6);
  path.from = {12, 3e6, 0.3};
  path.change = HydrateChange();
  path.change.dissociation = Dissociation::instant;
  EXPECT_NEAR(path.at(0.25).saturation, 0.25, 1e-15) << "beyond it from the beginning";
}

}  // namespace
}  // namespace clathra
