#pragma once
/// What is looked at while a specimen is sheared, whatever is written: is the test still quasi-static, do grains overlap too far?
#include <algorithm>
#include <string>
#include <vector>

#include "domain/simulation/simulation.hpp"

namespace clathra {

inline constexpr double check_interval = 2e-4;      ///< of axial strain
inline constexpr double unbalanced_at_rest = 1e-3;  ///< mean unbalanced force over mean contact force, before the shear
inline constexpr double unbalanced_limit = 1e-2;    ///< while it is sheared
inline constexpr double unbalanced_share = 0.01;    ///< of the checks that may be above it
/// Kinetic over elastic energy, of scaled masses: what tests with their own masses reach for a moment when bonds break in bursts
/// (0.004 to 0.047 at I = 2e-4, docs/accuracy.md).
inline constexpr double kinetic_limit = 0.05;
inline constexpr double deep_overlap_share =
    1e-2;  ///< of the touching pairs that may overlap by more than a tenth of the smaller radius

class ShearWatch {
 public:
  /// Whether the next check is due at this axial strain.
  bool due(double eps1) const { return eps1 >= next(); }
  double next() const { return (static_cast<double>(checks_) + 1) * check_interval; }
  /// Collective; changes nothing of the simulation. @param m  of the simulation as it stands
  void check(Simulation const& simulation, Measures const& m, double eps1);

  /// False where the unbalanced ratio was above its limit in more than 1 % of the checks.
  bool balanced() const { return static_cast<double>(unbalanced_checks_) <= unbalanced_share * static_cast<double>(checks_); }
  /// False where the kinetic energy was above its share of the elastic one in more than 1 % of the checks of a whole test.
  bool is_slow(double axial_strain) const {
    return static_cast<double>(fast_checks_) <= std::max(1.0, unbalanced_share * axial_strain / check_interval);
  }
  std::string of_kinetic_energy() const;
  /// In words: what was not as it should be.
  std::vector<std::string> warnings() const;

  /// Visits (name, number), for the record of a run and for checkpoints.
  template <class Visit>
  void for_each_number(Visit&& visit) {
    visit("checks", checks_);
    visit("checks_unbalanced", unbalanced_checks_);
    visit("largest_unbalanced", largest_unbalanced_);
    visit("deep_overlap_share", deep_share_);
    visit("deep_overlap_eps1", deep_eps1_);
    visit("deepest_overlap", deepest_);
    visit("checks_fast", fast_checks_);
    visit("largest_kinetic_share", largest_kinetic_);
    visit("smallest_time_step_s", smallest_step_);
    visit("largest_time_step_s", largest_step_);
  }

 private:
  std::int64_t checks_ = 0, unbalanced_checks_ = 0, fast_checks_ = 0;
  double largest_unbalanced_ = 0;
  double largest_kinetic_ = 0;                   // energy over the elastic one
  double deep_share_ = 0, deep_eps1_ = 0;        // the largest share, and when
  double deepest_ = 0;                           // overlap over the smaller radius
  double smallest_step_ = 0, largest_step_ = 0;  // [s]
};

}  // namespace clathra
