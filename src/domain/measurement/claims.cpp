#include "domain/measurement/claims.hpp"

#include <algorithm>

namespace clathra {

SeedNumbers rise(SeedNumbers const& a, SeedNumbers const& b) {
  return paired(a, b, [](double from, double to) { return to - from; });
}

char const* name_of(Verdict verdict) {
  constexpr char const* names[] = {"pass", "partial", "fail", "undetermined"};
  return names[static_cast<int>(verdict)];
}

std::optional<MeanInterval> ClaimPart::mean() const {
  if (values.empty()) return {};
  std::vector<double> list;
  for (auto const& [seed, value] : values) list.push_back(value);
  return mean_interval(list);
}

Verdict ClaimPart::verdict() const {
  std::optional<MeanInterval> const m = mean();
  if (!m || (!exact && !m->half_width)) return Verdict::undetermined;
  if (m->low() >= low && m->high() <= high) return Verdict::pass;
  return m->low() > high || m->high() < low ? Verdict::fail : Verdict::undetermined;
}

bool ClaimPart::mean_is_inside() const {
  std::optional<MeanInterval> const m = mean();
  return m && low <= m->mean && m->mean <= high;
}

Verdict Claim::verdict() const {
  auto const count = [&](Verdict verdict) {
    return std::count_if(parts.begin(), parts.end(), [&](ClaimPart const& part) { return part.verdict() == verdict; });
  };
  auto const all = static_cast<std::ptrdiff_t>(parts.size()), passed = count(Verdict::pass), failed = count(Verdict::fail);
  if (all > 0 && passed == all) return Verdict::pass;
  if (all > 0 && failed == all) return Verdict::fail;
  return passed > 0 && failed > 0 ? Verdict::partial : Verdict::undetermined;
}

double Claim::share_inside() const {
  auto const inside = std::count_if(parts.begin(), parts.end(), [](ClaimPart const& part) { return part.mean_is_inside(); });
  return parts.empty() ? 0 : static_cast<double>(inside) / static_cast<double>(parts.size());
}

}  // namespace clathra
