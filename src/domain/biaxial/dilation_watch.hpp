#pragma once
/// The angle of dilation of a test while it runs, whatever rows are written.
#include <array>
#include <cstdint>
#include <limits>
#include <string>

#include "domain/biaxial/shear_watch.hpp"
#include "domain/measurement/test_numbers.hpp"

namespace clathra {

/// Takes the strains of each check of a shear (check_interval) and looks at the stretch of dilation_window that ends there.
class DilationWatch {
 public:
  /// @param eps1,eps_v  natural strains since the shear began; eps1 ascends
  void check(double eps1, double eps_v);
  /// The largest psi of the stretches that ended since begin_record(), else that of the last one [deg]; nan before the first.
  double largest() const { return stretches_ > 0 ? largest_ : std::numeric_limits<double>::quiet_NaN(); }
  void begin_record() { largest_ = latest_; }

  /// Visits (name, number), for checkpoints.
  template <class Visit>
  void for_each_number(Visit&& visit) {
    visit("dilation_seen", seen_);
    visit("dilation_stretches", stretches_);
    visit("dilation_latest", latest_);
    visit("dilation_largest", largest_);
    for (std::size_t i = 0; i < kept; ++i) {
      visit("dilation_eps1_" + std::to_string(i), eps1_[i]);
      visit("dilation_eps_v_" + std::to_string(i), eps_v_[i]);
    }
  }

 private:
  /// A window and what a check may come late on either side.
  static constexpr std::size_t kept = static_cast<std::size_t>(dilation_window / check_interval + 0.5) + 3;
  std::array<double, kept> eps1_ = {}, eps_v_ = {};  // of the last checks, in turns; the first is the start of the shear
  std::int64_t seen_ = 1, stretches_ = 0;
  double latest_ = -90, largest_ = -90;  // [deg]
};

}  // namespace clathra
