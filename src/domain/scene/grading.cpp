#include "domain/scene/grading.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <stdexcept>

#include "domain/scene/grading_file.hpp"
#include "domain/scene/units.hpp"

namespace clathra {

Grading::Grading(std::vector<double> diameters, std::vector<double> finer)
    : diameters_(std::move(diameters)), finer_(std::move(finer)) {
  if (diameters_.size() != finer_.size() || diameters_.empty())
    throw std::invalid_argument("a grading needs pairs of diameter and percent finer");
  for (std::size_t k = 0; k < diameters_.size(); ++k) {
    bool const rising = k == 0 || (diameters_[k] > diameters_[k - 1] && finer_[k] >= finer_[k - 1]);
    if (!(diameters_[k] > 0) || !(finer_[k] >= 0 && finer_[k] <= 1) || !rising) {
      throw std::invalid_argument("grading row " + std::to_string(k + 1) + " (diameter " + std::to_string(diameters_[k] * 1e3) +
                                  " mm, finer " + std::to_string(finer_[k] * 100) +
                                  " %) must have a larger diameter and not less finer than the row before");
    }
  }
  if (finer_.back() != 1 || (diameters_.size() > 1 && finer_.front() != 0)) {
    throw std::invalid_argument("a grading must begin at 0 % finer and end at 100 % finer");
  }
  cut_empty_ends();
  // Between two points dF is uniform in s = ln d, and the number of discs is dF / d^2: its integral is known.
  number_.assign(diameters_.size(), 0);
  for (std::size_t k = 1; k < diameters_.size(); ++k) {
    double const slope = (finer_[k] - finer_[k - 1]) / std::log(diameters_[k] / diameters_[k - 1]);
    number_[k] = number_[k - 1] + 0.5 * slope * (std::pow(diameters_[k - 1], -2) - std::pow(diameters_[k], -2));
  }
}

void Grading::cut_empty_ends() {
  auto const some = std::upper_bound(finer_.begin(), finer_.end(), 0.0), all = std::lower_bound(some, finer_.end(), 1.0);
  auto const first = std::max<std::ptrdiff_t>(some - finer_.begin() - 1, 0), end = all - finer_.begin() + 1;
  for (auto* const values : {&diameters_, &finer_}) *values = {values->begin() + first, values->begin() + end};
}

Grading Grading::toyoura() {
  return Grading({0.100e-3, 0.106e-3, 0.125e-3, 0.15e-3, 0.1694e-3, 0.19e-3, 0.212e-3, 0.25e-3, 0.30e-3},
                 {0, 0.03, 0.12, 0.32, 0.50, 0.67, 0.82, 0.95, 1});
}

Grading Grading::uniform(double diameter) { return Grading({diameter}, {1}); }

Grading Grading::of(GradingScene const& scene) {
  Grading const base = !scene.file.empty()        ? read_grading(scene.file)
                       : scene.table == "uniform" ? uniform(scene.d50 > 0 ? scene.d50 : 0.1694e-3)
                                                  : toyoura();
  return base.scaled((scene.d50 > 0 ? scene.d50 : base.stated_d50()) / base.d50());
}

double Grading::stated_d50() const {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", d50());
  return parse_number(text);
}

double Grading::diameter_finer(double fraction) const {
  if (diameters_.size() == 1) return diameters_[0];
  std::size_t k = 1;
  while (k + 1 < finer_.size() && finer_[k] < fraction) ++k;
  double const share = finer_[k] > finer_[k - 1] ? (fraction - finer_[k - 1]) / (finer_[k] - finer_[k - 1]) : 0;
  return diameters_[k - 1] * std::pow(diameters_[k] / diameters_[k - 1], share);
}

double Grading::finer_than(double diameter) const {
  if (diameters_.size() == 1 || diameter <= smallest()) return diameter > smallest() ? 1 : 0;
  if (diameter >= largest()) return 1;
  std::size_t k = 1;
  while (diameters_[k] < diameter) ++k;
  return finer_[k - 1] +
         (finer_[k] - finer_[k - 1]) * std::log(diameter / diameters_[k - 1]) / std::log(diameters_[k] / diameters_[k - 1]);
}

double Grading::mean_disc_area() const {
  if (diameters_.size() == 1) return 0.25 * std::numbers::pi * diameters_[0] * diameters_[0];
  return 0.25 * std::numbers::pi / number_.back();
}

Grading Grading::scaled(double factor) const {
  std::vector<double> diameters = diameters_;
  for (double& d : diameters) d *= factor;
  return Grading(diameters, finer_);
}

std::vector<double> Grading::diameters(std::size_t count) const {
  if (diameters_.size() == 1) return std::vector<double>(count, diameters_[0]);
  std::vector<double> sizes(count);
  std::size_t k = 1;
  for (std::size_t i = 0; i < count; ++i) {
    double const wanted = number_.back() * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    while (k + 1 < number_.size() && number_[k] < wanted) ++k;
    double const slope = (finer_[k] - finer_[k - 1]) / std::log(diameters_[k] / diameters_[k - 1]);
    sizes[i] = 1 / std::sqrt(std::pow(diameters_[k - 1], -2) - 2 * (wanted - number_[k - 1]) / slope);
  }
  return sizes;
}

}  // namespace clathra
