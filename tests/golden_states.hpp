#pragma once
/// A small bonded packing sheared through breakage, and the state that it must have afterwards.
#include "scenes.hpp"

namespace clathra {

inline Specimen bonded_patch(ContactCoupling coupling) {
  Specimen s = disordered_patch(20, 20);
  for (std::size_t i = 0; i < s.size(); ++i) {  // many contacts are loaded when the bonds form
    s.x[i] *= 0.98;
    s.y[i] *= 0.98;
  }
  enclose(s);
  bond_all(s, hydrate_scene(0.41, coupling));
  return s;
}

/// The box alone: the share of a rank that has no disc.
inline Specimen without_discs(Specimen s) {
  for (auto* field : {&s.x, &s.y, &s.angle, &s.vx, &s.vy, &s.omega, &s.radius}) field->clear();
  s.id.clear();
  s.contacts.clear();
  return s;
}

/// About to be sheared through breakage.
/// @param share  this rank's part of the specimen, if there are ranks
inline Simulation ready(Specimen const& s, ContactCoupling coupling, Ranks const& ranks = {}, Specimen const* share = nullptr,
                        Precision precision = Precision::full) {
  SimulationLaws laws = bonded_laws(hydrate_scene(0.41, coupling), s.critical_thickness);
  laws.precision = precision;
  laws.motion.damping = 0.3;
  laws.wall.friction = 0.2;
  laws.contact.grain.damping_ratio = 0.02;
  Simulation sim(share ? *share : s, laws, 0.05 * grain_d50, ranks);
  sim.time_step = 1e-7;
  sim.loading().y = AxisDrive::at_rate(200);
  sim.loading().x = AxisDrive::at_rate(-60);
  return sim;
}
inline Simulation sheared(Specimen const& s, ContactCoupling coupling, Precision precision = Precision::full, int steps = 3000) {
  Simulation sim = ready(s, coupling, {}, nullptr, precision);
  for (int n = 0; n < steps; ++n) sim.step();
  return sim;
}

/// Every sum over discs, contacts and walls, to the bit.
inline void expect_equal_measures(Simulation const& one, Simulation const& many) {
  Measures const a = one.assembly().measures(), b = many.assembly().measures();
  EXPECT_EQ(a.kinetic, b.kinetic);
  EXPECT_EQ(a.grain_energy, b.grain_energy);
  EXPECT_EQ(a.bond_energy, b.bond_energy);
  EXPECT_EQ(a.wall_energy, b.wall_energy);
  EXPECT_EQ(a.stress_area_xy, b.stress_area_xy);
  EXPECT_EQ(a.stress_area_yy, b.stress_area_yy);
  EXPECT_EQ(a.interacting, b.interacting);
  EXPECT_EQ(one.assembly().stress().x, many.assembly().stress().x);
  EXPECT_EQ(one.assembly().stress().y, many.assembly().stress().y);
  EXPECT_EQ(one.assembly().boundary_work(), many.assembly().boundary_work());
  EXPECT_EQ(one.assembly().void_ratio(), many.assembly().void_ratio());
  EXPECT_EQ(one.assembly().losses().sliding, many.assembly().losses().sliding);
  EXPECT_EQ(one.assembly().losses().breakage, many.assembly().losses().breakage);
  EXPECT_EQ(one.assembly().losses().damping, many.assembly().losses().damping);
  EXPECT_EQ(one.assembly().stable_time_step(), many.assembly().stable_time_step());
  EXPECT_EQ(one.assembly().largest_frequency(), many.assembly().largest_frequency());
  EXPECT_EQ(one.assembly().upkeep.searches(), many.assembly().upkeep.searches());
  BreakCounts const p = one.assembly().break_counts(), q = many.assembly().break_counts();
  EXPECT_EQ(p, q);
}

struct Golden {
  ContactCoupling coupling;
  Precision precision;
  std::uint64_t hash;
  int broken;
};
inline constexpr Golden golden[] = {{ContactCoupling::replaces, Precision::full, 0xb32266e6acdafbebULL, 213},
                                    {ContactCoupling::parallel, Precision::full, 0xc2baf36149f36ff8ULL, 469},
                                    {ContactCoupling::replaces_keeping_force, Precision::full, 0x92e06ba7ed616b25ULL, 308},
                                    {ContactCoupling::replaces, Precision::mixed, 0xa311bc3931ab307bULL, 200},
                                    {ContactCoupling::parallel, Precision::mixed, 0x94108ce6e3b12124ULL, 452},
                                    {ContactCoupling::replaces_keeping_force, Precision::mixed, 0x11df95212d47d02cULL, 252}};

}  // namespace clathra
