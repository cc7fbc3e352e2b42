#include "io/report/paper_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "domain/scene/hydrate.hpp"
#include "io/formats/text_file.hpp"
#include "io/report/markup.hpp"
#include "io/report/paper_figures.hpp"

namespace clathra {
namespace {

std::string claims_table(std::vector<Claim> const& claims) {
  std::vector<std::vector<std::string>> rows;
  for (Claim const& claim : claims) {
    auto const inside =
        std::count_if(claim.parts.begin(), claim.parts.end(), [](ClaimPart const& p) { return p.mean_is_inside(); });
    rows.push_back(
        {"(" + claim.id + ")", claim.words, name_of(claim.verdict()), fmt::format("{} of {}", inside, claim.parts.size())});
  }
  return table({"claim", "in words", "verdict", "means within the bounds"}, rows);
}

std::string claim_parts(std::vector<Claim> const& claims) {
  std::string text;
  for (Claim const& claim : claims) {
    std::vector<std::vector<std::string>> rows;
    for (ClaimPart const& p : claim.parts)
      rows.push_back({p.what, with_minus(mean_text(p)), p.unit, with_minus(bounds_text(p)), name_of(p.verdict())});
    text += fmt::format("<details><summary>({}) {}: {}</summary>\n", claim.id, escaped(claim.words), name_of(claim.verdict())) +
            table({"number", "mean and 95 % interval", "unit", "claimed", "verdict"}, rows) + "</details>\n";
  }
  return text;
}

/// Tables 1 and 2: thickness of hydrate between grains in two images [um].
std::string image_tables() {
  return "<h3>Tables 1 and 2: Thickness in images</h3>\n" +
         table({"saturation", "natural sizes as printed [um]", "mean as stated", "h / d50", "Eq. 3"},
               {{"50 %", "16.7, 15.3, 15.3, 14.8, 16.4, 15.3, 16.1, 15.1", "15.6 um", "0.078",
                 fmt::format("{:.4f}", critical_thickness_ratio(0.5))},
                {"30 %", "7.75, 7.75, 8.28, 9.11 (the other eight are those of Table 1 again)", "8.13 um", "0.0407",
                 fmt::format("{:.4f}", critical_thickness_ratio(0.3))},
                {"86.3 %", "one mean", "30.7 um", "0.0959", fmt::format("{:.4f}", critical_thickness_ratio(0.863))}});
}

std::string parameter_table(Reproduction const& r) {
  Scene const& s = r.scene;
  return "<h3>Table 3: Parameters</h3>\n" +
         table({"parameter", "paper", "here"},
               {{"particles", "20,000", r.card.facts.at("particles")},
                {"void ratio", "0.24", fmt::format("{:g}", s.specimen.void_ratio > 0 ? s.specimen.void_ratio : 0.24)},
                {"density", "2.6 g/cm3", fmt::format("{:g} g/cm3", s.grains.density / 1000)},
                {"k_n, k_s", "0.3, 0.2 GPa",
                 fmt::format("{:g}, {:g} GPa", s.grains.normal_stiffness * 1e-9, s.grains.shear_stiffness * 1e-9)},
                {"friction", "0.5", fmt::format("{:g}", s.grains.friction)},
                {"rolling width factor beta", "2", fmt::format("{:g}", s.grains.rolling_width_factor)},
                {"E_m", "0.289 GPa", fmt::format("{:.3g} GPa", evaluate_bond(s, r.d50, r.d50 / 2, r.d50 / 2, 0, 0).E_m * 1e-9)},
                {"confining stress", "1, 2, 3 MPa", "1, 2, 3 MPa"}});
}

std::string facts(Scorecard const& card) {
  std::string text;
  for (auto const& [name, value] : card.facts) text += fmt::format("{}: {}. ", escaped(name), escaped(value));
  return "<p class=\"lead\">" + text + "</p>\n";
}

}  // namespace

std::vector<Figure> write_paper_report(Reproduction const& r, std::filesystem::path const& html) {
  std::vector<GroupCurves> const curves = curves_of_groups(r.study, r.members, r.folders);
  Piece body = "<h1>" + escaped(r.card.title) + "</h1>\n" + facts(r.card);
  body +=
      "<h2>Scorecard</h2>\n<p>" + escaped(tally(r.card.claims)) +
      ". Pass and fail: the 95 % interval of the mean over the seeds, differences paired by specimen, lies inside, outside the "
      "bounds; undetermined: neither.</p>\n" +
      claims_table(r.card.claims) + claim_parts(r.card.claims);
  body += "<h2>What goes in</h2>\n" + image_tables() + parameter_table(r) +
          side_by_side(critical_thickness_figure() + envelope_figure(r));
  body += "<h2>Stress and volume</h2>\n" + side_by_side(test_curve_figures(r, curves));
  body += "<h2>Strength (Figures 13 and 14)</h2>\n" + side_by_side(strength_part(r));
  body += "<h2>55 % at 3 MPa</h2>\n" + side_by_side(one_test_figures(r)) + picture_figures(r);
  if (r.data) body += "<p class=\"soft\">Black points: " + escaped(r.data->source) + ".</p>\n";
  replace_text_file(html, page(r.card.title, body.html));
  return std::move(body.figures);
}

}  // namespace clathra
