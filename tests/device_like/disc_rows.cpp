/// What the contact kernel reads of neighbours on a GPU is what the fields hold.
#include "golden_states.hpp"

namespace clathra {
namespace {

/// Compares all discs, ghosts and a padding disc with their rows.
void expect_rows_as_fields(ParticleSoA const& p, char const* after) {
  auto const size = static_cast<std::size_t>(p.all()) + 1;
  auto const rows = on_host(p.disc_rows.rows, size);
  auto const x = on_host(p.x, size), y = on_host(p.y, size), radius = on_host(p.radius, size);
  auto const vx = on_host(p.vx, size), vy = on_host(p.vy, size), omega = on_host(p.omega, size);
  for (std::size_t i = 0; i < size; ++i) {
    DiscRow const& row = rows[i];
    bool const same =
        row.x == x[i] && row.y == y[i] && row.radius == radius[i] && row.vx == vx[i] && row.vy == vy[i] && row.omega == omega[i];
    ASSERT_TRUE(same) << "particle " << i << " of " << p.all() << " after " << after;
  }
}

TEST(DiscRows, AreWhatTheFieldsHoldAfterWhateverChangesThem) {
  Specimen const s = bonded_patch(ContactCoupling::parallel);
  Simulation sim = ready(s, ContactCoupling::parallel);
  sim.step(1);
  expect_rows_as_fields(sim.assembly().particles, "a step");
  std::int64_t const searches = sim.assembly().upkeep.searches();
  sim.step(600);
  ASSERT_GT(sim.assembly().upkeep.searches(), searches);
  expect_rows_as_fields(sim.assembly().particles, "a search");
  sim.add_uniform_strain_rate(3, -4);
  expect_rows_as_fields(sim.assembly().particles, "a strain rate");
  sim.strain(1e-4, -2e-4);
  expect_rows_as_fields(sim.assembly().particles, "a strain");
  sim.stop_discs();
  expect_rows_as_fields(sim.assembly().particles, "a stop");
}

TEST(DiscRows, AreWhatTheFieldsHoldOfTheImagesOfAPeriodicCell) {
  Specimen s = disordered_patch(12, 12, 0.1);
  s.periodic = true;
  Simulation sim(s, sand_laws(), 0.05 * grain_d50);
  sim.time_step = 1e-7;
  for (int n = 0; n < 3; ++n) {
    sim.strain(3e-3, 2e-3);
    expect_rows_as_fields(sim.assembly().particles, "a strain");
    sim.step(100);
    ASSERT_GT(sim.assembly().particles.ghosts, 0);
    expect_rows_as_fields(sim.assembly().particles, "steps");
  }
}

}  // namespace
}  // namespace clathra
