/// The parts of mixed precision: ticks, the fields that keep its numbers, limits, and what the neighbour search allows for.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <numbers>
#include <string>

#include "kernels/bond_quick_test.hpp"
#include "scenes.hpp"

namespace clathra {
namespace {

TEST(Ticks, GiveDifferencesToTheTickAtAnyPlace) {
  double const tick = DiscMirror::tick_for(0.3e-3);
  EXPECT_LT(tick, 1e-12);
  EXPECT_GT(0.3e-3 / tick, std::ldexp(1, 28));
  for (double const origin : {0.0, -3.7e-3, 0.0312, 0.1234567, -10.0, 900.0}) {
    for (double const branch : {1e-9, 0.1694e-3, -0.1694e-3, 0.29e-3, -1.1e-3}) {
      for (int k = 0; k < 200; ++k) {
        double const here = origin + k * 1.37e-4, there = here + branch, exact = there - here;
        auto const a = static_cast<std::uint32_t>(DiscMirror::ticks(here, 1 / tick)),
                   b = static_cast<std::uint32_t>(DiscMirror::ticks(there, 1 / tick));
        EXPECT_NEAR(static_cast<std::int32_t>(b - a) * tick, exact, tick * (1 + 1e-9)) << origin << " + " << branch;
      }
    }
  }
}

/// Number by number in kernels, which alone reach a field.
struct WriteNumber {
  RealField field;
  int at;
  double number;
  KOKKOS_FUNCTION void operator()(int) const { field.set(at, number); }
};
void write(RealField const& field, int at, double number) {
  Kokkos::parallel_for("write_number", Kokkos::RangePolicy<ExecutionSpace>(0, 1), WriteNumber{field, at, number});
}
struct ReadNumber {
  RealField field;
  int at;
  Field<double> number;
  KOKKOS_FUNCTION void operator()(int) const { number(0) = field(at); }
};
double read(RealField const& field, int at) {
  Field<double> const number("number", 1);
  Kokkos::parallel_for("read_number", Kokkos::RangePolicy<ExecutionSpace>(0, 1), ReadNumber{field, at, number});
  return value(number, 0);
}

TEST(RealField, ReadsWhatWasWrittenToTheFormat) {
  RealField const whole("whole", 3), single("single", 3, {Storage::as_float}), integer("integer", 3, {Storage::as_int});
  for (RealField const& field : {whole, single}) write(field, 1, 0.123456789);
  EXPECT_EQ(read(whole, 1), 0.123456789);
  EXPECT_EQ(read(single, 1), static_cast<double>(0.123456789F));
  for (double const any : {-2147483648.0, 2147483647.0}) {
    write(integer, 1, any);
    EXPECT_EQ(read(integer, 1), any);
  }
  write(single, 2, no_bond);
  EXPECT_EQ(read(single, 2), no_bond);
  EXPECT_FALSE(is_bonded(static_cast<float>(value(single.as<float>(), 2))));
  EXPECT_TRUE(is_bonded(-5e-6F));
  EXPECT_EQ(single.bytes() + integer.bytes(), whole.bytes());
  Field<std::uint32_t> const table("table", 24);
  RealField const column = RealField::column(table, 8, 5);
  write(column, 2, 2.5);
  EXPECT_EQ(read(column, 2), 2.5);
  EXPECT_EQ(column.extent(0), 3u);
  EXPECT_EQ(value(table, 21), std::bit_cast<std::uint32_t>(2.5F));
  EXPECT_EQ(on_host(column, 3)[2], 2.5);
}

/// Two discs in mixed precision, with forces.
Simulation pair_at(Specimen const& s, double skin) {
  SimulationLaws laws = sand_laws();
  laws.precision = Precision::mixed;
  Simulation sim(s, laws, skin);
  sim.evaluate_forces();
  return sim;
}

/// Its ticks look like those of any place, and its velocity is one.
TEST(MixedPrecision, FindsADiscWhosePlaceIsNoNumber) {
  for (double const nowhere : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    Simulation sim = pair_at(two_discs(-1e-5), 1e-5);
    sim.time_step = 1e-7;
    assign(sim.assembly().particles.x, index_of(sim, 1), nowhere);
    std::string text = "none";
    try {
      sim.step(100);
    } catch (Diverged const& fault) {
      text = fault.what();
    }
    EXPECT_NE(text.find("particle 1 has a position or velocity that is not finite"), std::string::npos)
        << nowhere << ": " << text;
  }
}

/// Whatever the contact kernel takes for a touch is listed, at no skin to speak of.
TEST(RoundingSlack, ListsEveryPairThatTheKernelTakesForTouching) {
  double const radius = static_cast<double>(8.47e-5F) - 3.4e-12;  // a float is larger
  int apart_but_touching = 0;
  for (double const angle : {0.0, 0.3, 0.7853981633974483, 1.3, std::numbers::pi / 2}) {
    for (double const origin : {0.0, 0.0123456, 7.7}) {
      for (int k = -10; k <= 60; ++k) {
        double const distance = 2 * radius + 1e-12 * k;
        Specimen s = open_space();
        add_disc(s, origin, origin, radius);
        add_disc(s, origin + distance * std::cos(angle), origin + distance * std::sin(angle), radius);
        Disc const pushed = disc(pair_at(s, 1e-5), 0);  // listed in any case
        if (pushed.fx == 0 && pushed.fy == 0) continue;
        EXPECT_EQ(value(pair_at(s, 1e-15).assembly().rows.length, 0), 1) << angle << ", " << origin << ", " << k;
        apart_but_touching += std::hypot(s.x[1] - s.x[0], s.y[1] - s.y[0]) > 2 * radius + 1e-14 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(apart_but_touching, 20);  // rounding does bring some to touch
}

/// References are others then, forces the same but for their rounding.
TEST(MixedPrecision, SurvivesTheWayThroughASpecimen) {
  Specimen s = disordered_patch(10, 10);
  enclose(s);
  SimulationLaws laws = sand_laws();
  laws.precision = Precision::mixed;
  Simulation sim(s, laws, 0.05 * grain_d50);
  sim.time_step = 1e-7;
  sim.loading().x = sim.loading().y = AxisDrive::at_rate(300);
  sim.step(1500);
  ASSERT_GT(sim.assembly().measures().touching, 50);
  Specimen const before = sim.specimen(), after = Simulation(before, laws, 0.05 * grain_d50).specimen();
  EXPECT_EQ(after.x, before.x);
  EXPECT_EQ(after.vx, before.vx);
  EXPECT_EQ(after.angle, before.angle);
  ASSERT_EQ(after.contacts.size(), before.contacts.size());
  double most_shear = 0, most_moment = 0, change_of_shear = 0, change_of_moment = 0;
  for (std::size_t k = 0; k < before.contacts.size(); ++k) {
    SpecimenContact const &a = before.contacts[k], &b = after.contacts[k];
    most_shear = std::max(most_shear, std::abs(a.shear)), most_moment = std::max(most_moment, std::abs(a.moment));
    change_of_shear = std::max(change_of_shear, std::abs(b.shear - a.shear));
    change_of_moment = std::max(change_of_moment, std::abs(b.moment - a.moment));
  }
  EXPECT_LT(change_of_shear, 1e-6 * most_shear);
  EXPECT_LT(change_of_moment, 1e-6 * most_moment);
}

/// Ticks repeat themselves after four to eight diameters.
TEST(MixedPrecision, RefusesToSearchFurtherThanPlacesAreToldApart) {
  EXPECT_NO_THROW(pair_at(two_discs(-1e-5), 2 * grain_radius));
  try {
    pair_at(two_discs(-1e-5), 20 * grain_radius);
    FAIL() << "not refused";
  } catch (Refused const& refusal) {
    EXPECT_NE(std::string(refusal.what()).find("further than mixed precision tells places apart"), std::string::npos);
  }
}

/// The contact of two discs after a step, which begins with this shear force and moment, far beyond the limits or within.
SpecimenContact after_a_step(Specimen s, GrainLaw const& grain, Precision precision, double shear, double moment) {
  s.contacts.push_back({0, 1, shear, moment});
  SimulationLaws laws = sand_laws();
  laws.precision = precision;
  laws.contact.grain = grain;
  Simulation sim(s, laws, 0.1 * grain_radius);
  sim.time_step = 1e-12;
  sim.step();
  return sim.specimen().contacts.at(0);
}

/// Limits that a history cannot hold are those that it can; one does not move the other.
TEST(MixedPrecision, HasTheLimitsOfDoubleAtAnyFriction) {
  Specimen const s = two_discs(0.4 * grain_radius);
  double const most_shear = sand_kn * 2 * grain_radius, most_moment = most_shear * grain_radius;
  for (double const friction : {0.5, 1.0, 5.0, 1e9}) {
    GrainLaw const law{sand_kn, sand_ks, friction, 2, 0};
    SpecimenContact const exact = after_a_step(s, law, Precision::full, 0.9 * most_shear, 0.9 * most_moment),
                          mixed = after_a_step(s, law, Precision::mixed, 0.49 * most_shear, 0.3 * most_moment);
    EXPECT_NEAR(exact.moment, sand_kn * 0.4 * grain_radius * grain_radius / 3, 1e-3 * exact.moment);
    EXPECT_NEAR(mixed.moment, exact.moment, 1e-5 * exact.moment) << friction;
    EXPECT_NEAR(mixed.shear, std::min(exact.shear, 0.49 * most_shear), 1e-5 * exact.shear) << friction;
  }
}

TEST(MixedPrecision, KeepsAHistoryWhereADashpotPressesBeyondAllNumbers) {
  Specimen s = two_discs(1e-3 * grain_radius);
  s.vx[1] = -1e5;
  for (double const ratio : {0.1, 1.0}) {
    SpecimenContact const kept = after_a_step(s, {sand_kn, sand_ks, 1, 2, ratio}, Precision::mixed, 3, 1e-5);
    EXPECT_NEAR(kept.shear, 3, 1e-4) << ratio;
    EXPECT_NEAR(kept.moment, 1e-5, 1e-8) << ratio;
  }
}

TEST(LeastStrength, OfSinglePrecisionLiesBelowThatOfDoubleByLittle) {
  Scene const scene = hydrate_scene(0.55, ContactCoupling::parallel);
  BondLaw const law = make_bond_law(scene, grain_d50, h_max_of(scene));
  LeastStrengthOf<double> const exact = least_strength<double>(law);
  LeastStrengthOf<float> const single = least_strength<float>(law);
  auto const below = [](double a, double b) { return a < b && a > b - 5e-5 * std::abs(b); };
  // Strengths, which are these lines over their slopes.
  auto const line_below = [&](OfWidth<float> const& a, double per_a, OfWidth<double> const& b, double per_b) {
    return below(a.at_zero / per_a, b.at_zero / per_b) && below(a.per_width / per_a, b.per_width / per_b);
  };
  EXPECT_TRUE(line_below(single.rising, single.rising_per_normal, exact.rising, exact.rising_per_normal));
  EXPECT_TRUE(line_below(single.flat, single.shear_slope, exact.flat, exact.shear_slope));
  EXPECT_TRUE(line_below(single.falling, single.falling_per_normal, exact.falling, exact.falling_per_normal));
  EXPECT_TRUE(below(single.rising_per_normal, exact.rising_per_normal));
  EXPECT_TRUE(below(single.falling_per_normal, exact.falling_per_normal));
  EXPECT_TRUE(below(single.shear_slope, exact.shear_slope));
  EXPECT_TRUE(below(single.moment.per_width, exact.moment.per_width));
}

}  // namespace
}  // namespace clathra
