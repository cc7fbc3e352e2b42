#include "summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace clathra {

void Summary::add(HistoryRow const& row) {
  constexpr double tolerance = 0.01;
  last_ = row;
  ++count_;
  if (count_ == 1 || is_new_peak(row.q_Pa, peak_.q_Pa)) peak_ = row;
  if (row.eps1 >= residual_from_) residual_sum_ += row.q_Pa, ++residual_count_;
  if (std::fabs(row.sigma3_Pa - confining_stress_) <= tolerance * confining_stress_) ++held_;
  double const contact_q = row.contact_sigma1_Pa - row.contact_sigma3_Pa;
  if (row.p_Pa > 0) mismatch_ = std::max(mismatch_, std::fabs(row.q_Pa - contact_q) / row.p_Pa);
}

StageRecord Summary::numbers() const {
  StageRecord numbers;
  if (count_ == 0) return numbers;
  numbers["records"] = count_;
  numbers["peak_q_Pa"] = peak_.q_Pa;
  numbers["peak_eps1"] = peak_.eps1;
  numbers["peak_eps_v"] = peak_.eps_v;
  if (residual_count_ > 0) {
    numbers["residual_q_Pa"] = residual_sum_ / residual_count_;
    numbers["residual_from_eps1"] = residual_from_;
  }
  numbers["end_eps1"] = last_.eps1;
  numbers["end_eps_v"] = last_.eps_v;
  numbers["end_intact_initial_pct"] = last_.intact_initial_pct;
  numbers["sigma3_held"] = static_cast<double>(held_) / count_;
  numbers["stress_mismatch"] = mismatch_;
  if (has_energy_ && energy_.boundary_work != 0) numbers["energy_residual"] = std::fabs(energy_residual());
  return numbers;
}

std::vector<std::string> Summary::warnings() const {
  constexpr double most_residual = 0.01, least_held = 0.9;
  std::vector<std::string> texts;
  if (has_energy_ && !(std::fabs(energy_residual()) <= most_residual))
    texts.push_back(
        fmt::format("{:.3g} % of the boundary work is unaccounted for (more than {:g} %): the time step is too long for "
                    "this test, lower run.dt_safety",
                    100 * std::fabs(energy_residual()), 100 * most_residual));
  if (count_ > 0 && held_ < least_held * count_)
    texts.push_back(
        fmt::format("sigma3 was within 1 % of {:g} MPa in only {:.1f} % of the records (fewer than {:g} %): the servo walls "
                    "did not hold it, lower the inertial number",
                    confining_stress_ * 1e-6, 100.0 * held_ / count_, 100 * least_held));
  return texts;
}

std::string Summary::text() const {
  if (count_ == 0) return {};
  std::string text = fmt::format("peak      q {:.4g} MPa at eps1 {:.3g} %, eps_v {:.3g} %\n", peak_.q_Pa * 1e-6, peak_.eps1 * 100,
                                 peak_.eps_v * 100);
  if (residual_count_ > 0)
    text += fmt::format("residual  q {:.4g} MPa (mean from eps1 {:.3g} % on), eps_v {:.3g} % at eps1 {:.3g} %\n",
                        residual_sum_ / residual_count_ * 1e-6, residual_from_ * 100, last_.eps_v * 100, last_.eps1 * 100);
  if (last_.bonds_intact + last_.broken.total() > 0) {
    std::string modes;
    for (BreakModeNames const& m : break_modes)
      modes += fmt::format("{}{} {}", modes.empty() ? "" : ", ", last_.broken[m.mode], m.name);
    text += fmt::format("bonds     {} intact ({:.3g} % of the first), broken: {}\n", last_.bonds_intact, last_.intact_initial_pct,
                        modes);
  }
  text += fmt::format("control   sigma3 within 1 % in {:.1f} % of the records\n", 100.0 * held_ / count_);
  if (has_energy_ && energy_.boundary_work != 0)
    text += fmt::format("energy    {:.3g} % of the boundary work unaccounted for\n", 100 * std::fabs(energy_residual()));
  return text;
}

}  // namespace clathra
