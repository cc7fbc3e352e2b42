#include "io/results/scored_claims.hpp"

#include <fmt/format.h>

#include <cmath>

#include "domain/measurement/curve_features.hpp"
#include "domain/scene/hydrate.hpp"
#include "io/results/shown_units.hpp"

namespace clathra {
namespace {

SeedNumbers scaled(SeedNumbers numbers, double factor) {
  for (auto& [seed, value] : numbers) value *= factor;
  return numbers;
}

/// Makes the parts of one claim.
class Scorer {
 public:
  Scorer(Paper const& paper, TestQuantities const& numbers, double d50) : paper_(paper), numbers_(numbers), d50_(d50) {}

  void add(Claim& claim, PaperPart const& part) const {
    if (part.kind == PartKind::critical_thickness) return add_images(claim, part);
    for (PaperSeries const& one : part.series) {
      PaperSeries const series = placed(paper_, one, d50_);
      if (part.kind == PartKind::value)
        add_values(claim, part, series);
      else if (part.kind == PartKind::step || part.kind == PartKind::rise)
        add_differences(claim, part, series);
      else
        add_fit(claim, part, series);
    }
  }

 private:
  /// The number less the other one, in the unit of the part.
  SeedNumbers of(PaperPart const& part, std::string const& group) const {
    SeedNumbers const numbers = scaled(numbers_.of(group, part.number.name()), part.number.factor);
    if (!part.less.quantity) return numbers;
    return less(part, numbers, scaled(numbers_.of(group, part.less.name()), part.less.factor));
  }

  static SeedNumbers less(PaperPart const& part, SeedNumbers const& numbers, SeedNumbers const& other) {
    return paired(numbers, other, [&](double value, double taken) { return value - taken / part.divided_by; });
  }

  void add_values(Claim& claim, PaperPart const& part, PaperSeries const& series) const {
    for (std::size_t i = 0; i < series.groups.size(); ++i) {
      std::string const& group = series.groups[i];
      SeedNumbers values = of(part, group);
      if (part.only_where.quantity) {
        SeedNumbers const limited = scaled(numbers_.of(group, part.only_where.name()), part.only_where.factor);
        std::erase_if(values, [&](auto const& value) {
          auto const found = limited.find(value.first);
          return found == limited.end() || !(found->second < part.below);
        });
        if (values.empty()) continue;
      }
      claim.parts.push_back(
          {filled(part.what,
                  {{"group", label_of(paper_, group)}, {"at", place_name(paper_, series, i)}, {"series", series.label}}),
           part.number.unit, values, part.low, part.high});
    }
  }

  void add_differences(Claim& claim, PaperPart const& part, PaperSeries const& series) const {
    for (std::size_t i = 1; i < series.groups.size(); ++i) {
      std::size_t const from = part.kind == PartKind::step ? i - 1 : 0;
      claim.parts.push_back(
          {filled(part.what,
                  {{"from", place_name(paper_, series, from)}, {"to", place_name(paper_, series, i)}, {"series", series.label}}),
           part.number.unit, rise(of(part, series.groups[from]), of(part, series.groups[i])), part.low, part.high});
    }
  }

  struct Fit {
    SeedNumbers slope, bend;
  };

  /// Over the places of a series, for each seed that has the number in all of them. In the number's own unit.
  Fit fitted(WantedNumber const& number, PaperSeries const& series) const {
    Fit fit;
    for (auto const& [seed, first] : numbers_.of(series.groups.front(), number.name())) {
      std::vector<double> y;
      for (std::string const& group : series.groups) {
        SeedNumbers const& values = numbers_.of(group, number.name());
        if (auto const at = values.find(seed); at != values.end()) y.push_back(at->second);
      }
      if (y.size() < series.groups.size()) continue;
      if (auto const line = slope_over(series.at, y, series.at.front(), series.at.back())) fit.slope[seed] = *line;
      if (auto const parabola = fitted_parabola(series.at, y)) fit.bend[seed] = parabola->bend;
    }
    return fit;
  }

  void add_fit(Claim& claim, PaperPart const& part, PaperSeries const& series) const {
    Fit const fit = fitted(part.number, series);
    std::string const& unit = part.number.unit;
    ClaimPart scored{filled(part.what, {{"series", series.label}}), "", {}, part.low, part.high};
    if (part.kind == PartKind::slope) {
      scored.unit = part.per == 1 ? unit + "/" + series.unit : fmt::format("{} per {:g} {}", unit, part.per, series.unit);
      SeedNumbers const slope = part.less.quantity ? less(part, fit.slope, fitted(part.less, series).slope) : fit.slope;
      scored.values = scaled(slope, part.per * part.number.factor);
    } else if (part.kind == PartKind::bend) {
      scored.unit = unit + "/" + series.unit + "^2";
      scored.values = scaled(fit.bend, part.number.factor);
    } else {
      double const half = (series.at.back() - series.at.front()) / 2;
      scored.unit = "%";
      scored.values = paired(fit.bend, numbers_.of(series.groups.back(), part.number.name()),
                             [&](double bend, double last) { return percent * std::abs(bend) * half * half / last; });
    }
    claim.parts.push_back(std::move(scored));
  }

  void add_images(Claim& claim, PaperPart const& part) const {
    for (ThicknessImage const& image : paper_.images) {
      double const ratio = critical_thickness_ratio(image.saturation) * image.d50 / image.thickness;
      claim.parts.push_back({filled(part.what, {{"saturation", fmt::format("{:g} %", image.saturation * percent)}}),
                             "",
                             {{0, ratio}},
                             part.low,
                             part.high,
                             true});
    }
  }

  Paper const& paper_;
  TestQuantities const& numbers_;
  double d50_;
};

}  // namespace

std::vector<Claim> scored_claims(Paper const& paper, TestQuantities const& numbers, double d50) {
  std::vector<Claim> claims;
  Scorer const scorer(paper, numbers, d50);
  for (PaperClaim const& one : paper.claims) {
    claims.push_back({one.id, one.words, {}, one.where, one.ours});
    for (PaperPart const& part : one.parts) scorer.add(claims.back(), part);
  }
  return claims;
}

}  // namespace clathra
