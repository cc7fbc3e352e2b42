#include "io/results/scorecard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace clathra {
namespace {

std::string title_line(Claim const& claim) { return fmt::format("({}) {}", claim.id, claim.words); }

nlohmann::json part_json(ClaimPart const& part) {
  auto const bound = [](double value) { return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(); };
  nlohmann::json json{{"what", part.what},
                      {"unit", part.unit},
                      {"low", bound(part.low)},
                      {"high", bound(part.high)},
                      {"verdict", name_of(part.verdict())},
                      {"mean_is_inside", part.mean_is_inside()}};
  json["values"] = nlohmann::json::object();
  for (auto const& [seed, value] : part.values) json["values"][std::to_string(seed)] = value;
  auto const mean = part.mean();
  json["mean"] = mean ? nlohmann::json(mean->mean) : nlohmann::json();
  json["half_width"] = mean && mean->half_width ? nlohmann::json(*mean->half_width) : nlohmann::json();
  return json;
}

}  // namespace

std::string mean_text(ClaimPart const& part) {
  auto const m = part.mean();
  if (!m) return "-";
  if (!m->half_width) return fmt::format("{:.3g}", m->mean);
  double const half = *m->half_width;
  int const digits = half > 0 ? std::clamp(1 - static_cast<int>(std::floor(std::log10(half))), 0, 6) : 3;
  return fmt::format("{:.{}f} ± {:.{}f}", m->mean, digits, half, digits);
}

std::string source_text(Claim const& claim) {
  if (claim.where.empty()) return claim.ours ? "Ours." : "";
  return (claim.ours ? "Ours, after " : "Stated in ") + claim.where + ".";
}

std::string bounds_text(ClaimPart const& part) {
  bool const low = std::isfinite(part.low), high = std::isfinite(part.high);
  if (low && high) return fmt::format("{:g} to {:g}", part.low, part.high);
  return low ? fmt::format(">= {:g}", part.low) : fmt::format("<= {:g}", part.high);
}

std::string tally(std::vector<Claim> const& claims) {
  std::string text;
  for (Verdict const verdict : {Verdict::pass, Verdict::partial, Verdict::fail, Verdict::undetermined}) {
    auto const n = std::count_if(claims.begin(), claims.end(), [&](Claim const& c) { return c.verdict() == verdict; });
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", n, name_of(verdict));
  }
  return text;
}

std::string scorecard_markdown(Scorecard const& card) {
  std::string text = "# " + card.title + "\n\n";
  for (auto const& [name, value] : card.facts) text += fmt::format("- {}: {}\n", name, value);
  text += fmt::format(
      "\n{}. pass, fail: the 95 % interval of the mean over the seeds, differences paired by specimen, lies inside, "
      "outside the bounds; undetermined: neither.\n\n| claim | verdict | parts with the mean inside |\n|---|---|---|\n",
      tally(card.claims));
  for (Claim const& claim : card.claims) {
    auto const inside = std::count_if(claim.parts.begin(), claim.parts.end(), [](auto const& p) { return p.mean_is_inside(); });
    text += fmt::format("| {} | {} | {} of {} |\n", title_line(claim), name_of(claim.verdict()), inside, claim.parts.size());
  }
  for (Claim const& claim : card.claims) {
    std::string const source = source_text(claim);
    text += fmt::format(
        "\n## {}\n\n{}| number | mean and 95 % interval | unit | claimed | seeds | verdict |\n|---|---|---|---|---|---|\n",
        title_line(claim), source.empty() ? "" : source + "\n\n");
    for (ClaimPart const& part : claim.parts)
      text += fmt::format("| {} | {} | {} | {} | {} | {} |\n", part.what, mean_text(part), part.unit, bounds_text(part),
                          part.exact ? "-" : std::to_string(part.values.size()), name_of(part.verdict()));
  }
  return text;
}

std::string scorecard_json(Scorecard const& card) {
  nlohmann::json json{{"title", card.title}, {"facts", card.facts}, {"claims", nlohmann::json::array()}};
  for (Claim const& claim : card.claims) {
    nlohmann::json parts = nlohmann::json::array();
    for (ClaimPart const& part : claim.parts) parts.push_back(part_json(part));
    json["claims"].push_back({{"id", claim.id},
                              {"words", claim.words},
                              {"where", claim.where},
                              {"ours", claim.ours},
                              {"verdict", name_of(claim.verdict())},
                              {"share_inside", claim.share_inside()},
                              {"parts", parts}});
  }
  return json.dump(1) + "\n";
}

}  // namespace clathra
