/// What the rows keep beside the history, against doing without it.
#include "kernels/spatial_order.hpp"
#include "on_host.hpp"
#include "scenes.hpp"

namespace clathra {
namespace {

/// A bonded packing that walls crush: contacts close and open, bonds break.
Simulation crushed_packing(ContactCoupling coupling) {
  Scene const scene = hydrate_scene(0.55, coupling);
  Specimen s = disordered_patch(10, 10, 0.03);
  bond_all(s, scene);
  Simulation sim(s, bonded_laws(scene, s.critical_thickness), 0.05 * grain_d50);
  sim.time_step = 0.5 * sim.assembly().stable_time_step();
  sim.loading().x = AxisDrive::at_rate(-200);
  sim.loading().y = AxisDrive::at_rate(500);
  return sim;
}

TEST(ContactRows, EntriesKnownToCarryNothingMayBeLeftOut) {
  for (ContactCoupling const coupling : {ContactCoupling::replaces, ContactCoupling::parallel}) {
    Simulation quick = crushed_packing(coupling), thorough = crushed_packing(coupling);
    for (int n = 0; n < 4000; ++n) {
      quick.step();
      thorough.set_laws(thorough.assembly().laws);  // forgets what the last step found: every entry is evaluated
      thorough.step();
    }
    EXPECT_EQ(quick.assembly().hash(), thorough.assembly().hash());
    EXPECT_GT(quick.assembly().broken_bonds(), 10);
    EXPECT_GT(quick.assembly().upkeep.searches(), 3);
  }
}

TEST(ContactRows, FallInWorkWithinAWindowSoThatSlicesAreEven) {
  Scene const scene = hydrate_scene(0.55, ContactCoupling::parallel);
  Specimen s = disordered_patch(20, 20, 0.03);
  bond_all(s, scene);
  s.contacts.resize(2 * s.contacts.size() / 3);  // some discs carry less than others
  Simulation sim(s, bonded_laws(scene, s.critical_thickness), 0.05 * grain_d50);
  sim.request_search();
  (void)sim.state();  // searches, and evaluates nothing behind that
  HostRows const rows(sim.assembly().rows);
  auto const carrying = [&](int i) {
    int count = 0;
    for (int k = 0; k < rows.length(i); ++k)
      count += rows.shear(rows.entry(i, k)) != 0 || is_bonded(rows.formation_overlap(rows.entry(i, k))) ? 1 : 0;
    return count;
  };
  int falls = 0;
  for (int i = 1; i < sim.assembly().particles.owned; ++i) {
    if (i % (slices_a_window * slice_width_of<Real>) == 0) continue;
    EXPECT_LE(carrying(i), carrying(i - 1)) << i;
    falls += carrying(i) < carrying(i - 1) ? 1 : 0;
  }
  EXPECT_GT(falls, 4);
}

/// The mean distance of two discs that are stored side by side [m].
double mean_distance_in_storage(Simulation const& sim) {
  HostDiscs const p(sim.assembly().particles);
  double sum = 0;
  for (int i = 1; i < p.owned; ++i) sum += std::hypot(p.x(i) - p.x(i - 1), p.y(i) - p.y(i - 1));
  return sum / (p.owned - 1);
}

// Discs that touch nothing are put in each other's places.
TEST(ContactRows, AreSortedInSpaceAgainWithinSixteenSearches) {
  Simulation sim(hexagonal_patch(30, 30, 3 * grain_radius), sand_laws(), 0.1 * grain_d50);
  sim.time_step = 1e-9;
  ParticleSoA const& p = sim.assembly().particles;
  double const sorted = mean_distance_in_storage(sim);
  std::vector<int> place;
  for (int i = 0; i < sim.assembly().discs(); ++i) place.push_back(i);
  shuffle(place, 1, 1);
  std::vector<double> xs, ys;
  for (int i = 0; i < sim.assembly().discs(); ++i) {
    xs.push_back(value(p.x, place[static_cast<std::size_t>(i)]));
    ys.push_back(value(p.y, place[static_cast<std::size_t>(i)]));
  }
  for (int i = 0; i < sim.assembly().discs(); ++i) {
    assign(p.x, i, xs[static_cast<std::size_t>(i)]);
    assign(p.y, i, ys[static_cast<std::size_t>(i)]);
  }
  auto const search = [&] {
    sim.request_search();
    sim.step();
  };
  search();
  EXPECT_GT(mean_distance_in_storage(sim), 3 * sorted);
  for (int n = 0; n < 15; ++n) search();
  EXPECT_LT(mean_distance_in_storage(sim), 1.2 * sorted);
}

/// A large disc in the middle of rings of small ones; it touches every second one of the first.
Specimen large_disc_among_small_ones() {
  Specimen s = open_space();
  add_disc(s, 0, 0, 8 * grain_radius);
  for (int ring = 0; ring < 3; ++ring) {
    double const distance = (8.99 + 2.02 * ring) * grain_radius;
    int const discs = static_cast<int>(2 * pi * distance / (2.03 * grain_radius));
    for (int n = 0; n < discs; ++n) {
      double const far = distance + (n % 2) * 0.03 * grain_radius, angle = 2 * pi * n / discs;
      add_disc(s, far * std::cos(angle), far * std::sin(angle));
    }
  }
  return s;
}

// Rows of any length, in order of ids: first those in touch.
TEST(ContactRows, HoldAllThatIsNearHoweverManyItIs) {
  Simulation const sim(large_disc_among_small_ones(), sand_laws(), 0.1 * grain_d50);
  HostDiscs const p(sim.assembly().particles);
  HostRows const rows(sim.assembly().rows);
  int longest = 0;
  for (int i = 0; i < sim.assembly().discs(); ++i) {
    std::vector<std::pair<bool, int>> expected, listed;
    for (int j = 0; j < sim.assembly().discs(); ++j) {
      double const gap = std::hypot(p.x(i) - p.x(j), p.y(i) - p.y(j)) - p.radius(i) - p.radius(j);
      if (j != i && gap < p.verlet_skin(i) + p.verlet_skin(j)) expected.push_back({gap >= 0, p.id(j)});
    }
    std::sort(expected.begin(), expected.end());
    for (int k = 0; k < rows.length(i); ++k) {
      int const j = rows.neighbour(rows.entry(i, k));
      listed.push_back({std::hypot(p.x(i) - p.x(j), p.y(i) - p.y(j)) - p.radius(i) - p.radius(j) >= 0, p.id(j)});
    }
    EXPECT_EQ(listed, expected) << "row of particle " << p.id(i);
    longest = std::max(longest, static_cast<int>(listed.size()));
  }
  EXPECT_GT(longest, 20);
}

TEST(ContactRows, KeepTheWidthThatTheLawGivesABond) {
  Simulation sim = crushed_packing(ContactCoupling::parallel);
  sim.step(200);
  HostDiscs const p(sim.assembly().particles);
  HostRows const rows(sim.assembly().rows);
  int bonds = 0;
  for (int i = 0; i < sim.assembly().discs(); ++i) {
    for (int k = 0; k < rows.length(i); ++k) {
      std::size_t const e = rows.entry(i, k);
      if (!is_bonded(rows.formation_overlap(e))) continue;
      ++bonds;
      Real const common = common_radius(p.radius(i), p.radius(rows.neighbour(e)));
      EXPECT_EQ(rows.width(e), sim.assembly().laws.contact.bond.width_formed_at(common, Real(rows.formation_overlap(e))));
      EXPECT_GT(rows.width(e), 0);
    }
  }
  EXPECT_GT(bonds, 50);
}

}  // namespace
}  // namespace clathra
