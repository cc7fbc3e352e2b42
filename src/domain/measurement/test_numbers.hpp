#pragma once
/// The numbers by which a biaxial test is known, from its history.
#include <optional>
#include <vector>

#include "domain/measurement/test_phases.hpp"
#include "domain/scene/stage.hpp"

namespace clathra {

/// Stresses [Pa], compression positive; strains are natural ones. NaN where a history has no number for it.
struct TestNumbers {
  std::size_t peak = 0;              ///< the first row after the peak, or the row that is it
  double peak_q = 0, peak_eps1 = 0;  ///< of all steps
  double peak_sigma3 = 0;            ///< at the peak, between the rows beside it
  double residual_q = 0;             ///< mean over `residual_from` to the end
  double residual_sigma3 = 0;
  double residual_from = 0;              ///< axial strain, see residual_from()
  std::optional<double> secant_modulus;  ///< E50 = (q_peak / 2) / (eps_1 where q first gets there) [Pa]
  double eps_v_peak = 0, eps_v_end = 0;
  double largest_eps_v = 0, largest_eps_v_eps1 = 0;  ///< where contraction ends, and the axial strain there
  std::optional<double> dilation_angle;              ///< psi [rad], see dilation_angle()
  double end_eps1 = 0;
  double intact_peak = 0, intact_end = 0;  ///< of the bonds at installation [%]
  bool passed_peak = false;                ///< q of a later row is below `share_past_peak` of the peak's
};

/// The columns of a history that they follow from, one value a record; two records at least. NaN where there is no number.
struct TestCurves {
  std::vector<double> const &eps1, &eps_v;                ///< natural strains
  std::vector<double> const &q, &sigma3;                  ///< [Pa]
  std::vector<double> const& intact;                      ///< of the bonds at installation [%]
  std::vector<double> const &largest_q, &largest_q_eps1;  ///< of all steps since the record before
  std::vector<double> const& dilation_deg;                ///< of the stretches that ended since then
};

inline constexpr double dilation_window = 0.01;  ///< of axial strain
inline constexpr double share_past_peak = 0.98;  ///< of the peak's q

/// psi [rad] of a stretch in which the strains grow by so much; nothing where gamma does not grow.
std::optional<double> dilation_angle_of(double eps1, double eps_v);

/// The largest psi of a test by its rows alone [rad]: sin(psi) = -d eps_v / d gamma with gamma = eps_1 - eps_3 = 2 eps_1 - eps_v,
/// over stretches of dilation_window, so that single bursts do not make it. Negative where a test contracts throughout; nothing
/// for a shorter test.
std::optional<double> dilation_angle(std::vector<double> const& eps1, std::vector<double> const& eps_v);

/// What a test has come to by its last record, for its run.json, for reports and for tables alike.
TestNumbers test_numbers(TestCurves const& curves);

/// The same by the names under which run.json and `clathra report --json` have them; angles in degrees. Without what there is
/// not.
StageRecord record_of(TestNumbers const& numbers);

}  // namespace clathra
