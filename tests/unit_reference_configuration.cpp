/// What histories of mixed precision are made of: references, the motion since them, and forces that follow from it
/// (kernels/reference_configuration.hpp).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kernels/reference_configuration.hpp"
#include "scenes.hpp"

namespace clathra {
namespace {

constexpr double r1 = 1.1e-4, r2 = 0.7e-4, overlap = 5e-7, touch = r1 + r2 - overlap;
double tick() { return DiscMirror::tick_for(2 * r1); }

/// Where disc 2 is seen from disc 1, and how far both have turned.
struct Posture {
  double x, y, turn1 = 0, turn2 = 0;
};
struct InTicks {
  std::int32_t x, y;
  float dx, dy;
  explicit InTicks(Posture const& p)
      : x(DiscMirror::ticks(p.x, 1 / tick())), y(DiscMirror::ticks(p.y, 1 / tick())), dx(to_float(x)), dy(to_float(y)) {}
  InTicks from_the_other_side() const {
    InTicks back = *this;
    back.x = -x, back.y = -y, back.dx = -dx, back.dy = -dy;
    return back;
  }
  std::int32_t packed() const { return packed_branch(dx, dy); }
};
BranchSinceReference<float> branch(std::int32_t reference, InTicks const& at) {
  return branch_since(reference, at.x, at.y, at.dx, at.dy, 1 / (at.dx * at.dx + at.dy * at.dy));
}
MotionSinceReference<float> way(std::int32_t reference, Posture const& p) {
  InTicks const at(p);
  auto const distance = static_cast<float>(std::hypot(p.x, p.y)), u = static_cast<float>(r1 + r2) - distance;
  return motion_since(branch(reference, at), static_cast<float>(r1) - u / 2, static_cast<float>(r2) - u / 2,
                      static_cast<float>(p.turn1), static_cast<float>(p.turn2));
}
/// The slip between two postures, from the reference of the first.
double slip_between(Posture const& from, Posture const& to) {
  std::int32_t const reference = InTicks(from).packed();
  return static_cast<double>(way(reference, to).slip) - static_cast<double>(way(reference, from).slip);
}

/// The overlap by the reference, and what it is short of the exact one of the same ticks [ticks].
float overlap_by(std::int32_t reference, InTicks const& at) {
  float const distance2 = at.dx * at.dx + at.dy * at.dy;
  return overlap_since(reference, branch(reference, at), std::sqrt(distance2), 1 / distance2,
                       static_cast<float>(r1) + static_cast<float>(r2), static_cast<float>(tick()), /*none=*/false);
}
double missing(std::int32_t reference, Posture const& p) {
  InTicks const at(p);
  double const exact = static_cast<double>(static_cast<float>(r1) + static_cast<float>(r2)) / tick() -
                       std::hypot(static_cast<double>(at.x), static_cast<double>(at.y));
  return exact - static_cast<double>(overlap_by(reference, at)) / tick();
}

TEST(ReferenceBranch, IsOddAndWithinHalfAUnitOfTheBranch) {
  for (double angle = 0; angle < 6.2832; angle += 0.037) {
    InTicks const there({touch * std::cos(angle), touch * std::sin(angle)}),
        back({-touch * std::cos(angle), -touch * std::sin(angle)});
    EXPECT_LE(std::abs(difference(there.x, unpacked_x(there.packed()))), 1 << 15);
    EXPECT_LE(std::abs(difference(there.y, unpacked_y(there.packed()))), 1 << 15);
    EXPECT_EQ(unpacked_x(back.packed()), -unpacked_x(there.packed()));
    EXPECT_EQ(unpacked_y(back.packed()), -unpacked_y(there.packed()));
  }
}

TEST(MotionSinceReference, OfARigidTurnIsNothing) {
  for (double const alpha : {1e-5, 1e-3, -7e-3, 1.0 / 64}) {
    for (double const angle : {0.0, 0.7, 2.2, 4.0}) {
      auto const at = [&](double turned) {
        return Posture{touch * std::cos(angle + turned), touch * std::sin(angle + turned), turned, turned};
      };
      EXPECT_NEAR(slip_between(at(0), at(alpha)), 0, 1.5 * tick()) << alpha << ", " << angle;
      EXPECT_EQ(way(InTicks(at(0)).packed(), at(alpha)).rotation, 0);
    }
  }
}

TEST(MotionSinceReference, IsTheArcOfTheBranchLessThoseOfTheDiscs) {
  double const a1 = r1 - overlap / 2, a2 = r2 - overlap / 2;
  for (double const alpha : {1e-4, -1.0 / 64}) {
    Posture const before{touch, 0, 0, 0}, round{touch * std::cos(alpha), touch * std::sin(alpha), 0, 0};
    EXPECT_NEAR(slip_between(before, round), touch * alpha, 1.5 * tick() + 1e-5 * std::abs(touch * alpha)) << alpha;
    EXPECT_NEAR(slip_between(before, {touch, 0, alpha, 0}), -a1 * alpha, 1e-4 * std::abs(a1 * alpha)) << alpha;
    EXPECT_NEAR(slip_between(before, {touch, 0, 0, alpha}), -a2 * alpha, 1e-4 * std::abs(a2 * alpha)) << alpha;
    EXPECT_NEAR(way(InTicks(before).packed(), {touch, 0, alpha, 3 * alpha}).rotation, 2 * alpha, 1e-9);
  }
}

/// While the distance changes along: d and the arms count with their means, so what is left is of third order.
TEST(MotionSinceReference, OfAStraightWayIsItsIntegralToThirdOrder) {
  auto const at = [](double t) { return Posture{touch + t * touch / 128, t * touch / 80, t / 150, -t / 90}; };
  auto const exact = [&](double end) {
    constexpr int steps = 4000;
    double sum = 0;
    for (int n = 0; n < steps; ++n) {
      Posture const a = at(end * n / steps), b = at(end * (n + 1) / steps), middle = at(end * (n + 0.5) / steps);
      double const d = std::hypot(middle.x, middle.y), u = r1 + r2 - d;
      sum += d * (std::atan2(b.y, b.x) - std::atan2(a.y, a.x)) - (r1 - u / 2) * (b.turn1 - a.turn1) -
             (r2 - u / 2) * (b.turn2 - a.turn2);
    }
    return sum;
  };
  double const whole = slip_between(at(0), at(1)) - exact(1), half = slip_between(at(0), at(0.5)) - exact(0.5);
  EXPECT_LT(std::abs(whole), 3e-4 * std::abs(exact(1)));
  EXPECT_LT(std::abs(half), 0.4 * std::abs(whole));  // of second order at most by what the reference is off
}

TEST(MotionSinceReference, IsTheSameFromBothSides) {
  for (int n = 0; n < 2000; ++n) {
    auto const draw = [&](std::uint64_t k) { return uniform_random(11, k, static_cast<std::uint64_t>(n)) - 0.5; };
    double const angle = 6.2832 * draw(1);
    InTicks const start({touch * std::cos(angle), touch * std::sin(angle)});
    InTicks const now({touch * (std::cos(angle) + 0.03 * draw(2)), touch * (std::sin(angle) + 0.03 * draw(3))});
    auto const turn1 = static_cast<float>(0.03 * draw(4)), turn2 = static_cast<float>(0.03 * draw(5));
    auto const a1 = static_cast<float>(r1), a2 = static_cast<float>(r2);
    InTicks const back = now.from_the_other_side();
    std::int32_t const back_reference = start.from_the_other_side().packed();
    auto const branch_here = branch(start.packed(), now), branch_there = branch(back_reference, back);
    auto const here = motion_since(branch_here, a1, a2, turn1, turn2), there = motion_since(branch_there, a2, a1, turn2, turn1);
    ASSERT_EQ(here.slip, there.slip) << n;
    ASSERT_EQ(here.rotation, -there.rotation) << n;
    ASSERT_EQ(branch_here.sine2, branch_there.sine2) << n;
    ASSERT_EQ(overlap_by(start.packed(), now), overlap_by(back_reference, back)) << n;
  }
}

TEST(OverlapSinceReference, IsOffByTheSameAmountWhereverDiscsGoFromThere) {
  for (double angle = 0.01; angle < 6.2832; angle += 0.37) {
    auto const at = [&](double along, double across) {
      double const d = touch + along;
      return Posture{d * std::cos(angle) - across * std::sin(angle), d * std::sin(angle) + across * std::cos(angle)};
    };
    std::int32_t const reference = InTicks(at(0, 0)).packed();
    double const off = missing(reference, at(0, 0));
    EXPECT_LE(std::abs(off), 16);
    for (double const way : {tick(), 1e-9, -1e-9, 1e-8, 1e-7}) {
      EXPECT_NEAR(missing(reference, at(way, 0)), off, 0.2) << angle << ", " << way;
      EXPECT_NEAR(missing(reference, at(0, way)), off, 0.2) << angle << ", " << way;
      EXPECT_NEAR(missing(reference, at(way, way)), off, 0.2) << angle << ", " << way;
    }
    for (double const across : {touch / 64, -touch / 64}) EXPECT_NEAR(missing(reference, at(1e-6, across)), off, 1) << angle;
  }
}

TEST(OverlapSinceReference, IsThatOfTheBranchHoweverFarItHasTurnedOrGrown) {
  std::int32_t const reference = InTicks({touch, 0}).packed();
  double const off = missing(reference, {touch, 0}), in_ticks = touch / tick();
  for (double const share : {1e-3, 1e-2, -1e-2, 0.1})
    for (double const alpha : {0.0, 1e-3, 1.0 / 64, -1.0 / 64}) {
      double const d = touch * (1 + share);
      EXPECT_NEAR(missing(reference, {d * std::cos(alpha), d * std::sin(alpha)}), off, 1 + 3e-7 * std::abs(share) * in_ticks)
          << share << ", " << alpha;
    }
}

/// Two discs in mixed precision that only move as they are driven.
Simulation driven_discs() {
  SimulationLaws laws = sand_laws();
  laws.precision = Precision::mixed;
  Simulation sim(two_discs(2e-6), laws, 1e-5);
  hold_all(sim);
  sim.time_step = 1e-7;
  return sim;
}

/// A sum of rounded parts would have walked away.
TEST(HistoryAtTheReference, IsTheSameToTheBitHoweverOftenDiscsTremble) {
  Simulation sim = driven_discs();
  drive(sim, 0, 0, 1e-3, 3);
  drive(sim, 1, 0, -2e-3, 7);
  sim.step(100);
  drive(sim, 0, 0, 0, 0);
  SpecimenContact const before = pair_history(sim);
  ASSERT_GT(std::abs(before.shear), 1);
  for (int n = 0; n < 20000; ++n) {
    double const speed = 1e-5 * uniform_random(3, 1, static_cast<std::uint64_t>(n)),
                 spin = 1e-2 * uniform_random(3, 2, static_cast<std::uint64_t>(n));
    for (double const way : {1.0, -1.0}) {
      drive(sim, 1, 0, way * speed, way * spin);
      sim.step();
    }
  }
  SpecimenContact const after = pair_history(sim);
  EXPECT_NEAR(after.shear, before.shear,
              sand_ks * 2 * sim.assembly().particles.mirror.tick);  // places are sums in double precision
  EXPECT_NEAR(after.moment, before.moment, 1e-6 * std::abs(before.moment));
}

/// The distance of discs in single precision would be rounded to some sixteen ticks.
TEST(HistoryAtTheReference, ForcesTellSingleTicksApart) {
  Simulation sim = driven_discs();
  double const tick = sim.assembly().particles.mirror.tick;
  sim.step();
  auto const force = [&] { return value(sim.assembly().particles.force_x, index_of(sim, 0)); };
  drive(sim, 1, 3 * tick / sim.time_step, 0, 0);
  double before = force();
  for (int n = 0; n < 50; ++n) {
    sim.step();
    double const now = force();
    EXPECT_NEAR(std::abs(now - before), sand_kn * 3 * tick, sand_kn * 1.01 * tick + 2e-7 * std::abs(now)) << n;
    before = now;
  }
}

/// A sum in single precision stands still at a thousandth of its ulp a step.
TEST(HistoryAtTheReference, FollowsHoweverSlowlyDiscsMove) {
  Simulation sim = driven_discs();
  double const tick = sim.assembly().particles.mirror.tick;
  drive(sim, 1, 0, 0.1 / sim.time_step * 1e-6, 0);
  sim.step();
  drive(sim, 1, 0, 0, 0);
  double const before = pair_history(sim).shear;
  ASSERT_GT(std::abs(before), 10);
  constexpr int steps = 100000;
  double const increment_of_step = 1e-3 * tick;
  ASSERT_LT(sand_ks * increment_of_step, 0.5 * before * 0x1p-24);
  drive(sim, 1, 0, increment_of_step / sim.time_step, 0);
  sim.step(steps);
  EXPECT_NEAR(pair_history(sim).shear - before, sand_ks * increment_of_step * steps, sand_ks * 1.5 * tick);
}

/// What slides keeps its force at the limit, and what then sticks starts from there.
TEST(HistoryAtTheReference, StartsFromTheLimitAfterSliding) {
  Simulation sim = driven_discs();
  double const limit = 0.5 * sand_kn * 2e-6;
  drive(sim, 1, 0, 1, 0);  // 0.1 um a step
  sim.step(100);
  EXPECT_NEAR(std::abs(pair_history(sim).shear) / limit, 1, 0.35);  // the discs have parted a little on the way
  SpecimenContact const slid = pair_history(sim);
  drive(sim, 1, 0, -1e-2, 0);
  sim.step(50);
  EXPECT_NEAR(pair_history(sim).shear - slid.shear, -sand_ks * 5e-8, 5e-3 * sand_ks * 5e-8);  // the branch has turned
}

/// As in a generation, which changes friction and shape every ten steps.
TEST(HistoryAtTheReference, ForcesStayWhereTheRollingStiffnessChanges) {
  Simulation sim = driven_discs();
  drive(sim, 1, 0, 1e-3, 2);
  sim.step(100);
  SpecimenContact const first = pair_history(sim);
  sim.step(10);
  SpecimenContact const before = pair_history(sim);
  SimulationLaws laws = sim.assembly().laws;
  laws.contact.grain.shape_factor *= 0.5;
  sim.set_laws(laws);
  SpecimenContact const kept = pair_history(sim);
  EXPECT_NEAR(kept.moment, before.moment, 1e-6 * std::abs(before.moment));
  EXPECT_EQ(kept.shear, before.shear);
  sim.step(10);
  EXPECT_NEAR((pair_history(sim).moment - kept.moment) / (before.moment - first.moment), 0.25, 1e-3);
  EXPECT_NEAR((pair_history(sim).shear - kept.shear) / (before.shear - first.shear), 1, 0.05);
}

/// A disc that turns for long begins to count anew, again and again, and its rotation is their sum.
TEST(HistoryAtTheReference, ADiscThatTurnsForLongKeepsItsRotation) {
  Simulation sim = driven_discs();
  drive(sim, 1, 0, 0, 1e4);  // 1 mrad a step
  sim.step(5000);
  Specimen const s = sim.specimen();
  std::size_t const one = s.id[0] == 1 ? 0 : 1;
  EXPECT_NEAR(s.angle[one], 5, 1e-6);
  EXPECT_EQ(s.angle[1 - one], 0);
  EXPECT_LE(std::abs(on_host(sim.assembly().particles.rotation_increment, 2)[0]) +
                std::abs(on_host(sim.assembly().particles.rotation_increment, 2)[1]),
            1.2 / 64);
  EXPECT_NEAR(std::abs(pair_history(sim).shear) / (0.5 * sand_kn * 2e-6), 1, 1e-4);  // it slides
}

}  // namespace
}  // namespace clathra
