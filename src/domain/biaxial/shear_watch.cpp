#include "domain/biaxial/shear_watch.hpp"

#include <algorithm>
#include <cmath>

#include "domain/simulation/printed_text.hpp"

namespace clathra {

namespace {

double share(std::int64_t part, std::int64_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0;
}

/// q on the walls less q of the contacts without what rough walls shear, over p.
double stress_mismatch(Simulation const& simulation, Measures const& m) {
  WallStress const stress = simulation.assembly().stress();
  double const contacts =
                   (m.stress_area_yy - m.wall_shear_yy - (m.stress_area_xx - m.wall_shear_xx)) / simulation.assembly().area(),
               p = 0.5 * (stress.x + stress.y);
  return p > 0 ? std::fabs(stress.y - stress.x - contacts) / p : 0;
}

void count(ShearChecks& all, ShearCheck const& check) {
  ++all.checks;
  all.unbalanced += check.unbalanced > unbalanced_limit ? 1 : 0;
  all.fast += check.kinetic > kinetic_limit ? 1 : 0;
  all.held += check.stress_error <= stress_held ? 1 : 0;
  all.mean_unbalanced += (check.unbalanced - all.mean_unbalanced) / static_cast<double>(all.checks);
  all.largest_unbalanced = std::max(all.largest_unbalanced, check.unbalanced);
  all.largest_kinetic = std::max(all.largest_kinetic, check.kinetic);
  all.largest_mismatch = std::max(all.largest_mismatch, check.mismatch);
  all.largest_stress_error = std::max(all.largest_stress_error, check.stress_error);
}

}  // namespace

ShearCheck look_at_shear(Simulation const& simulation, Measures const& m, double eps1) {
  WallStress const stress = simulation.assembly().stress();
  double const elastic = m.grain_energy + m.bond_energy + m.wall_energy;
  AxisDrive const& lateral = simulation.assembly().now.walls.loading.x;
  ShearCheck check;
  check.eps1 = eps1;
  check.q = stress.y - stress.x;
  check.sigma1 = stress.y;
  if (lateral.kind == AxisDrive::Kind::stress)
    check.stress_error = std::fabs(stress.x - lateral.target_stress) / lateral.target_stress;
  check.mismatch = stress_mismatch(simulation, m);
  check.unbalanced = m.unbalanced_ratio(simulation.assembly().discs());
  check.kinetic = elastic > 0 ? m.kinetic / elastic : 0;
  check.deep_share = m.deep > 0 ? m.deep / m.touching : 0;
  check.deepest = m.deep > 0 ? simulation.assembly().deepest_overlap() : 0;
  check.time_step = simulation.time_step;
  return check;
}

void ShearWatch::add(ShearCheck const& check) {
  smallest_step_ = all_.checks == 0 ? check.time_step : std::min(smallest_step_, check.time_step);
  largest_step_ = std::max(largest_step_, check.time_step);
  count(all_, check);
  largest_sigma1_ = std::max(largest_sigma1_, check.sigma1);
  if (check.q > peak_q_) {
    peak_q_ = check.q;
    to_peak_ = all_;
  }
  deepest_ = std::max(deepest_, check.deepest);
  if (check.deep_share <= deep_share_) return;
  deep_share_ = check.deep_share;
  deep_eps1_ = check.eps1;
}

bool ShearWatch::is_slow(double axial_strain) const {
  return static_cast<double>(all_.fast) <= std::max(1.0, fast_share * axial_strain / check_interval);
}

std::string ShearWatch::of_kinetic_energy() const {
  return printed_text(
      "the kinetic energy of the scaled masses was above %g of the elastic energy in %lld of %lld checks (%.3g at most)",
      kinetic_limit, static_cast<long long>(all_.fast), static_cast<long long>(all_.checks), all_.largest_kinetic);
}

std::vector<std::string> ShearWatch::warnings(bool bonded, bool began_at_rest) const {
  char const* const advice = began_at_rest ? "lower test.inertial_number" : "the test did not begin at rest";
  std::vector<std::string> texts;
  if (!balanced(bonded))
    texts.push_back(printed_text(
        "forces were out of balance on the way to the peak of q, by %.2g of the mean contact force (%g is quasi-static): "
        "the peak is likely to be more than 2 %% off, %s",
        to_peak_.mean_unbalanced, unbalanced_to_peak_limit, advice));
  if (to_peak_.largest_mismatch > mismatch_limit)
    texts.push_back(printed_text(
        "q on the walls and q of the contacts were up to %.2g of p apart on the way to the peak (%g is usual): stress "
        "varies along the specimen, %s",
        to_peak_.largest_mismatch, mismatch_limit, advice));
  if (to_peak_.checks > 0 && share(to_peak_.held, to_peak_.checks) < least_held)
    texts.push_back(printed_text(
        "sigma_3 was within %g %% in only %.1f %% of the checks up to the peak of q (fewer than %g %%): the servo walls "
        "did not hold it, %s",
        100 * stress_held, 100 * share(to_peak_.held, to_peak_.checks), 100 * least_held, advice));
  if (all_.largest_stress_error > stress_error_limit)
    texts.push_back(printed_text("sigma_3 was off by up to %.3g %% (%g %% are allowed): the servo walls did not hold it, %s%s",
                                 100 * all_.largest_stress_error, 100 * stress_error_limit, advice,
                                 began_at_rest ? " or take more particles" : ""));
  if (deep_share_ > deep_overlap_share)
    texts.push_back(
        printed_text("%.3g %% of the contacts overlapped by more than 10 %% of the smaller radius at %.3g %% strain, the "
                     "deepest of the test by %.3g %%: the grains are too soft for this stress (grains.normal_stiffness)",
                     deep_share_ * 100, deep_eps1_ * 100, deepest_ * 100));
  return texts;
}

StageRecord ShearWatch::record() const {
  StageRecord record;
  ShearWatch copy = *this;
  copy.for_each_number([&](std::string const& name, auto const& value) { record[name] = static_cast<double>(value); });
  for (char const* const internal : {"peak_q_of_checks", "checks_held", "checks_held_to_peak"}) record.erase(internal);
  record["sigma3_held"] = share(all_.held, all_.checks);
  record["sigma3_held_to_peak"] = share(to_peak_.held, to_peak_.checks);
  return record;
}

}  // namespace clathra
