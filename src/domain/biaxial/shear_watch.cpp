#include "domain/biaxial/shear_watch.hpp"

#include <algorithm>
#include <cstdio>

namespace clathra {

namespace {

/// A text with up to four numbers put in.
template <class... Numbers>
std::string text_of(char const* format, Numbers... numbers) {
  char text[320];
  std::snprintf(text, sizeof text, format, numbers...);
  return text;
}

}  // namespace

void ShearWatch::check(Simulation const& simulation, Measures const& m, double eps1) {
  double const unbalanced = m.unbalanced_ratio(simulation.discs());
  smallest_step_ = checks_ == 0 ? simulation.time_step : std::min(smallest_step_, simulation.time_step);
  largest_step_ = std::max(largest_step_, simulation.time_step);
  ++checks_;
  unbalanced_checks_ += unbalanced > unbalanced_limit ? 1 : 0;
  largest_unbalanced_ = std::max(largest_unbalanced_, unbalanced);
  double const elastic = m.grain_energy + m.bond_energy + m.wall_energy, kinetic = elastic > 0 ? m.kinetic / elastic : 0;
  fast_checks_ += kinetic > kinetic_limit ? 1 : 0;
  largest_kinetic_ = std::max(largest_kinetic_, kinetic);
  if (m.deep == 0) return;
  deepest_ = std::max(deepest_, simulation.deepest_overlap());
  if (m.deep / m.touching <= deep_share_) return;
  deep_share_ = m.deep / m.touching;
  deep_eps1_ = eps1;
}

std::string ShearWatch::of_kinetic_energy() const {
  return text_of(
      "the kinetic energy of the scaled masses was above %g of the elastic energy in %lld of %lld checks (%.3g at most)",
      kinetic_limit, static_cast<long long>(fast_checks_), static_cast<long long>(checks_), largest_kinetic_);
}

std::vector<std::string> ShearWatch::warnings() const {
  std::vector<std::string> texts;
  if (!balanced()) {
    texts.push_back(text_of(
        "the unbalanced ratio was above %g in %lld of %lld checks (%.3g at most): the shear is not quasi-static, "
        "lower the inertial number",
        unbalanced_limit, static_cast<long long>(unbalanced_checks_), static_cast<long long>(checks_), largest_unbalanced_));
  }
  if (deep_share_ > deep_overlap_share) {
    texts.push_back(
        text_of("%.3g %% of the contacts overlapped by more than 10 %% of the smaller radius at %.3g %% strain, the "
                "deepest of the test by %.3g %%: the grains are too soft for this stress (grains.kn)",
                deep_share_ * 100, deep_eps1_ * 100, deepest_ * 100));
  }
  return texts;
}

}  // namespace clathra
