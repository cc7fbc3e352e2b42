#include "io/report/study_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <span>

#include "io/formats/text_file.hpp"
#include "io/report/group_curves.hpp"
#include "io/report/markup.hpp"

namespace clathra {
namespace {

constexpr double percent = 100, mega = 1e-6;
constexpr std::size_t most_seeds_drawn = 10, most_small_figures = 60;  // of one kind; a page stays below a few megabytes
constexpr char saturation_key[] = "hydrate.saturation";
constexpr std::size_t multiplied = 3;  // of the shown bands are also shown group by group

/// One group in a small figure: each seed thin, their mean and its band.
Piece small_figure(GroupCurves const& group, ShownBand const& what, Axis const& x, Axis const& y) {
  Plot plot;
  SeedBand const& band = group.bands[what.column];
  plot.title = group.name + ": " + what.heading;
  plot.x = x;
  plot.y = y;
  plot.areas.push_back(area_of(group, what));
  std::size_t const drawn = std::min(band.seeds.size(), most_seeds_drawn);
  for (std::size_t i = 0; i < drawn; ++i)
    plot.curves.push_back(
        {fmt::format("{}, seed {} of {}", group.name, i + 1, drawn), band.eps1, band.seeds[i], {Rgb{140, 140, 140}, "", 1.2}});
  plot.curves.push_back(mean_of(group, what));
  plot.curves.back().stroke.dash.clear();
  Piece piece = figure(group.name, drawing(plot), "");
  piece.figures.back().heading = plot.title;
  return piece;
}

/// All groups beside each other on the same axes.
Piece small_multiples(std::vector<GroupCurves> const& groups, ShownBand const& what) {
  Range strains, values;
  for (GroupCurves const& group : groups)
    for (std::vector<double> const& seed : group.bands[what.column].seeds)
      strains.include(group.bands[what.column].eps1), values.include(seed);
  Axis const x = strains.exact_axis(axial_strain), y = axis_of(what, values);
  Piece figures;
  for (std::size_t i = 0; i < std::min(groups.size(), most_small_figures); ++i)
    if (says_something(groups[i], what)) figures += small_figure(groups[i], what, x, y);
  return figures.empty() ? "" : "<div class=\"multiples\">\n" + std::move(figures) + "</div>\n";
}

struct Column {
  char const *number, *heading, *unit;
  double factor;
};

std::string table(std::vector<GroupNumbers> const& groups, std::vector<Column> const& columns, char const* what) {
  std::string head = fmt::format("<th>{}</th><th>seeds</th>", what), rows;
  std::vector<Column> used;
  for (Column const& column : columns)
    if (std::any_of(groups.begin(), groups.end(), [&](GroupNumbers const& g) { return g.values.contains(column.number); }))
      used.push_back(column);
  for (Column const& column : used)
    head += fmt::format("<th>{}{}</th>", column.heading,
                        *column.unit ? fmt::format(" <span class=\"unit\">[{}]</span>", column.unit) : "");
  for (GroupNumbers const& group : groups) {
    rows += fmt::format("<tr><th>{}</th><td data-run=\"seeds\">{}</td>", escaped(group.name), group.seeds.size());
    for (Column const& column : used) {
      auto const found = group.values.find(column.number);
      std::string cell = found == group.values.end() ? "–" : with_interval(found->second, column.factor);
      if (found != group.values.end() && found->second.size() != group.seeds.size())
        cell += fmt::format(" <span class=\"unit\">({} seeds)</span>", found->second.size());
      rows += fmt::format("<td data-run=\"{} {}\">{}</td>", column.heading, column.unit, cell);
    }
    rows += "</tr>\n";
  }
  return "<div class=\"scroll several sure\"><table><thead><tr>" + head + "</tr></thead><tbody>\n" + rows +
         "</tbody></table></div>\n";
}

Piece strength_part(std::vector<GroupNumbers> const& materials) {
  if (materials.empty()) return "";
  Piece text = "<h2>Strength</h2>\n" + table(materials,
                                             {{"peak_cohesion_Pa", "c at the peak", "MPa", mega},
                                              {"peak_friction_angle_deg", "φ at the peak", "°", 1},
                                              {"peak_r_squared", "R²", "", 1},
                                              {"peak_curvature_per_Pa", "curvature", "1/MPa", 1e6},
                                              {"residual_cohesion_Pa", "residual c", "MPa", mega},
                                              {"residual_friction_angle_deg", "residual φ", "°", 1}},
                                             "material");
  return text + side_by_side(strength_figure(materials, "Cohesion", {"cohesion c [MPa]", "peak_cohesion_Pa", mega}) +
                             strength_figure(materials, "Friction angle", {"friction angle φ [°]", "peak_friction_angle_deg"}));
}

/// The keys that have several values, in words.
std::string varied_keys(Study const& study) {
  std::string text;
  for (std::string const& key : study.keys)
    if (groups_differ_in(study, key)) text += (text.empty() ? "" : ", ") + key;
  return text.empty() ? "their seed only" : text;
}

/// A text without its numbers: warnings that differ in numbers alone are one warning to the reader.
std::string without_numbers(std::string const& text) {
  static std::regex const number("[0-9]+([.][0-9]+)?(e[+-]?[0-9]+)?");
  return std::regex_replace(text, number, "#");
}

/// What several members say in the same words.
struct SharedWarning {
  std::string first;  // as the first member says it
  bool numbers_differ = false;
  std::vector<std::string> members;
};

/// Each warning once, with the members that have it; of those that differ in numbers alone, the first.
std::string warnings(Study const& study, std::vector<MemberResult> const& members) {
  constexpr std::size_t most_named = 5;
  std::vector<SharedWarning> all;
  std::map<std::string, std::size_t> place;
  for (MemberResult const& member : members)
    for (std::string const& text : member.warnings) {
      auto const [at, is_new] = place.try_emplace(without_numbers(text), all.size());
      if (is_new) all.push_back({text, false, {}});
      SharedWarning& warning = all[at->second];
      warning.numbers_differ |= text != warning.first;
      warning.members.push_back(member_name(study.groups[member.group], member.seed));
    }
  std::string items;
  for (SharedWarning const& warning : all) {
    std::span const named = std::span(warning.members).first(std::min(warning.members.size(), most_named));
    std::string who = fmt::format("{}", fmt::join(named, ", "));
    if (named.size() < warning.members.size()) who += fmt::format(" and {} more", warning.members.size() - named.size());
    if (warning.numbers_differ) who += " (each with its own numbers, in its own report; here the first)";
    items += "<li>" + escaped(who + ": " + warning.first) + "</li>\n";
  }
  return items.empty() ? "" : "<div class=\"warn\"><b>Warnings of members</b><ul>\n" + items + "</ul></div>\n";
}

std::string problems(Study const& study, std::vector<MemberResult> const& members) {
  std::string items;
  std::size_t waiting = 0;
  for (MemberResult const& member : members) {
    waiting += member.state == MemberState::waiting ? 1 : 0;
    if (member.state == MemberState::failed || member.state == MemberState::refused)
      items += "<li>" + escaped(member_name(study.groups[member.group], member.seed) + ": " + member.message) + "</li>\n";
  }
  if (waiting > 0) items += fmt::format("<li>{} members are not finished</li>\n", waiting);
  return items.empty() ? "" : "<div class=\"warn\"><b>Members that are missing</b><ul>\n" + items + "</ul></div>\n";
}

std::vector<Column> result_columns() {
  return {{"peak_q_Pa", "peak q", "MPa", mega},
          {"peak_eps1", "at ε₁", "%", percent},
          {"secant_modulus_Pa", "E₅₀", "MPa", mega},
          {"residual_q_Pa", "residual q", "MPa", mega},
          {"largest_eps_v", "contraction", "%", percent},
          {"dilation_angle_deg", "ψ", "°", 1},
          {"end_bonds_intact_pct", "intact at the end", "%", 1}};
}

}  // namespace

std::vector<Figure> write_study_report(Study const& study, std::vector<MemberResult> const& members,
                                       std::vector<std::filesystem::path> const& folders, std::filesystem::path const& html) {
  std::vector<GroupNumbers> const groups = numbers_by_group(study, members);
  std::vector<GroupCurves> const curves = curves_of_groups(study, members, folders);
  auto const finished =
      std::count_if(members.begin(), members.end(), [](MemberResult const& m) { return m.state == MemberState::finished; });
  std::string const title = "Study " + study.file.stem().string();
  Piece body = "<h1>" + escaped(title) + "</h1>\n";
  body += fmt::format(
      "<p class=\"lead\">{} biaxial tests of {} groups, which differ in {}. Numbers are means over the seeds ± half of their 95 "
      "% "
      "confidence interval (Student t).</p>\n",
      finished, groups.size(), escaped(varied_keys(study)));
  body += problems(study, members) + warnings(study, members) + "<h2>Results</h2>\n" + table(groups, result_columns(), "group");
  Piece overlays, multiples;
  for (ShownBand const& what : shown_bands) overlays += overlay(curves, what);
  body += "<h2>Curves</h2>\n" + side_by_side(std::move(overlays)) + strength_part(envelopes_by_material(study, members));
  for (ShownBand const& what : std::span(shown_bands).first(multiplied))
    if (Piece small = curves.size() > 1 ? small_multiples(curves, what) : ""; !small.empty())
      multiples += fmt::format("<h3>{} over {}</h3>\n", what.axis.title, axial_strain.title) + std::move(small);
  if (!multiples.empty())
    body += fmt::format(
                "<h2>Each group</h2>\n<p class=\"soft\">Grey: single seeds, {} at most; colour: the mean of all and its "
                "interval.{}</p>\n",
                most_seeds_drawn,
                curves.size() > most_small_figures ? fmt::format(" Shown are the first {} groups.", most_small_figures) : "") +
            std::move(multiples);
  replace_text_file(html, page(title, body.html));
  return std::move(body.figures);
}

}  // namespace clathra
