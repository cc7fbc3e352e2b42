#pragma once
/// The numbers of a finished test that people compare: peak, residual, volume change, quality of the control.
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "domain/measurement/history_row.hpp"
#include "domain/measurement/loading_numbers.hpp"
#include "domain/measurement/test_numbers.hpp"
#include "domain/scene/stage.hpp"

namespace clathra {

/// A line for the screen: the void ratio at the start of the test. @param prepare  BiaxialTest::preparation()
std::string start_text(StageRecord const& prepare, double confining_stress);

/// Collects them from the records of a test as they come.
class CurveSummary {
 public:
  void add(HistoryRow const& row);
  void add(EnergyRow const& row);

  int records() const { return count_; }
  LoadingCurves const& curves() const { return curves_; }
  /// Of a shear those of record_of(); the bonds broken by mode; energy_residual (part of the boundary work) where there is a
  /// ledger.
  StageRecord numbers() const;
  /// In words: why the numbers are not to be trusted (energy residual above 1 % of the work).
  std::vector<std::string> warnings() const;
  /// A few lines for the screen. @param sigma3_held  part of the checks with sigma3 within 1 %, where it is to be held
  std::string text(std::optional<double> sigma3_held) const;

 private:
  /// Of the ledger since the first record, over the largest work since then.
  /// Of the work, or of a thousandth of what is stored: a stage that only holds stresses does no work to speak of.
  double energy_residual() const {
    double const least = 1e-3 * (energy_.grain_elastic + energy_.bond_elastic + energy_.wall_elastic);
    return largest_work_ > 0 ? (energy_.residual - first_energy_.residual) / std::max(largest_work_, least) : 0;
  }

  TestNumbers test() const {
    return test_numbers({curves_.eps1, curves_.eps_v, q_, curves_.sigma3, intact_, largest_q_, largest_q_eps1_, dilation_});
  }

  LoadingCurves curves_;                                                    // of all records
  std::vector<double> q_, intact_, largest_q_, largest_q_eps1_, dilation_;  // likewise
  HistoryRow last_;
  EnergyRow first_energy_, energy_;
  double largest_work_ = 0;  // since the first of them [J/m]
  bool has_energy_ = false;
  int count_ = 0;  // records
};

}  // namespace clathra
