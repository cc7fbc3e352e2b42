/// A specimen in memory that is 2^n times as large under the same stresses has the same digits in everything.
#include "extreme_rows.hpp"
#include "scenes.hpp"

namespace clathra {
namespace {

/// Lengths times `scale`; speeds stay.
Specimen scaled(Specimen s, double scale) {
  for (double* edge : {&s.left, &s.right, &s.bottom, &s.top, &s.d50}) *edge *= scale;
  for (auto* lengths : {&s.x, &s.y, &s.radius})
    for (double& length : *lengths) length *= scale;
  for (double& spin : s.omega) spin /= scale;
  return s;
}

/// Sheared sand between servo walls; stresses, strains and speeds in numbers that do not depend on the scale.
std::vector<double> numbers_of(double scale) {
  Specimen s = disordered_patch(14, 14);
  for (std::size_t i = 0; i < s.size(); ++i) {
    s.vx[i] = 0.3 * (uniform_random(5, 1, i) - 0.5);
    s.omega[i] = 100 * (uniform_random(5, 2, i) - 0.5);
  }
  SimulationLaws laws = sand_laws();
  laws.motion.damping = 0.3;
  laws.wall.friction = 0.3;
  laws.contact.grain.damping_ratio = 0.02;
  Simulation sim(scaled(s, scale), laws, 0.05 * grain_d50 * scale);
  sim.choose_time_step({TimeStepRule::adaptive, 0.6});
  sim.loading().servo.integral_time = 1e-5 * scale;
  sim.loading().x = AxisDrive::at_stress(1e6, 1);
  sim.loading().y = AxisDrive::at_rate(300 / scale);
  sim.set_ledger(true);
  std::vector<double> numbers{sim.assembly().stable_time_step() / scale, sim.assembly().largest_frequency() * scale};
  sim.step(4000);
  Measures const m = sim.assembly().measures();
  DissipationTotals const lost = sim.assembly().losses();
  double const area = scale * scale;
  numbers.insert(
      numbers.end(),
      {sim.assembly().stress().x, sim.assembly().stress().y, m.stress_area_xx / area, m.touching, m.kinetic / area,
       m.grain_energy / area, lost.sliding / area, lost.rolling / area, lost.dashpot / area, lost.damping / area,
       sim.assembly().boundary_work() / area, sim.assembly().void_ratio(), static_cast<double>(sim.assembly().upkeep.searches()),
       static_cast<double>(sim.time_steps().updates()), sim.assembly().time() / scale, sim.time_step / scale});
  Specimen const end = sim.specimen();
  for (std::size_t i = 0; i < end.size(); ++i)
    numbers.insert(numbers.end(), {end.x[i] / scale, end.y[i] / scale, end.vx[i], end.omega[i] * scale});
  return numbers;
}

TEST(Scale, OfAPowerOfTwoChangesNoDigit) {
  std::vector<double> const sand = numbers_of(1);
  EXPECT_GT(sand[5], 100);  // touching pairs
  for (double const scale : {0x1p8, 0x1p-8, 0x1p3}) EXPECT_EQ(numbers_of(scale), sand) << scale;
  if (!HasFailure())
    print_row("a specimen 2^8, 2^3 and 2^-8 times as large under the same stresses", "the same digits", "the same digits");
}

}  // namespace
}  // namespace clathra
