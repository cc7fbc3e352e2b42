#include "io/report/strength.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

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
    caption += fmt::format("Line: Mohr-Coulomb envelope τ = c + σ tan φ with c = {:.3g} MPa and φ = {:.1f}°", cohesion,
                           fit->friction_angle * 180 / half_turn);
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

}  // namespace

std::optional<Envelope> fitted_envelope(std::vector<FailureStress> const& tests) {
  double const count = static_cast<double>(tests.size());
  double mean1 = 0, mean3 = 0, s33 = 0, s13 = 0;
  for (FailureStress const& t : tests) mean1 += t.sigma1 / count, mean3 += t.sigma3 / count;
  for (FailureStress const& t : tests) {
    s33 += (t.sigma3 - mean3) * (t.sigma3 - mean3);
    s13 += (t.sigma1 - mean1) * (t.sigma3 - mean3);
  }
  constexpr double same = 1e-3;  // confining stresses closer than this are one
  if (!(s33 > same * same * mean3 * mean3 * count)) return std::nullopt;
  double const slope = s13 / s33;
  if (!(slope > 0)) return std::nullopt;
  return Envelope{(mean1 - slope * mean3) / (2 * std::sqrt(slope)), std::asin((slope - 1) / (slope + 1))};
}

std::string strength_figures(std::vector<RunResults> const& runs) {
  std::string figures;
  for (auto const& [key, members] : groups_of(runs)) {
    std::vector<FailureStress> peaks, residuals;
    std::vector<Curve> at_peak, at_residual;
    for (std::size_t const i : members) {
      TestNumbers const n = test_numbers(runs[i].history);
      peaks.push_back(peak_stress(n));
      residuals.push_back(residual_stress(n));
      at_peak.push_back(circle(peaks.back(), run_label(runs[i]), run_stroke(i)));
      at_residual.push_back(circle(residuals.back(), run_label(runs[i]), run_stroke(i)));
    }
    auto const [low, high] =
        std::minmax_element(peaks.begin(), peaks.end(), [](auto const& a, auto const& b) { return a.sigma3 < b.sigma3; });
    if (!(high->sigma3 > low->sigma3 * 1.02)) continue;
    std::string const heading = key.first > 0 ? fmt::format("Strength at {:g} % hydrate", static_cast<double>(key.first) * 1e-4)
                                              : "Strength of clean sand";
    figures += mohr_figure(at_peak, peaks, heading, "at the peak");
    figures += mohr_figure(at_residual, residuals, heading, "in the residual state");
  }
  return figures;
}

}  // namespace clathra
