#include "terminal/text.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

namespace clathra {

std::string duration_text(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0) return "?";
  if (seconds >= 365.25 * 86400) return fmt::format("{:.3g} years", seconds / (365.25 * 86400));
  if (seconds >= 3 * 86400) return fmt::format("{:.3g} days", seconds / 86400);
  auto const whole = static_cast<long long>(std::llround(seconds));
  auto const pair = [](long long large, char const* unit, long long small, char const* smaller) {
    return fmt::format("{} {}", large, unit) + (small > 0 ? fmt::format(" {:02} {}", small, smaller) : "");
  };
  if (whole >= 3600) return pair(whole / 3600, "h", whole / 60 % 60, "min");
  return whole >= 60 ? pair(whole / 60, "min", whole % 60, "s") : fmt::format("{} s", whole);
}

std::string listed(std::vector<std::string> const& names) {
  constexpr std::size_t most = 5;
  std::size_t const shown = names.size() > most ? most - 1 : names.size();
  std::string text;
  for (std::size_t i = 0; i < shown; ++i) text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return shown < names.size() ? fmt::format("{} and {} more", text, names.size() - shown) : text;
}

std::string short_count(double value) {
  for (auto const& [scale, prefix] : {std::pair{1e12, "T"}, {1e9, "G"}, {1e6, "M"}, {1e3, "k"}})
    if (std::fabs(value) >= scale) return fmt::format("{:.3g} {}", value / scale, prefix);
  return fmt::format("{:.3g}", value);
}

std::string table_row(std::string const& name, std::string const& value) { return fmt::format("  {:<18} {}\n", name, value); }

double clock_seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

}  // namespace clathra
