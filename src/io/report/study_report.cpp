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

#include "domain/measurement/test_numbers.hpp"
#include "domain/scene/loading_stage.hpp"
#include "io/formats/text_file.hpp"
#include "io/report/group_curves.hpp"
#include "io/report/hydrate_figures.hpp"
#include "io/report/laboratory_overlay.hpp"
#include "io/report/loading_figures.hpp"
#include "io/report/markup.hpp"
#include "io/report/sand_strength.hpp"
#include "io/results/shown_units.hpp"

namespace clathra {
namespace {

constexpr std::size_t most_seeds_drawn = 10, most_small_figures = 60;  // of one kind; a page stays below a few megabytes
constexpr char peak_number[] = "peak_q_Pa";
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
  for (GroupCurves const& group : groups) {
    SeedBand const& band = group.bands[what.column];
    for (std::vector<double> const* const edge : {&band.low, &band.high}) values.include(*edge);
    for (std::vector<double> const& seed : band.seeds) strains.include(band.eps1), values.include(seed);
  }
  Axis const x = strains.exact_axis(axial_strain), y = axis_of(what, values);
  Piece figures;
  for (std::size_t i = 0; i < std::min(groups.size(), most_small_figures); ++i)
    if (says_something(groups[i], what)) figures += small_figure(groups[i], what, x, y);
  return figures.empty() ? "" : "<div class=\"multiples\">\n" + std::move(figures) + "</div>\n";
}

struct Column {
  std::string number, heading, unit;
  double factor;
};

/// How many seeds of a group have no peak yet, or nothing.
std::string rising_seeds(GroupNumbers const& group) {
  std::size_t const rising = group.without_peak();
  if (rising == 0) return {};
  std::string const of_all = rising == group.seeds.size() ? "" : fmt::format("{} of {} ", rising, group.seeds.size());
  return fmt::format("<small class=\"unit\">({}still rising)</small>", of_all);
}

std::string table_of_groups(std::vector<GroupNumbers> const& groups, std::vector<Column> const& columns, char const* what) {
  std::string head = fmt::format("<th>{}</th><th>seeds</th>", what), rows;
  std::vector<Column> used;
  for (Column const& column : columns) {
    bool known = false, rounding = true;
    for (GroupNumbers const& group : groups)
      if (auto const found = group.values.find(column.number); found != group.values.end()) {
        known = true;
        for (double const value : found->second) rounding &= value != 0 && std::abs(value * column.factor) < least_shown;
      }
    if (known && !rounding) used.push_back(column);
  }
  for (Column const& column : used)
    head += fmt::format("<th>{}{}</th>", column.heading,
                        !column.unit.empty() ? fmt::format(" <span class=\"unit\">[{}]</span>", column.unit) : "");
  for (GroupNumbers const& group : groups) {
    rows += fmt::format("<tr><th>{}</th><td data-run=\"seeds\">{}</td>", escaped(group.name), group.seeds.size());
    for (Column const& column : used) {
      auto const found = group.values.find(column.number);
      std::string cell = found == group.values.end() ? "–" : with_interval(found->second, column.factor);
      if (found != group.values.end() && found->second.size() != group.seeds.size())
        cell +=
            fmt::format("<small class=\"unit\">({} seed{})</small>", found->second.size(), found->second.size() == 1 ? "" : "s");
      if (column.number == peak_number || column.number == "residual_q_Pa") cell += rising_seeds(group);
      rows += fmt::format("<td data-run=\"{} {}\"><span>{}</span></td>", column.heading, column.unit, cell);
    }
    rows += "</tr>\n";
  }
  return "<div class=\"scroll several sure\"><table><thead><tr>" + head + "</tr></thead><tbody>\n" + rows +
         "</tbody></table></div>\n";
}

Piece strength_part(std::vector<GroupNumbers> const& materials, LaboratoryOverlay& points) {
  if (materials.empty()) return "";
  Piece text = "<h2>Strength</h2>\n" + table_of_groups(materials,
                                                       {{"peak_cohesion_Pa", "c at the peak", "MPa", mega},
                                                        {"peak_friction_angle_deg", "φ at the peak", "°", 1},
                                                        {"peak_r_squared", "R²", "", 1},
                                                        {"peak_curvature_per_Pa", "curvature", "1/MPa", 1e6},
                                                        {"residual_cohesion_Pa", "residual c", "MPa", mega},
                                                        {"residual_friction_angle_deg", "residual φ", "°", 1}},
                                                       "material");
  Piece figures;
  for (auto const& [heading, number] : {std::pair{"Cohesion", Variable{"cohesion c [MPa]", "peak_cohesion_Pa", mega}},
                                        {"Friction angle", Variable{"friction angle φ [°]", "peak_friction_angle_deg"}}})
    figures += strength_figure(materials, heading, number, points.over(hydrate_saturation, number));
  return text + side_by_side(std::move(figures));
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
struct SharedText {
  std::string first;  // as the first member says it
  bool numbers_differ = false;
  std::vector<std::string> members;
};

std::string first_of(std::vector<std::string> const& names) {
  constexpr std::size_t most = 5;
  std::span const named = std::span(names).first(std::min(names.size(), most));
  std::string text = fmt::format("{}", fmt::join(named, ", "));
  return named.size() < names.size() ? fmt::format("{} and {} more", text, names.size() - named.size()) : text;
}

/// Texts of members, each once with those that have it; of texts that differ in numbers alone, the first.
class SharedTexts {
 public:
  void add(std::string const& member, std::string const& text) {
    auto const [at, is_new] = place_.try_emplace(without_numbers(text), all_.size());
    if (is_new) all_.push_back({text, false, {}});
    SharedText& shared = all_[at->second];
    shared.numbers_differ |= text != shared.first;
    shared.members.push_back(member);
  }
  std::string items() const {
    std::string items;
    for (SharedText const& text : all_)
      items +=
          "<li>" +
          escaped(first_of(text.members) +
                  (text.numbers_differ ? " (each with its own numbers, see study.csv; here the first): " : ": ") + text.first) +
          "</li>\n";
    return items;
  }

 private:
  std::vector<SharedText> all_;
  std::map<std::string, std::size_t> place_;
};

std::string box(char const* heading, std::string const& items) {
  return items.empty() ? "" : fmt::format("<div class=\"warn\"><b>{}</b><ul>\n{}</ul></div>\n", heading, items);
}

std::string warnings(Study const& study, std::vector<MemberResult> const& members) {
  SharedTexts texts;
  for (MemberResult const& member : members)
    for (std::string const& text : member.warnings) texts.add(member_name(study.groups[member.group], member.seed), text);
  return box("Warnings of members", texts.items());
}

std::string problems(Study const& study, std::vector<MemberResult> const& members) {
  SharedTexts texts;
  std::size_t waiting = 0;
  for (MemberResult const& member : members) {
    waiting += member.state == MemberState::waiting ? 1 : 0;
    if (member.state == MemberState::failed || member.state == MemberState::refused)
      texts.add(member_name(study.groups[member.group], member.seed), member.message);
  }
  std::string items = texts.items();
  if (waiting > 0) items += fmt::format("<li>{} members are not finished</li>\n", waiting);
  return box("Members that are missing", items);
}

/// Which members have no peak yet: what the table and the curves call one is none there.
std::string note_on_rising(Study const& study, std::vector<MemberResult> const& members) {
  std::vector<std::string> rising;
  std::size_t finished = 0;
  for (MemberResult const& member : members) {
    if (member.state != MemberState::finished || !member.numbers.contains(peak_number)) continue;
    ++finished;
    if (!member.peak) rising.push_back(member_name(study.groups[member.group], member.seed));
  }
  if (rising.empty()) return {};
  return fmt::format(
      "<p class=\"soft\">q still rises at the end of {} of {} members ({}): it has not fallen by {:.3g} % after its largest "
      "value, so "
      "a peak may lie beyond. What stands for their peak is the largest q so far; envelopes leave them out.</p>\n",
      rising.size(), finished, escaped(first_of(rising)), (1 - share_past_peak) * percent);
}

std::vector<PageTest> tests_of(Study const& study) {
  std::vector<PageTest> tests;
  for (StudyGroup const& group : study.groups) tests.push_back(page_test(member_scene(study, group, study.seeds.front()).scene));
  return tests;
}

Piece curves_part(std::vector<GroupCurves> const& curves, LaboratoryOverlay& points) {
  Piece overlays;
  for (ShownBand const& what : shown_bands) {
    bool const any = std::any_of(curves.begin(), curves.end(), [&](GroupCurves const& g) { return says_something(g, what); });
    if (any) overlays += overlay(curves, what, points.over(axial_strain, what.axis));
  }
  return overlays.empty() ? "" : "<h2>Curves</h2>\n" + side_by_side(std::move(overlays));
}

/// What tests that are not one biaxial compression have to draw, each seed a line.
Piece loading_part(std::vector<GroupCurves> const& groups, std::optional<SandStrength> const& sand, LaboratoryOverlay& points) {
  constexpr std::size_t most_runs = 100;
  std::vector<RunResults> runs;
  std::vector<Curve> styles;
  std::size_t left_out = 0;
  for (GroupCurves const& group : groups)
    for (RunResults const& run : group.other_tests) {
      if (runs.size() == most_runs) {
        ++left_out;
        continue;
      }
      runs.push_back(run);
      styles.push_back({group.name, {}, {}, {group.stroke.colour, group.stroke.dash, 1.2}});
    }
  ShownRuns const shown{runs, points, [&](std::size_t i) { return styles[i]; }};
  Piece figures = loading_figures(shown), of_hydrate = hydrate_part(shown, sand);
  if (figures.empty() && of_hydrate.empty()) return "";
  return fmt::format("<h2>Loading</h2>\n<p class=\"soft\">A line for each seed, in the colour of its group.{}</p>\n",
                     left_out > 0 ? fmt::format(" {} members more are not drawn.", left_out) : "") +
         std::move(of_hydrate) + side_by_side(std::move(figures));
}

std::vector<Column> result_columns() {
  return {{peak_number, "peak q", "MPa", mega},
          {"peak_eps1", "at ε₁", "%", percent},
          {"secant_modulus_Pa", "E₅₀", "MPa", mega},
          {"residual_q_Pa", "residual q", "MPa", mega},
          {"largest_eps_v", "contraction", "%", percent},
          {"dilation_angle_deg", "ψ", "°", 1},
          {"end_bonds_intact_pct", "intact at the end", "%", 1}};
}

/// What stages under stresses come to, and what any stage may show of the material.
Column const of_stresses[] = {{"strain_eps1", "ε₁", "%", percent},
                              {"strain_eps_v", "εᵥ", "%", percent},
                              {"failed", "share that failed", "", 1},
                              {"failed_saturation", "saturation where it failed", "%", percent}},
             of_stages[] = {{"bulk_modulus_Pa", "bulk modulus", "MPa", mega},
                            {"constrained_modulus_Pa", "M<sub>oed</sub>", "MPa", mega},
                            {"k0", "K₀ at the end", "", 1},
                            {"k0_of_increments", "K₀ of the increments", "", 1},
                            {"secant_stiffness_Pa", "E<sub>ur</sub>", "MPa", mega},
                            {"damping_ratio", "damping ratio", "%", percent},
                            {"strain_per_cycle", "strain a cycle", "%", percent},
                            {"largest_pore_pressure_ratio", "largest r<sub>u</sub>", "", 1}};

/// What groups are compared by: numbers of a compression, then those of the stages of other tests, in their order.
std::vector<Column> columns_of(std::vector<GroupCurves> const& groups) {
  std::vector<Column> columns = result_columns();
  auto const add = [&](Column column, std::string const& stage, bool alone) {
    if (!alone) column = {stage + "." + column.number, escaped(stage) + ": " + column.heading, column.unit, column.factor};
    if (std::none_of(columns.begin(), columns.end(), [&](Column const& c) { return c.number == column.number; }))
      columns.push_back(std::move(column));
  };
  for (GroupCurves const& group : groups) {
    if (group.other_tests.empty()) continue;
    std::vector<LoadingStage> const stages = stages_of_run(group.other_tests.front());
    for (LoadingStage const& stage : stages) {
      bool const alone = stages.size() == 1 || stage.name == shear_stage;
      if (stage.has_stress_only())
        for (Column const& column : of_stresses) add(column, stage.name, alone);
      for (Column const& column : of_stages) add(column, stage.name, alone);
    }
  }
  return columns;
}

}  // namespace

std::vector<Figure> write_study_report(Study const& study, std::vector<MemberResult> const& members,
                                       std::vector<std::filesystem::path> const& folders, std::filesystem::path const& html,
                                       std::optional<LaboratoryData> const& data) {
  std::vector<GroupNumbers> const groups = numbers_by_group(study, members);
  std::vector<GroupCurves> const curves = curves_of_groups(study, members, folders);
  auto const finished =
      std::count_if(members.begin(), members.end(), [](MemberResult const& m) { return m.state == MemberState::finished; });
  std::string const title = "Study " + study.file.stem().string();
  Piece body = "<h1>" + escaped(title) + "</h1>\n";
  body += fmt::format(
      "<p class=\"lead\">{} finished members in {} group{}, which differ in {}. Numbers are means over the seeds ± half of their "
      "95 % confidence interval (Student t).</p>\n",
      finished, groups.size(), groups.size() == 1 ? "" : "s", escaped(varied_keys(study)));
  body += problems(study, members) + warnings(study, members) + "<h2>Results</h2>\n" +
          table_of_groups(groups, columns_of(curves), "group") + note_on_rising(study, members);
  Piece multiples;
  LaboratoryOverlay points = data ? LaboratoryOverlay(*data, tests_of(study)) : LaboratoryOverlay();
  body += curves_part(curves, points);
  body += loading_part(curves, strength_of_sand(envelopes_by_material(study, members)), points);
  body += strength_part(envelopes_by_material(study, members), points);
  body += points.note();
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
