/// What the rows keep beside the history, against doing without it.
#include "kernels/spatial_order.hpp"
#include "scenes.hpp"

namespace clathra {
namespace {

/// A bonded packing that walls crush: contacts close and open, bonds break.
Simulation crushed_packing(Composite composite) {
  Scene const scene = hydrate_scene(0.55, composite);
  Specimen s = disordered_patch(10, 10, 0.03);
  bond_all(s, scene);
  Simulation sim(s, bonded_laws(scene, s.critical_thickness), 0.05 * grain_d50);
  sim.time_step = 0.5 * sim.stable_time_step();
  sim.loading.x = AxisDrive::at_rate(-200);
  sim.loading.y = AxisDrive::at_rate(500);
  return sim;
}

TEST(ContactRows, EntriesKnownToCarryNothingMayBeLeftOut) {
  for (Composite const composite : {Composite::replace, Composite::parallel}) {
    Simulation quick = crushed_packing(composite), thorough = crushed_packing(composite);
    for (int n = 0; n < 4000; ++n) {
      quick.step();
      thorough.set_laws(thorough.laws());  // forgets what the last step found: every entry is evaluated
      thorough.step();
    }
    EXPECT_EQ(quick.hash(), thorough.hash());
    EXPECT_GT(quick.broken_bonds(), 10);
    EXPECT_GT(quick.rebuilds(), 3);
  }
}

TEST(ContactRows, FallInWorkWithinAWindowSoThatSlicesAreEven) {
  Scene const scene = hydrate_scene(0.55, Composite::parallel);
  Specimen s = disordered_patch(20, 20, 0.03);
  bond_all(s, scene);
  s.contacts.resize(2 * s.contacts.size() / 3);  // some discs carry less than others
  Simulation sim(s, bonded_laws(scene, s.critical_thickness), 0.05 * grain_d50);
  sim.request_rebuild();
  (void)sim.state();  // searches, and evaluates nothing behind that
  ContactRows const& rows = sim.rows();
  auto const carrying = [&](int i) {
    int count = 0;
    for (int k = 0; k < rows.length(i); ++k)
      count += rows.shear(rows.entry(i, k)) != 0 || is_bonded(rows.equilibrium(rows.entry(i, k))) ? 1 : 0;
    return count;
  };
  int falls = 0;
  for (int i = 1; i < sim.particles().owned; ++i) {
    if (i % sorting_window == 0) continue;
    EXPECT_LE(carrying(i), carrying(i - 1)) << i;
    falls += carrying(i) < carrying(i - 1) ? 1 : 0;
  }
  EXPECT_GT(falls, 4);
}

TEST(ContactRows, KeepTheWidthThatTheLawGivesABond) {
  Simulation sim = crushed_packing(Composite::parallel);
  for (int n = 0; n < 200; ++n) sim.step();
  ParticleSoA const& p = sim.particles();
  ContactRows const& rows = sim.rows();
  int bonds = 0;
  for (int i = 0; i < sim.discs(); ++i) {
    for (int k = 0; k < rows.length(i); ++k) {
      std::size_t const e = rows.entry(i, k);
      if (!is_bonded(rows.equilibrium(e))) continue;
      ++bonds;
      Real const common = common_radius(p.radius(i), p.radius(rows.neighbour(e)));
      EXPECT_EQ(rows.width(e), sim.laws().contact.bond.width_formed_at(common, Real(rows.equilibrium(e))));
      EXPECT_GT(rows.width(e), 0);
    }
  }
  EXPECT_GT(bonds, 50);
}

}  // namespace
}  // namespace clathra
