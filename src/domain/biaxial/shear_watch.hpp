#pragma once
/// What is looked at while a specimen is sheared, whatever is written: is the test still quasi-static, is sigma_3 held, do grains
/// overlap too far? The limits and how often they are right are measured in perf/guards.
#include <string>
#include <vector>

#include "domain/scene/stage.hpp"
#include "domain/simulation/simulation.hpp"

namespace clathra {

inline constexpr double check_interval = 2e-4;    ///< of axial strain
inline constexpr double unbalanced_limit = 1e-2;  ///< of single checks, which are counted
/// Of the mean over the checks up to the peak of q, of a bonded test. What follows is the failure itself: it is as fast as the
/// specimen wants it. Sand shakes without consequence where it is not damped; its peak follows the rate (inertial_warning()).
inline constexpr double unbalanced_to_peak_limit = 5e-3;
/// Of q on the walls less q of the contacts, over p, up to the peak.
inline constexpr double mismatch_limit = 0.08;
inline constexpr double stress_held = 0.01;        ///< part of sigma_3 that a check may be off
inline constexpr double least_held = 0.9;          ///< of the checks up to the peak
inline constexpr double stress_error_limit = 0.1;  ///< part of sigma_3 that no check may be off
/// Kinetic over elastic energy, of scaled masses: what tests with their own masses reach for a moment when bonds break in bursts
/// (0.004 to 0.047 at I = 2e-4, perf/reports/0.1/accuracy.md).
inline constexpr double kinetic_limit = 0.05;
inline constexpr double fast_share = 0.01;  ///< of the checks of a whole test that may be above it
/// Of the touching pairs that may overlap by more than a tenth of the smaller radius: at 55 % of hydrate, 1 MPa and the usual
/// stiffness 0.012 do.
inline constexpr double deep_overlap_share = 0.05;

/// What one check sees.
struct ShearCheck {
  double eps1 = 0, q = 0, sigma1 = 0;  ///< on the walls [Pa]
  double stress_error = 0;             ///< of sigma_3, over what it should be; 0 where it is not steered
  double mismatch = 0;                 ///< of q on walls and contacts, over p
  double unbalanced = 0, kinetic = 0;  ///< ratio of forces; energy over the elastic one
  double deep_share = 0, deepest = 0;  ///< of the contacts; overlap over the smaller radius
  double time_step = 0;                ///< [s]
};
/// Collective; changes nothing of the simulation. @param m  of the simulation as it stands
ShearCheck look_at_shear(Simulation const& simulation, Measures const& m, double eps1);

/// What checks have found.
struct ShearChecks {
  std::int64_t checks = 0, unbalanced = 0, fast = 0, held = 0;
  double mean_unbalanced = 0, largest_unbalanced = 0;
  double largest_kinetic = 0, largest_mismatch = 0, largest_stress_error = 0;
};

class ShearWatch {
 public:
  /// Whether the next check is due at this axial strain.
  bool due(double eps1) const { return eps1 >= next(); }
  double next() const { return (static_cast<double>(all_.checks) + 1) * check_interval; }
  void add(ShearCheck const& check);

  /// False where forces of a bonded test were out of balance on the way to the largest q so far.
  bool balanced(bool bonded) const { return !bonded || to_peak_.mean_unbalanced <= unbalanced_to_peak_limit; }
  /// False where the kinetic energy was above its share of the elastic one in more than 1 % of the checks of a whole test.
  bool is_slow(double axial_strain) const;
  std::string of_kinetic_energy() const;
  double largest_sigma1() const { return largest_sigma1_; }  ///< [Pa]
  /// In words: what was not as it should be.
  std::vector<std::string> warnings(bool bonded, bool began_at_rest = true) const;

  /// Visits (name, number), for checkpoints.
  template <class Visit>
  void for_each_number(Visit&& visit) {
    for_each_number_of(all_, "", visit);
    for_each_number_of(to_peak_, "_to_peak", visit);
    visit("peak_q_of_checks", peak_q_);
    visit("largest_sigma1_Pa", largest_sigma1_);
    visit("deep_overlap_share", deep_share_);
    visit("deep_overlap_eps1", deep_eps1_);
    visit("deepest_overlap", deepest_);
    visit("smallest_time_step_s", smallest_step_);
    visit("largest_time_step_s", largest_step_);
  }
  /// Those of them that a run's record has, and shares of the checks.
  StageRecord record() const;

 private:
  template <class Visit>
  static void for_each_number_of(ShearChecks& checks, std::string const& suffix, Visit& visit) {
    visit("checks" + suffix, checks.checks);
    visit("checks_unbalanced" + suffix, checks.unbalanced);
    visit("checks_fast" + suffix, checks.fast);
    visit("checks_held" + suffix, checks.held);
    visit("mean_unbalanced" + suffix, checks.mean_unbalanced);
    visit("largest_unbalanced" + suffix, checks.largest_unbalanced);
    visit("largest_kinetic_share" + suffix, checks.largest_kinetic);
    visit("stress_mismatch" + suffix, checks.largest_mismatch);
    visit("sigma3_error" + suffix, checks.largest_stress_error);
  }

  ShearChecks all_, to_peak_;                    // up to the largest q so far
  double peak_q_ = -1e300, largest_sigma1_ = 0;  // [Pa]
  double deep_share_ = 0, deep_eps1_ = 0;        // the largest share, and when
  double deepest_ = 0;                           // overlap over the smaller radius
  double smallest_step_ = 0, largest_step_ = 0;  // [s]
};

}  // namespace clathra
