/// Figures of curves on the page on Jiang et al. (2017).
#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "domain/scene/hydrate.hpp"
#include "io/report/markup.hpp"
#include "io/report/paper_figures.hpp"
#include "io/report/strength.hpp"

namespace clathra {
namespace {

constexpr double percent = 100, mega = 1e-6, micro = 1e6;
constexpr ShownBand const& stress_band = shown_bands[0];
constexpr ShownBand const& volume_band = shown_bands[1];

/// A figure of the paper: tests laid over each other.
struct TestFigure {
  std::string number, words;
  ShownBand const& what;
  std::vector<std::string> cells;
};

/// The groups of these names in this order, with strokes of their own.
std::vector<GroupCurves> chosen(std::vector<GroupCurves> const& curves, std::vector<std::string> const& cells) {
  std::vector<GroupCurves> groups;
  for (std::string const& cell : cells) {
    auto const found = std::find_if(curves.begin(), curves.end(), [&](GroupCurves const& g) { return g.name == cell; });
    if (found == curves.end()) continue;
    groups.push_back(*found);
    groups.back().stroke = run_stroke(groups.size() - 1);
    groups.back().name = paper_label(cell);
  }
  return groups;
}

/// Points of the user's laboratory of these tests.
std::vector<Curve> laboratory_curves(Reproduction const& r, TestFigure const& figure) {
  std::vector<Curve> curves;
  if (!r.data) return curves;
  bool const stress = figure.what.column == stress_band.column;
  for (LaboratorySeries const& series : r.data->series) {
    if (series.figure != (stress ? "q" : "eps_v")) continue;
    int const saturation = static_cast<int>(series.saturation + 0.5),
              confining = static_cast<int>(series.confining_stress * mega + 0.5);
    if (std::find(figure.cells.begin(), figure.cells.end(), paper_cell(saturation, confining)) == figure.cells.end()) continue;
    curves.push_back({series.name, series.x, series.y, {colours::black, "1 4"}, true});
  }
  return curves;
}

std::string heading_of(TestFigure const& figure) { return "Figure " + figure.number + ": " + figure.what.heading; }

Piece drawn(Reproduction const& r, std::vector<GroupCurves> const& curves, TestFigure const& wanted) {
  ShownBand what = wanted.what;
  std::string const heading = heading_of(wanted), caption = beside_words(wanted.words, "");
  what.heading = heading.c_str();
  what.caption = caption.c_str();
  return overlay(chosen(curves, wanted.cells), what, laboratory_curves(r, wanted));
}

std::vector<std::string> cells_over_saturation(PaperDesign const& design, int stress) {
  std::vector<std::string> cells{paper_cell(0, stress)};
  for (int const saturation : design.saturations) cells.push_back(paper_cell(saturation, stress));
  return cells;
}

std::vector<std::string> cells_over_stress(PaperDesign const& design, int saturation) {
  std::vector<std::string> cells;
  for (int const stress : design.stresses) cells.push_back(paper_cell(saturation, stress));
  return cells;
}

std::vector<std::string> cells_over_thickness(Reproduction const& r) {
  std::vector<std::pair<double, std::string>> places;
  for (int const s : r.design.saturations) places.emplace_back(critical_thickness_ratio(s / percent) * r.d50, paper_cell(s, 1));
  for (double const h : r.design.thicknesses) places.emplace_back(h, paper_cell(h));
  std::sort(places.begin(), places.end());
  std::vector<std::string> cells;
  for (auto const& [thickness, cell] : places) cells.push_back(cell);
  return cells;
}

/// Strength over the normal force of a bond without gap between grains of d50.
Piece strength_curves(Reproduction const& r, std::string const& title, Variable const& axis,
                      std::function<double(BondCard const&)> const& strength) {
  constexpr int points = 200;
  Plot plot;
  Range forces, strengths;
  for (int const saturation : r.design.saturations) {
    Scene scene = r.scene;
    scene.hydrate.saturation = saturation / percent;
    scene.bond.critical_thickness_from = CriticalThicknessFrom::saturation;
    Curve curve{fmt::format("{} %", saturation), {}, {}, run_stroke(plot.curves.size())};
    BondCard const card = evaluate_bond(scene, r.d50, r.d50 / 2, r.d50 / 2, 0, 0);
    for (int i = 0; i <= points; ++i) {
      double const normal = -card.R_t + (card.R_t + card.R_c) * i / points;
      curve.x.push_back(normal);
      curve.y.push_back(strength(evaluate_bond(scene, r.d50, r.d50 / 2, r.d50 / 2, 0, normal)));
    }
    forces.include(curve.x);
    strengths.include(curve.y);
    plot.curves.push_back(std::move(curve));
  }
  plot.title = title;
  plot.x = forces.axis({"normal force of the bond [N/m]", "normal_force_N_per_m"});
  plot.y = strengths.axis(axis);
  return figure(title, drawing(plot) + legend(plot.curves),
                beside_words("in the laboratory strength first rises with the normal force, then falls to nothing.",
                             "a bond across no gap between two grains of d50, by the law of these tests."));
}

}  // namespace

std::string beside_words(std::string const& words, std::string const& ours) {
  return "The paper: " + words + (ours.empty() ? "" : " Here: " + ours);
}

Piece critical_thickness_figure() {
  Plot plot;
  Curve law{"Eq. 3", {}, {}, run_stroke(0)};
  for (int i = 0; i <= 500; ++i) {
    law.x.push_back(0.2 * i);
    law.y.push_back(critical_thickness_ratio(i / 500.0));
  }
  Curve const images{"three images", {30, 50, 86.3}, {8.13 / 200, 15.6 / 200, 30.7 / 320}, {colours::vermilion, "1 6"}, true};
  plot.title = "Figure 6: Critical thickness";
  plot.description = "Critical thickness over d50 against saturation.";
  plot.x = {{"saturation [%]", "saturation_pct"}, 0, 100};
  plot.y = {{"h_max / d50", "critical_thickness_over_d50"}, 0, 0.12};
  plot.curves = {law, images};
  return figure(plot.title, drawing(plot) + legend(plot.curves),
                beside_words("it rises with saturation up to a constant value, from none at 20 %.", "Eq. 3 as printed."));
}

Piece envelope_figure(Reproduction const& r) {
  return strength_curves(r, "Figure 8b: Shear strength of a bond", {"R_s [N/m]", "R_s_N_per_m"},
                         [](BondCard const& c) { return c.R_s; }) +
         strength_curves(r, "Figure 8c: Rolling strength of a bond", {"R_r [N m/m]", "R_r_Nm_per_m"},
                         [](BondCard const& c) { return c.R_r_per_length * c.moment_length; });
}

Piece test_curve_figures(Reproduction const& r, std::vector<GroupCurves> const& curves) {
  std::vector<TestFigure> wanted{
      {"11", "peak q rises with saturation, and softening becomes more obvious; at 1 MPa the peak is at about 2 %.", stress_band,
       cells_over_saturation(r.design, 1)}};
  for (int const s : r.design.saturations)
    wanted.push_back(
        {fmt::format("12 ({} %)", s), "q rises with the confining stress.", stress_band, cells_over_stress(r.design, s)});
  for (int const stress : r.design.stresses)
    wanted.push_back({fmt::format("15 ({} MPa)", stress), "contraction, then dilation, the more obvious the more hydrate.",
                      volume_band, cells_over_saturation(r.design, stress)});
  for (int const s : r.design.saturations)
    wanted.push_back({fmt::format("16 ({} %)", s), "less dilation at a higher confining stress.", volume_band,
                      cells_over_stress(r.design, s)});
  if (!r.design.thicknesses.empty()) {
    std::vector<std::string> const cells = cells_over_thickness(r);
    wanted.push_back({"17a", "the peak rises with the critical thickness, ever less; residual q stays.", stress_band, cells});
    wanted.push_back({"17b", "dilation rises with the critical thickness.", volume_band, cells});
  }
  Piece figures;
  for (TestFigure const& one : wanted) figures += drawn(r, curves, one);
  return figures;
}

Piece strength_part(Reproduction const& r) {
  std::vector<RunResults> first;
  for (std::size_t i = 0; i < r.members.size(); ++i) {
    std::string const& cell = r.study.groups[r.members[i].group].name;
    if (r.members[i].state == MemberState::finished && r.members[i].seed == r.study.seeds.front() && !cell.starts_with("h"))
      first.push_back(read_run(r.folders[i]));
  }
  auto const points = [&](char const* which) {
    std::vector<Curve> curves;
    if (r.data)
      for (LaboratorySeries const& s : r.data->series)
        if (s.figure == which) curves.push_back({s.name, s.x, s.y, {colours::black, "1 4"}, true});
    return curves;
  };
  std::vector<GroupNumbers> materials = envelopes_by_material(r.study, r.members);
  std::erase_if(materials, [](GroupNumbers const& m) { return m.name.starts_with("h"); });
  return strength_figures(first) +
         strength_figure(materials, "Figure 14: Cohesion", {"cohesion c [MPa]", "peak_cohesion_Pa", mega}, points("c")) +
         strength_figure(materials, "Figure 14: Friction angle", {"friction angle φ [°]", "peak_friction_angle_deg"},
                         points("phi"));
}

Piece one_test_figures(Reproduction const& r) {
  Piece figures;
  std::vector<GroupCurves> curves = curves_of_groups(r.study, r.members, r.folders);
  for (TestFigure const& one :
       {TestFigure{"18a",
                   "the peak, at 3.38 %, is where contraction turns into dilation; 15.04 % is the critical state.",
                   stress_band,
                   {paper_cell(55, 3)}},
        TestFigure{"18a, volume", "contraction up to the peak, dilation after it.", volume_band, {paper_cell(55, 3)}},
        TestFigure{"19", "q falls from its peak as intact bonds become fewer.", paper_intact_band, {paper_cell(55, 3)}}})
    figures += drawn(r, curves, one);
  return figures;
}

}  // namespace clathra
