#include "io/report/summary_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "domain/measurement/test_numbers.hpp"
#include "io/report/curves.hpp"
#include "io/report/markup.hpp"
#include "io/results/shown_units.hpp"

namespace clathra {
namespace {

constexpr char without_value[] = "–";

/// A line below the other.
std::string in_lines(std::string text) {
  for (std::size_t at = 0; (at = text.find('\n', at)) != text.npos;) text.replace(at, 1, "<br>");
  return text;
}

std::string shown(std::optional<double> value, char const* format, double factor = 1) {
  return value && std::isfinite(*value) ? with_minus(fmt::format(fmt::runtime(format), *value * factor)) : without_value;
}

std::string count(std::optional<double> value) { return value ? grouped(*value) : without_value; }

/// What concerns only specimens with hydrate.
std::string bonded(RunResults const& run, std::string const& text) { return run.has_bonds() ? text : without_value; }

struct TableRow {
  char const* name;
  char const* unit;
  std::function<std::string(RunResults const&, TestNumbers const&)> text;
  bool of_peak = false;  ///< known of a compression only
};

std::vector<TableRow> specimen_quantities() {
  using Run = RunResults const&;
  using Numbers = TestNumbers const&;
  return {
      {"particles", "", [](Run r, Numbers) { return count(r.number("/stages/plan/particles")); }},
      {"hydrate saturation", "%", [](Run r, Numbers) { return shown(r.number("/scene/hydrate/saturation"), "{:.3g}", percent); }},
      {"temperature", "°C", [](Run r, Numbers) { return bonded(r, shown(r.number("/scene/hydrate/temperature"), "{:.3g}")); }},
      {"pore pressure", "MPa",
       [](Run r, Numbers) { return bonded(r, shown(r.number("/scene/hydrate/pore_pressure"), "{:.4g}", mega)); }},
      {"confining stress σ₃", "MPa",
       [](Run r, Numbers) { return shown(r.number("/scene/test/confining_stress"), "{:.4g}", mega); }},
      {"void ratio at the start", "", [](Run r, Numbers) { return shown(r.history["void_ratio"].front(), "{:.4f}"); }},
      {"bonds at the start", "", [](Run r, Numbers) { return count(r.history["bonds_intact"].front()); }},
      {"bond law", "",
       [](Run r, Numbers) { return r.has_bonds() ? in_lines(escaped(r.bond_variant())) : std::string("none (clean sand)"); }}};
}

std::vector<TableRow> result_quantities() {
  using Run = RunResults const&;
  using Numbers = TestNumbers const&;
  std::vector<TableRow> all{
      {"peak q", "MPa",
       [](Run, Numbers n) { return shown(n.peak_q, "{:.3f}", mega) + (n.passed_peak ? "" : " (still rising)"); }},
      {"axial strain at the peak", "%", [](Run, Numbers n) { return shown(n.peak_eps1, "{:.2f}", percent); }},
      {"residual q", "MPa",
       [](Run, Numbers n) {
         return shown(n.residual_q, "{:.3f}", mega) +
                fmt::format(" ({:.3g}–{:.3g} %)", n.residual_from * percent, n.end_eps1 * percent);
       }},
      {"secant modulus E₅₀", "MPa", [](Run, Numbers n) { return shown(n.secant_modulus, "{:.4g}", mega); }},
      {"volumetric strain at the peak", "%", [](Run, Numbers n) { return shown(n.eps_v_peak, "{:+.2f}", percent); }},
      {"largest contraction", "%", [](Run, Numbers n) { return shown(n.largest_eps_v, "{:+.2f}", percent); }},
      {"dilation angle ψ", "°", [](Run, Numbers n) { return shown(n.dilation_angle, "{:.1f}", 180 / std::numbers::pi); }},
      {"volumetric strain at the end", "%", [](Run, Numbers n) { return shown(n.eps_v_end, "{:+.2f}", percent); }},
      {"intact bonds at the end", "%", [](Run r, Numbers n) { return bonded(r, shown(n.intact_end, "{:.1f}")); }}};
  for (TableRow& quantity : all) quantity.of_peak = true;
  return all;
}

std::vector<TableRow> cost_quantities() {
  using Run = RunResults const&;
  using Numbers = TestNumbers const&;
  return {
      {"inertial number I", "", [](Run r, Numbers) { return shown(r.number("/stages/plan/inertial_number"), "{:.2g}"); }},
      {"platen wave stress W", "", [](Run r, Numbers) { return shown(r.number("/stages/plan/platen_wave_stress"), "{:.2g}"); }},
      {"moments of inertia", "× true",
       [](Run r, Numbers) { return shown(r.number("/scene/run/rotational_inertia_factor"), "{:.3g}"); }},
      {"steps", "", [](Run r, Numbers) { return count(r.history["step"].back()); }},
      {"wall time of the shear", "s", [](Run r, Numbers) { return shown(r.number("/wall_seconds/shear"), "{:.4g}"); }},
      {"particle-steps a second", "million",
       [](Run r, Numbers) { return shown(r.number("/particle_steps_per_second"), "{:.3g}", mega); }},
      {"seed", "", [](Run r, Numbers) { return shown(r.number("/seed"), "{:.0f}"); }},
      {"program", "",
       [](Run r, Numbers) {
         return escaped(r.text("/program/version").value_or(without_value) + " (" + r.text("/program/git_hash").value_or("?") +
                        ")");
       }},
      {"hash of the final state", "", [](Run r, Numbers) { return escaped(r.text("/state_hash").value_or(without_value)); }}};
}

std::string joined(double low, double high, char const* unit, int digits) {
  std::string const a = fmt::format("{:.{}g}", low, digits), b = fmt::format("{:.{}g}", high, digits);
  return a == b ? a + " " + unit : a + " to " + b + " " + unit;
}

std::string range_text(std::vector<double> const& values, char const* unit, int digits) {
  auto const [low, high] = std::minmax_element(values.begin(), values.end());
  return joined(*low, *high, unit, digits);
}

/// Of a test that is not one compression.
std::string sentence_on_stages(RunResults const& run) {
  std::string names;
  for (std::string const& stage : run.history.stages())
    if (names.empty() || !names.ends_with("'" + stage + "'")) names += (names.empty() ? "'" : ", '") + stage + "'";
  return count(run.number("/stages/plan/particles")) + " particles of " +
         (run.has_bonds()
              ? fmt::format("sand with {:.3g} % hydrate", run.number("/scene/hydrate/saturation").value_or(0) * percent)
              : std::string("clean sand")) +
         " went through these stages after the consolidation: " + names + ".";
}

std::string sentence_on_one(RunResults const& run) {
  if (!run.has_peak()) return sentence_on_stages(run);
  TestNumbers const n = test_numbers(run.history.curves());
  double const saturation = run.number("/scene/hydrate/saturation").value_or(0) * percent;
  std::string text = count(run.number("/stages/plan/particles")) + " particles of ";
  text += run.has_bonds() ? fmt::format("sand with {:.3g} % hydrate", saturation) : "clean sand";
  text += fmt::format(" were compressed to an axial strain of {:.3g} %", n.end_eps1 * percent);
  text += (run.test_kind() == "biaxial" || run.test_kind() == "list" ? " under a lateral stress of "
                                                                     : " from an isotropic stress of ") +
          shown(run.number("/scene/test/confining_stress"), "{:.3g}", mega) + " MPa: ";
  text += n.passed_peak
              ? fmt::format("the deviator stress peaked at {:.3g} MPa at {:.3g} % strain and averaged {:.3g} MPa at the end",
                            n.peak_q * mega, n.peak_eps1 * percent, n.residual_q * mega)
              : fmt::format("the deviator stress was still rising at {:.3g} MPa", n.peak_q * mega);
  if (run.has_bonds() && std::isfinite(n.intact_end)) text += fmt::format("; {:.3g} % of the bonds still held", n.intact_end);
  return text + ".";
}

}  // namespace

std::string summary_sentence(std::vector<RunResults> const& runs) {
  if (runs.size() == 1) return sentence_on_one(runs.front());
  std::vector<double> saturations, stresses, peaks, strains;
  std::size_t rising = 0;
  if (std::any_of(runs.begin(), runs.end(), [](RunResults const& run) { return !run.has_peak(); })) {
    std::string text;
    for (RunResults const& run : runs) text += run.name + ": " + sentence_on_one(run) + " ";
    return text;
  }
  for (RunResults const& run : runs) {
    TestNumbers const n = test_numbers(run.history.curves());
    saturations.push_back(run.number("/scene/hydrate/saturation").value_or(0) * percent);
    stresses.push_back(run.number("/scene/test/confining_stress").value_or(0) * mega);
    peaks.push_back(n.peak_q * mega);
    rising += n.passed_peak ? 0 : 1;
    strains.push_back(n.end_eps1 * percent);
  }
  return fmt::format(
      "{} specimens with a hydrate saturation of {} were compressed to an axial strain of {} under a lateral stress of {}: their "
      "largest deviator stress was {}{}.",
      runs.size(), range_text(saturations, "%", 3), range_text(strains, "%", 3), range_text(stresses, "MPa", 3),
      range_text(peaks, "MPa", 3), rising > 0 ? fmt::format("; it was still rising at the end of {} of them", rising) : "");
}

std::string summary_table(std::vector<RunResults> const& runs) {
  bool const several = runs.size() > 1;
  // On a narrow screen the cells of several runs stand below each other, each with the name of its run.
  auto const cell = [&](RunResults const& run, std::string const& text) {
    return several ? "<td data-run=\"" + escaped(run.name) + "\">" + text + "</td>" : "<td>" + text + "</td>";
  };
  std::vector<TestNumbers> numbers;
  std::string head = "<th>quantity</th>", rows;
  for (RunResults const& run : runs) {
    numbers.push_back(run.has_peak() ? test_numbers(run.history.curves()) : TestNumbers());
    head += "<th>" + escaped(run.name) + "</th>";
  }
  for (auto const& group : {specimen_quantities(), result_quantities(), cost_quantities()})
    for (TableRow const& quantity : group) {
      if (quantity.of_peak && std::none_of(runs.begin(), runs.end(), [](RunResults const& run) { return run.has_peak(); }))
        continue;
      rows += fmt::format("<tr><th>{}{}</th>", quantity.name,
                          *quantity.unit ? fmt::format(" <span class=\"unit\">[{}]</span>", quantity.unit) : "");
      for (std::size_t i = 0; i < runs.size(); ++i)
        rows += cell(runs[i], quantity.of_peak && !runs[i].has_peak() ? without_value : quantity.text(runs[i], numbers[i]));
      rows += "</tr>\n";
    }
  return std::string(several ? "<div class=\"scroll several\">" : "<div class=\"scroll\">") + "<table><thead><tr>" + head +
         "</tr></thead><tbody>\n" + rows + "</tbody></table></div>\n";
}

std::string warning_list(std::vector<RunResults> const& runs) {
  std::string items;
  for (RunResults const& run : runs) {
    std::string const from = runs.size() > 1 ? escaped(run.name) + ": " : "";
    std::string const reason = run.text("/exit/reason").value_or("unknown");
    if (reason != "finished") items += fmt::format("<li>{}the run is not complete: {}</li>\n", from, escaped(reason));
    if (auto const warnings = run.record.find("warnings"); warnings != run.record.end() && warnings->is_array())
      for (auto const& warning : *warnings)
        if (warning.is_string()) items += "<li>" + from + escaped(warning.get<std::string>()) + "</li>\n";
  }
  return items.empty() ? "" : "<div class=\"warn\"><b>Warnings of the run</b><ul>\n" + items + "</ul></div>\n";
}

std::string note_on_missing_columns(std::vector<RunResults> const& runs) {
  std::string note;
  for (RunResults const& run : runs) {
    std::string names;
    for (std::string const& name : run.history.missing()) names += (names.empty() ? "" : ", ") + name;
    if (names.empty()) continue;
    note += fmt::format("The history.csv of {} has no {}: what is made of that is left out. ", run.name, names);
  }
  return note.empty() ? "" : "<p class=\"soft\">" + escaped(note) + "</p>\n";
}

}  // namespace clathra
