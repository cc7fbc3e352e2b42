#include "io/report/paper_report.hpp"

#include <fmt/format.h>

#include <algorithm>

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
    text += fmt::format("<details><summary>({}) {}: {}</summary>\n<p class=\"soft\">{}</p>\n", claim.id, escaped(claim.words),
                        name_of(claim.verdict()), escaped(source_text(claim))) +
            table({"number", "mean and 95 % interval", "unit", "claimed", "verdict"}, rows) + "</details>\n";
  }
  return text;
}

std::string facts(Scorecard const& card) {
  std::string text;
  for (auto const& [name, value] : card.facts) text += fmt::format("{}: {}. ", escaped(name), escaped(value));
  return "<p class=\"lead\">" + text + "</p>\n";
}

/// A figure of each of its series, or of what it shows else.
std::string drawn(Reproduction const& r, PaperFigure const& f, std::vector<GroupCurves> const& curves) {
  if (f.kind == FigureKind::critical_thickness) return critical_thickness_figure(r, f);
  if (f.kind == FigureKind::mohr_circles) return mohr_circles(r);
  if (f.kind == FigureKind::envelopes) return envelopes_figure(r, f);
  std::string figures;
  for (PaperSeries const& series : f.series)
    if (f.kind == FigureKind::curves)
      figures += curves_figure(r, f, series, curves);
    else if (f.kind == FigureKind::bond_shear_strength || f.kind == FigureKind::bond_rolling_strength)
      figures += bond_strength_figure(r, f, series);
    else
      figures += picture_figure(f, shown_test(r, series.groups.front()));
  return figures;
}

std::string table_of(Reproduction const& r, PaperFigure const& f) {
  std::vector<std::vector<std::string>> rows = f.rows;
  for (std::vector<std::string>& row : rows)
    for (std::string& cell : row) cell = cell_text(cell, r.scene, r.d50);
  return "<h3>" + escaped(f.title) + "</h3>\n" + table(rows.front(), {rows.begin() + 1, rows.end()});
}

/// Figures stand side by side where nothing wide comes between them.
std::string section_of(Reproduction const& r, PaperSection const& section, std::vector<GroupCurves> const& curves) {
  std::string body = section.heading.empty() ? "" : "<h2>" + escaped(section.heading) + "</h2>\n", row;
  auto const end_row = [&] {
    if (!row.empty()) body += side_by_side(row);
    row.clear();
  };
  for (PaperFigure const& f : section.figures) {
    bool const wide = f.kind == FigureKind::table || f.kind >= FigureKind::bonds;
    if (wide) end_row();
    (wide ? body : row) += f.kind == FigureKind::table ? table_of(r, f) : drawn(r, f, curves);
  }
  end_row();
  return body;
}

}  // namespace

void write_paper_report(Reproduction const& r, std::filesystem::path const& html) {
  std::vector<GroupCurves> const curves = curves_of_groups(r.study, r.members, r.folders);
  std::string body = "<h1>" + escaped(r.card.title) + "</h1>\n" + facts(r.card);
  body +=
      "<h2>Scorecard</h2>\n<p>" + escaped(tally(r.card.claims)) +
      ". Pass and fail: the 95 % interval of the mean over the seeds, differences paired by specimen, lies inside, outside the "
      "bounds; undetermined: neither.</p>\n" +
      claims_table(r.card.claims) + claim_parts(r.card.claims);
  for (PaperSection const& section : r.paper.sections) body += section_of(r, section, curves);
  if (r.data) body += "<p class=\"soft\">Black points: " + escaped(r.data->source) + ".</p>\n";
  replace_text_file(html, page(r.card.title, body));
}

}  // namespace clathra
