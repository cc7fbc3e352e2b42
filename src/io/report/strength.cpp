#include "io/report/strength.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "io/report/curves.hpp"
#include "io/report/markup.hpp"
#include "io/results/interval_text.hpp"
#include "io/results/shown_units.hpp"
#include "io/results/strength_groups.hpp"
#include "io/results/tested_material.hpp"
#include "io/scene/schema.hpp"

namespace clathra {
namespace {

/// "a" or "a, b and c"
std::string listed(std::vector<std::string> const& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return text;
}

std::vector<std::string> names_of(std::vector<RunResults> const& runs, std::vector<std::size_t> const& members) {
  std::vector<std::string> names;
  for (std::size_t const i : members) names.push_back(runs[i].name);
  return names;
}

/// The upper half of a Mohr circle.
Curve circle(FailureStress const& at, std::string name, Stroke const& stroke) {
  constexpr int segments = 72;
  Curve curve{std::move(name), {}, {}, stroke};
  double const centre = (at.sigma1 + at.sigma3) / 2, radius = (at.sigma1 - at.sigma3) / 2;
  for (int i = 0; i <= segments; ++i) {
    double const angle = std::numbers::pi * i / segments;
    curve.x.push_back(centre - radius * std::cos(angle));
    curve.y.push_back(radius * std::sin(angle));
  }
  return curve;
}

/// An envelope is drawn a little beyond the middle of the largest circle [Pa].
double end_of_line(std::vector<SeedTest> const& tests) {
  double end = 0;
  for (SeedTest const& t : tests) end = std::max(end, 0.7 * t.at.sigma1 + 0.3 * t.at.sigma3);
  return end;
}

/// c and phi with their intervals over the seeds, or the errors of the fit, if these are known.
std::string envelope_numbers(PairedStrength const& strength) {
  Envelope const& fit = *strength.envelope;
  std::string cohesion = fmt::format("{:.3g}", fit.cohesion * mega), angle = fmt::format("{:.1f}", fit.friction_angle * degrees);
  if (strength.cohesion) {
    cohesion = interval_text(*strength.cohesion, mega);
    angle = interval_text(*strength.friction_angle, degrees);
  } else if (fit.errors) {
    cohesion = with_error(fit.cohesion * mega, fit.errors->cohesion * mega);
    angle = with_error(fit.friction_angle * degrees, fit.errors->friction_angle * degrees);
  }
  return fmt::format("c = {} MPa and φ = {}°", with_minus(cohesion), with_minus(angle));
}

/// What an envelope rests on.
std::string basis_of(PairedStrength const& strength, TestStresses const& tests) {
  if (strength.cohesion)
    return fmt::format(", the mean of the envelopes of {} seeds (± half of the 95 % interval).", strength.seeds.size());
  if (!strength.envelope->errors) return ", which touches two circles.";
  std::size_t const fitted =
      strength.seeds.empty()
          ? tests.reached.size()
          : static_cast<std::size_t>(std::count_if(tests.reached.begin(), tests.reached.end(),
                                                   [&](SeedTest const& test) { return test.seed == strength.seeds.front(); }));
  return fmt::format(", fitted to {} tests (± standard error, R² {:.4f}).", fitted, strength.envelope->errors->r_squared);
}

/// c and phi, or why there are none.
std::string envelope_text(PairedStrength const& strength, TestStresses const& tests) {
  std::string text, why;
  if (!tests.rising.empty())
    why = fmt::format(
        "he deviator stress of {} still rises where the test ends; the largest so far is drawn, which is no strength.",
        listed(tests.rising));
  if (strength.envelope) {
    text = "Line: Mohr-Coulomb envelope τ = c + σ tan φ with " + envelope_numbers(strength);
    text += basis_of(strength, tests);
    if (!strength.seeds.empty() && !strength.incomplete.empty())
      text += fmt::format(" Seeds without a test at each confining stress are left out: {} of {}.", strength.incomplete.size(),
                          strength.seeds.size() + strength.incomplete.size());
    return why.empty() ? text : text + " It leaves out what has no peak: t" + why;
  }
  return why.empty() ? "They have no common Mohr-Coulomb envelope." : "c and φ are not given: t" + why;
}

Piece mohr_figure(std::vector<Curve> circles, TestStresses const& tests, PairedStrength const& strength,
                  std::string const& heading, std::string const& which) {
  Plot plot;
  Range sigma, tau;
  for (FailureStress const& test : tests.all) {
    sigma.include(test.sigma1);
    tau.include((test.sigma1 - test.sigma3) / 2 * 1.12);
  }
  plot.title = heading + ", " + which;
  plot.curves = std::move(circles);
  plot.x = sigma.axis({"normal stress σ [MPa]", "sigma_Pa", mega});
  if (std::optional<Envelope> const& fit = strength.envelope) {
    double const slope = std::tan(fit->friction_angle), cohesion = fit->cohesion;
    double const from = std::max(0.0, -cohesion / slope), to = end_of_line(tests.reached);
    plot.curves.push_back({"envelope", {from, to}, {cohesion + slope * from, cohesion + slope * to}, {colours::black, "", 1.8}});
    tau.include(plot.curves.back().y);
  }
  std::string const caption = "Mohr circles of the stresses " + which + ". " + envelope_text(strength, tests);
  plot.y = tau.axis({"shear stress τ [MPa]", "tau_Pa", mega});
  plot.y.from = 0;
  plot.height = height_for_equal_scales(plot.x, plot.y);
  plot.description = caption;
  return figure(plot.title, drawing(plot) + legend(plot.curves), caption);
}

/// The Mohr circles of the tests of a group.
std::vector<Curve> circles_of(TestStresses const& tests, StrengthGroup const& group, std::vector<RunResults> const& runs) {
  std::vector<Curve> circles;
  for (std::size_t k = 0; k < tests.all.size(); ++k) {
    std::size_t const run = group.members[k];
    circles.push_back(circle(tests.all[k], run_label(runs[run]), run_stroke(run)));
  }
  return circles;
}

/// The circles of a group. Where others have the same saturation the heading says what it differs in from them.
Piece circle_figures(StrengthGroup const& strength, std::vector<StrengthGroup> const& all, std::vector<RunResults> const& runs) {
  double const saturation = strength.saturation;
  std::vector<SceneValues> same;
  for (StrengthGroup const& other : all)
    if (other.saturation == saturation) same.push_back(other.material);
  std::string heading = saturation > 0 ? fmt::format("Strength at {:g} % hydrate", saturation) : "Strength of clean sand";
  if (std::string const words = in_words(strength.material, differing_keys(same)); !words.empty()) heading += ", " + words;
  return mohr_figure(circles_of(strength.peaks, strength, runs), strength.peaks, strength.at_peak, heading, "at the peak") +
         mohr_figure(circles_of(strength.residuals, strength, runs), strength.residuals, strength.residual, heading,
                     "in the residual state");
}

/// Groups that differ in nothing but the saturation, in its order.
struct Series {
  SceneValues material;  ///< without the saturation
  std::vector<StrengthGroup const*> points;
};

/// Whether clean sand is the sand between the bonds of the other.
bool is_sand_of(SceneValues const& clean, SceneValues const& bonded) {
  return std::all_of(clean.begin(), clean.end(), [&](auto const& entry) {
    auto const found = bonded.find(entry.first);
    return entry.first == saturation_key || (found != bonded.end() && found->second == entry.second);
  });
}

bool has_envelope(StrengthGroup const& strength) { return strength.at_peak.envelope || strength.residual.envelope; }

std::vector<Series> series_of(std::vector<StrengthGroup> const& groups) {
  std::vector<Series> all;
  for (StrengthGroup const& strength : groups) {
    if (strength.saturation == 0 || !has_envelope(strength)) continue;
    SceneValues material = strength.material;
    material.erase(saturation_key);
    auto same = std::find_if(all.begin(), all.end(), [&](Series const& series) { return series.material == material; });
    if (same == all.end()) same = all.insert(all.end(), {std::move(material), {}});
    same->points.push_back(&strength);
  }
  for (Series& series : all)
    for (StrengthGroup const& strength : groups)
      if (strength.saturation == 0 && has_envelope(strength) && is_sand_of(strength.material, series.material))
        series.points.insert(series.points.begin(), &strength);
  std::erase_if(all, [](Series const& series) { return series.points.size() < 2; });
  return all;
}

/// One number of the envelopes against the saturation, at the peak and in the residual state.
Piece saturation_figure(std::vector<Series> const& all, std::string const& heading, Variable const& axis,
                        double (*number)(Envelope const&)) {
  Plot plot;
  plot.title = heading + " against hydrate saturation";
  Range saturations, values;
  std::vector<SceneValues> materials;
  for (Series const& series : all) materials.push_back(series.material);
  std::vector<std::string> const different = differing_keys(materials);
  for (std::size_t k = 0; k < 2 * all.size(); ++k) {
    Series const& series = all[k / 2];
    bool const peak = k % 2 == 0;
    Rgb const colour = all.size() > 1 ? run_stroke(k / 2).colour : peak ? colours::vermilion : colours::blue;
    std::string const words = in_words(series.material, different);
    Curve curve{
        (words.empty() ? "" : words + ", ") + (peak ? "at the peak" : "residual"), {}, {}, {colour, peak ? "" : "8 3"}, true};
    for (StrengthGroup const* const point : series.points) {
      std::optional<Envelope> const& envelope = (peak ? point->at_peak : point->residual).envelope;
      if (!envelope) continue;
      curve.x.push_back(point->saturation);
      curve.y.push_back(number(*envelope));
      plot.description += fmt::format("{} % hydrate, {}: {:.3g}. ", curve.x.back(), curve.name, curve.y.back() * axis.factor);
    }
    saturations.include(curve.x);
    values.include(curve.y);
    plot.curves.push_back(std::move(curve));
  }
  plot.x = saturations.axis(hydrate_saturation);
  plot.y = values.axis(axis);
  return figure(
      plot.title, drawing(plot) + legend(plot.curves),
      "From the Mohr-Coulomb envelopes above, one for each saturation. A line joins materials that differ in nothing but "
      "the saturation.");
}

Piece strength_against_saturation(std::vector<StrengthGroup> const& groups) {
  std::vector<Series> const all = series_of(groups);
  if (all.empty()) return "";
  return saturation_figure(all, "Cohesion", {"cohesion c [MPa]", "cohesion_Pa", mega},
                           [](Envelope const& e) { return e.cohesion; }) +
         saturation_figure(all, "Friction angle", {"friction angle φ [°]", "friction_angle_deg"},
                           [](Envelope const& e) { return e.friction_angle * degrees; });
}

/// Says why runs of one saturation at several confining stresses are not all in one figure.
std::string note_on_unlike_runs(std::vector<RunResults> const& runs, std::vector<StrengthGroup> const& groups) {
  std::map<double, std::vector<StrengthGroup const*>> by_saturation;
  for (StrengthGroup const& group : groups) by_saturation[group.saturation].push_back(&group);
  std::string note;
  for (auto const& [saturation, unlike] : by_saturation) {
    std::set<double> stresses;
    std::vector<SceneValues> materials;
    for (StrengthGroup const* const group : unlike) {
      materials.push_back(group->material);
      for (std::size_t const i : group->members) stresses.insert(runs[i].number("/scene/test/confining_stress").value_or(0));
    }
    if (unlike.size() < 2 || stresses.size() < 2) continue;
    std::vector<std::string> const different = differing_keys(materials);
    std::string parts;
    for (StrengthGroup const* const group : unlike)
      parts += (parts.empty() ? "" : "; ") + listed(names_of(runs, group->members)) + " (" +
               in_words(group->material, different) + ")";
    note += fmt::format("The tests {} differ in more than confining stress and seed and have no common envelope: {}. ",
                        saturation > 0 ? fmt::format("at {:g} % hydrate", saturation) : "of clean sand", parts);
  }
  return note.empty() ? "" : "<p class=\"soft\">" + escaped(note) + "</p>\n";
}

}  // namespace

Piece strength_figures(std::vector<RunResults> const& runs) {
  std::vector<StrengthGroup> const groups = strength_groups(runs);
  std::vector<StrengthGroup> drawn;
  for (StrengthGroup const& group : groups)
    if (group.at_several_stresses()) drawn.push_back(group);
  Piece figures;
  for (StrengthGroup const& strength : drawn) figures += circle_figures(strength, drawn, runs);
  return std::move(figures) + strength_against_saturation(drawn) + note_on_unlike_runs(runs, groups);
}

}  // namespace clathra
