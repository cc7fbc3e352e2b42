#include "io/report/strength.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "io/report/curves.hpp"
#include "io/report/markup.hpp"
#include "io/report/test_numbers.hpp"

namespace clathra {
namespace {

constexpr double mega = 1e-6, half_turn = 3.14159265358979323846;

/// Runs of the same saturation and bond law, by their place in the list of runs.
using Groups = std::map<std::pair<long, std::string>, std::vector<std::size_t>>;

Groups groups_of(std::vector<RunResults> const& runs) {
  Groups groups;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    double const saturation = runs[i].has_bonds() ? runs[i].number("/scene/hydrate/saturation").value_or(0) : 0;
    groups[{std::lround(saturation * 1e6), runs[i].has_bonds() ? runs[i].bond_variant() : "clean sand"}].push_back(i);
  }
  return groups;
}

/// The upper half of a Mohr circle [MPa].
Curve circle(FailureStress const& at, std::string name, Stroke const& stroke) {
  constexpr int segments = 72;
  Curve curve{std::move(name), {}, {}, stroke};
  double const centre = (at.sigma1 + at.sigma3) / 2 * mega, radius = (at.sigma1 - at.sigma3) / 2 * mega;
  for (int i = 0; i <= segments; ++i) {
    double const angle = half_turn * i / segments;
    curve.x.push_back(centre - radius * std::cos(angle));
    curve.y.push_back(radius * std::sin(angle));
  }
  return curve;
}

/// An envelope is drawn a little beyond the middle of the largest circle [MPa].
double end_of_line(std::vector<FailureStress> const& tests) {
  double end = 0;
  for (FailureStress const& t : tests) end = std::max(end, (0.7 * t.sigma1 + 0.3 * t.sigma3) * mega);
  return end;
}

std::string mohr_figure(std::vector<Curve> circles, std::vector<FailureStress> const& tests, std::string const& heading,
                        std::string const& which) {
  Plot plot;
  Range sigma, tau;
  for (FailureStress const& test : tests) {
    sigma.include(test.sigma1 * mega);
    tau.include((test.sigma1 - test.sigma3) / 2 * mega * 1.12);
  }
  plot.title = heading + ", " + which;
  plot.curves = std::move(circles);
  plot.x = sigma.axis("normal stress σ [MPa]");
  std::string caption = "Mohr circles of the stresses " + which + ". ";
  if (std::optional<Envelope> const fit = fitted_envelope(tests)) {
    double const slope = std::tan(fit->friction_angle), cohesion = fit->cohesion * mega;
    double const from = std::max(0.0, -cohesion / slope), to = end_of_line(tests);
    plot.curves.push_back({"envelope", {from, to}, {cohesion + slope * from, cohesion + slope * to}, {colours::black, "", 1.8}});
    tau.include(plot.curves.back().y);
    caption += fmt::format("Line: Mohr-Coulomb envelope τ = c + σ tan φ with c = {} MPa and φ = {:.1f}°",
                           with_minus(fmt::format("{:.3g}", cohesion)), fit->friction_angle * 180 / half_turn);
    caption += tests.size() > 2 ? fmt::format(", fitted to {} tests.", tests.size()) : ", which touches both circles.";
  } else {
    caption += "They have no common Mohr-Coulomb envelope.";
  }
  plot.y = tau.axis("shear stress τ [MPa]");
  plot.y.from = 0;
  plot.height = height_for_equal_scales(plot.x, plot.y);
  plot.description = caption;
  return figure(plot.title, svg(plot) + legend(plot.curves), caption);
}

/// Peak or residual stresses of a test.
FailureStress peak_stress(TestNumbers const& n) { return {n.peak_sigma3 + n.peak_q, n.peak_sigma3}; }
FailureStress residual_stress(TestNumbers const& n) { return {n.residual_sigma3 + n.residual_q, n.residual_sigma3}; }

/// What the tests at one saturation say.
struct GroupStrength {
  double saturation = 0;  ///< [%]
  std::optional<Envelope> at_peak, residual;
  std::string figures;
};

GroupStrength strength_of(long saturation_millionths, std::vector<RunResults> const& runs,
                          std::vector<std::size_t> const& members) {
  std::vector<FailureStress> peaks, residuals;
  std::vector<Curve> at_peak, at_residual;
  for (std::size_t const i : members) {
    TestNumbers const n = test_numbers(runs[i].history);
    peaks.push_back(peak_stress(n));
    residuals.push_back(residual_stress(n));
    at_peak.push_back(circle(peaks.back(), run_label(runs[i]), run_stroke(i)));
    at_residual.push_back(circle(residuals.back(), run_label(runs[i]), run_stroke(i)));
  }
  GroupStrength group{static_cast<double>(saturation_millionths) * 1e-4, fitted_envelope(peaks), fitted_envelope(residuals), ""};
  std::string const heading =
      group.saturation > 0 ? fmt::format("Strength at {:g} % hydrate", group.saturation) : "Strength of clean sand";
  group.figures =
      mohr_figure(at_peak, peaks, heading, "at the peak") + mohr_figure(at_residual, residuals, heading, "in the residual state");
  return group;
}

/// One number of the envelopes against the saturation, at the peak and in the residual state.
std::string saturation_figure(std::vector<GroupStrength> const& groups, std::string const& heading, std::string const& axis,
                              double (*number)(Envelope const&)) {
  Plot plot;
  plot.title = heading + " against hydrate saturation";
  plot.curves = {{"at the peak", {}, {}, {colours::vermilion, ""}, true}, {"residual", {}, {}, {colours::blue, "8 3"}, true}};
  Range saturations, values;
  for (GroupStrength const& group : groups)
    for (std::size_t k = 0; k < 2; ++k) {
      std::optional<Envelope> const& envelope = k == 0 ? group.at_peak : group.residual;
      if (!envelope) continue;
      plot.curves[k].x.push_back(group.saturation);
      plot.curves[k].y.push_back(number(*envelope));
      saturations.include(group.saturation);
      values.include(number(*envelope));
      plot.description += fmt::format("{} % hydrate, {}: {:.3g}. ", group.saturation, plot.curves[k].name, number(*envelope));
    }
  plot.x = saturations.axis("hydrate saturation [%]");
  plot.y = values.axis(axis);
  return figure(plot.title, svg(plot) + legend(plot.curves), "From the Mohr-Coulomb envelopes above, one for each saturation.");
}

std::string strength_against_saturation(std::vector<GroupStrength> const& groups) {
  return saturation_figure(groups, "Cohesion", "cohesion c [MPa]", [](Envelope const& e) { return e.cohesion * mega; }) +
         saturation_figure(groups, "Friction angle", "friction angle φ [°]",
                           [](Envelope const& e) { return e.friction_angle * 180 / half_turn; });
}

}  // namespace

std::optional<Envelope> fitted_envelope(std::vector<FailureStress> const& tests) {
  double const count = static_cast<double>(tests.size());
  double mean1 = 0, mean3 = 0, s33 = 0, s13 = 0;
  for (FailureStress const& t : tests) mean1 += t.sigma1 / count, mean3 += t.sigma3 / count;
  for (FailureStress const& t : tests) {
    s33 += (t.sigma3 - mean3) * (t.sigma3 - mean3);
    s13 += (t.sigma1 - mean1) * (t.sigma3 - mean3);
  }
  constexpr double same = 0.01;  // confining stresses that scatter by less are one
  if (!(s33 > same * same * mean3 * mean3 * count)) return std::nullopt;
  double const slope = s13 / s33;
  if (!(slope > 0)) return std::nullopt;
  return Envelope{(mean1 - slope * mean3) / (2 * std::sqrt(slope)), std::asin((slope - 1) / (slope + 1))};
}

std::string strength_figures(std::vector<RunResults> const& runs) {
  std::string figures;
  std::vector<GroupStrength> groups;
  std::set<std::string> variants;
  for (auto const& [key, members] : groups_of(runs)) {
    GroupStrength const group = strength_of(key.first, runs, members);
    if (!group.at_peak && !group.residual) continue;
    figures += group.figures;
    groups.push_back(group);
    if (key.first > 0) variants.insert(key.second);
  }
  if (groups.size() > 1 && variants.size() < 2) figures += strength_against_saturation(groups);
  return figures;
}

}  // namespace clathra
