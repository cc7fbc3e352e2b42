#include "run/curve_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace clathra {

std::string start_text(StageRecord const& prepare, double confining_stress) {
  return fmt::format("start     void ratio {:.4g} under {:.4g} MPa ({:.4g} before it was consolidated)\n",
                     prepare.at("void_ratio_after_consolidation"), confining_stress * 1e-6,
                     prepare.at("void_ratio_before_consolidation"));
}

void CurveSummary::add(HistoryRow const& row) {
  last_ = row;
  ++count_;
  curves_.eps1.push_back(row.eps1), curves_.eps_v.push_back(row.eps_v), curves_.sigma1.push_back(row.sigma1_Pa);
  curves_.sigma3.push_back(row.sigma3_Pa), curves_.void_ratio.push_back(row.void_ratio), q_.push_back(row.q_Pa);
  intact_.push_back(row.bonds_intact_pct), largest_q_.push_back(row.largest_q_Pa), largest_q_eps1_.push_back(row.largest_q_eps1);
  dilation_.push_back(row.dilation_deg);
}

void CurveSummary::add(EnergyRow const& row) {
  if (!has_energy_) first_energy_ = row;
  has_energy_ = true;
  energy_ = row;
  largest_work_ = std::max(largest_work_, std::abs(row.boundary_work - first_energy_.boundary_work));
}

StageRecord CurveSummary::numbers() const {
  StageRecord numbers;
  if (count_ == 0) return numbers;
  if (last_.stage == shear_stage)
    numbers = record_of(test());
  else
    numbers["largest_q_Pa"] = *std::max_element(largest_q_.begin(), largest_q_.end());
  numbers["records"] = count_;
  for (BreakModeNames const& m : break_modes) numbers[m.broken] = static_cast<double>(last_.broken[m.mode]);
  if (largest_work_ > 0) numbers["energy_residual"] = std::fabs(energy_residual());
  return numbers;
}

std::vector<std::string> CurveSummary::warnings() const {
  constexpr double most_residual = 0.01;
  std::vector<std::string> texts;
  if (has_energy_ && !(std::fabs(energy_residual()) <= most_residual))
    texts.push_back(
        fmt::format("{:.3g} % of the boundary work is unaccounted for (more than {:g} %): the time step is too long for "
                    "this test, lower run.time_step_safety",
                    100 * std::fabs(energy_residual()), 100 * most_residual));
  return texts;
}

std::string CurveSummary::text(std::optional<double> sigma3_held) const {
  if (count_ == 0) return {};
  TestNumbers const n = test();
  std::string text = fmt::format("{:<9} q {:.4g} MPa at eps1 {:.3g} %, eps_v {:.3g} %{}\n", n.passed_peak ? "peak" : "largest",
                                 n.peak_q * 1e-6, n.peak_eps1 * 100, n.eps_v_peak * 100,
                                 n.passed_peak ? "" : ": q has not fallen by 2 % after it, a peak may lie beyond");
  if (n.passed_peak)
    text += fmt::format("residual  q {:.4g} MPa (mean from eps1 {:.3g} % on), eps_v {:.3g} % at eps1 {:.3g} %\n",
                        n.residual_q * 1e-6, n.residual_from * 100, n.eps_v_end * 100, n.end_eps1 * 100);
  if (last_.bonds_intact + last_.broken.total() > 0) {
    std::string modes;
    for (BreakModeNames const& m : break_modes)
      if (m.mode != BreakMode::dissolved || last_.broken[m.mode] > 0)
        modes += fmt::format("{}{} {}", modes.empty() ? "" : ", ", last_.broken[m.mode], m.name);
    text += fmt::format("bonds     {} intact ({:.3g} % of the first), broken: {}\n", last_.bonds_intact, last_.bonds_intact_pct,
                        modes);
  }
  if (sigma3_held) text += fmt::format("control   sigma3 within 1 % in {:.1f} % of the checks\n", 100 * *sigma3_held);
  if (largest_work_ > 0)
    text += fmt::format("energy    {:.3g} % of the boundary work unaccounted for\n", 100 * std::fabs(energy_residual()));
  return text;
}

}  // namespace clathra
