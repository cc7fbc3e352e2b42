#include "domain/biaxial/dilation_watch.hpp"

#include <algorithm>
#include <numbers>

namespace clathra {

void DilationWatch::check(double eps1, double eps_v) {
  auto const place = [](std::int64_t check) { return static_cast<std::size_t>(check) % kept; };
  eps1_[place(seen_)] = eps1;
  eps_v_[place(seen_)] = eps_v;
  std::int64_t const last = seen_++, first = std::max<std::int64_t>(seen_ - static_cast<std::int64_t>(kept), 0);
  double const from = eps1 - dilation_window;
  std::int64_t before = last;
  while (before > first && eps1_[place(before)] > from) --before;
  std::size_t const a = place(before), b = place(before + 1);
  if (before == last || eps1_[a] > from) return;
  double const part = (from - eps1_[a]) / (eps1_[b] - eps1_[a]), eps_v_from = eps_v_[a] + part * (eps_v_[b] - eps_v_[a]);
  auto const psi = dilation_angle_of(dilation_window, eps_v - eps_v_from);
  if (!psi) return;
  latest_ = *psi * 180 / std::numbers::pi;
  largest_ = std::max(largest_, latest_);
  ++stretches_;
}

}  // namespace clathra
