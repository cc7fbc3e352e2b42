/// Figures of curves on the page on a paper.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "domain/scene/hydrate.hpp"
#include "io/report/laboratory_overlay.hpp"
#include "io/report/markup.hpp"
#include "io/report/paper_figures.hpp"
#include "io/report/strength.hpp"
#include "io/results/shown_units.hpp"

namespace clathra {
namespace {

/// The groups of these names in this order, with strokes of their own.
std::vector<GroupCurves> chosen(Reproduction const& r, std::vector<GroupCurves> const& all, PaperSeries const& series) {
  std::vector<GroupCurves> groups;
  for (std::string const& name : series.groups) {
    auto const found = std::find_if(all.begin(), all.end(), [&](GroupCurves const& g) { return g.name == name; });
    if (found == all.end()) continue;
    groups.push_back(*found);
    groups.back().stroke = run_stroke(groups.size() - 1);
    groups.back().name = label_of(r.paper, name);
  }
  return groups;
}

/// Points of the user's laboratory of these tests.
std::vector<Curve> laboratory_curves(Reproduction const& r, ShownBand const& what, PaperSeries const& series) {
  if (!r.data) return {};
  std::vector<PageTest> tests;
  for (std::string const& name : series.groups) tests.push_back(page_test(stated_scene(r.paper, *group_of(r.paper, name))));
  return LaboratoryOverlay(*r.data, tests).over(axial_strain, what.axis);
}

}  // namespace

std::string beside_words(std::string const& words, std::string const& ours) {
  return (words.empty() ? "" : "The paper: " + words) + (words.empty() || ours.empty() ? "" : " ") +
         (ours.empty() ? "" : "Here: " + ours);
}

Piece curves_figure(Reproduction const& r, PaperFigure const& f, PaperSeries const& series, std::vector<GroupCurves> const& all) {
  auto const* const band =
      std::find_if(std::begin(shown_bands), std::end(shown_bands), [&](ShownBand const& one) { return one.column == f.column; });
  ShownBand what = band == std::end(shown_bands) ? contacts_band : *band;
  std::string const heading = filled(f.title, {{"series", series.label}}), caption = beside_words(f.words, f.ours);
  what.heading = heading.c_str();
  what.caption = caption.c_str();
  PaperSeries const in_order = placed(r.paper, series, r.d50);
  return overlay(chosen(r, all, in_order), what, laboratory_curves(r, what, in_order));
}

Piece critical_thickness_figure(Reproduction const& r, PaperFigure const& f) {
  Plot plot;
  Curve law{"Eq. 3", {}, {}, run_stroke(0)}, images{"images", {}, {}, {colours::vermilion, "1 6"}, true};
  for (int i = 0; i <= 500; ++i) {
    law.x.push_back(0.2 * i);
    law.y.push_back(critical_thickness_ratio(i / 500.0));
  }
  for (ThicknessImage const& image : r.paper.images) {
    images.x.push_back(percent * image.saturation);
    images.y.push_back(image.thickness / image.d50);
  }
  plot.title = f.title;
  plot.description = "Critical thickness over d50 against saturation.";
  plot.x = {{"saturation [%]", "saturation_pct"}, 0, 100};
  plot.y = {{"h_max / d50", "critical_thickness_over_d50"}, 0, 0.12};
  plot.curves = {law, images};
  return figure(plot.title, drawing(plot) + legend(plot.curves), beside_words(f.words, f.ours));
}

Piece bond_strength_figure(Reproduction const& r, PaperFigure const& f, PaperSeries const& series) {
  constexpr int points = 200;
  bool const shear = f.kind == FigureKind::bond_shear_strength;
  Plot plot;
  Range forces, strengths;
  for (std::size_t k = 0; k < series.groups.size(); ++k) {
    auto const group = std::find_if(r.study.groups.begin(), r.study.groups.end(),
                                    [&](StudyGroup const& one) { return one.name == series.groups[k]; });
    if (group == r.study.groups.end()) continue;
    Scene const scene = member_scene(r.study, *group, r.study.seeds.front()).scene;
    Curve curve{place_name(r.paper, series, k) + " " + series.unit, {}, {}, run_stroke(plot.curves.size())};
    BondCard const card = evaluate_bond(scene, r.d50, r.d50 / 2, r.d50 / 2, 0, 0);
    for (int i = 0; i <= points; ++i) {
      double const normal = -card.R_t + (card.R_t + card.R_c) * i / points;
      BondCard const bond = evaluate_bond(scene, r.d50, r.d50 / 2, r.d50 / 2, 0, normal);
      curve.x.push_back(normal);
      curve.y.push_back(shear ? bond.R_s : bond.R_r_per_length * bond.moment_length);
    }
    forces.include(curve.x);
    strengths.include(curve.y);
    plot.curves.push_back(std::move(curve));
  }
  if (plot.curves.empty()) return "";
  plot.title = f.title;
  plot.x = forces.axis({"normal force of the bond [N/m]", "normal_force_N_per_m"});
  plot.y = strengths.axis({f.axis.c_str(), shear ? "R_s_N_per_m" : "R_r_Nm_per_m"});
  return figure(f.title, drawing(plot) + legend(plot.curves), beside_words(f.words, f.ours));
}

Piece mohr_circles(Reproduction const& r) {
  std::vector<RunResults> first;
  for (std::size_t i = 0; i < r.members.size(); ++i) {
    StudyGroup const& group = r.study.groups[r.members[i].group];
    auto const of_material = std::count_if(r.study.groups.begin(), r.study.groups.end(),
                                           [&](StudyGroup const& other) { return other.material == group.material; });
    if (r.members[i].state == MemberState::finished && r.members[i].seed == r.study.seeds.front() && of_material > 1)
      first.push_back(read_run(r.folders[i]));
  }
  return strength_figures(first);
}

Piece envelopes_figure(Reproduction const& r, PaperFigure const& f) {
  std::string const number = f.number.name();
  Variable const axis{f.axis.c_str(), number.c_str(), f.number.factor};
  std::vector<Curve> const points =
      r.data ? LaboratoryOverlay(*r.data, {PageTest()}).over(hydrate_saturation, axis) : std::vector<Curve>();
  return strength_figure(envelopes_by_material(r.study, r.members), f.title, axis, points);
}

}  // namespace clathra
