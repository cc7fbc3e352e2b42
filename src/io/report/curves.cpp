#include "io/report/curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "domain/measurement/test_numbers.hpp"
#include "io/report/loading_figures.hpp"
#include "io/report/markup.hpp"
#include "io/results/shown_units.hpp"

namespace clathra {
namespace {

/// A column of every run that has it against its axial strain.
Plot plot_of(ShownRuns const& shown, Variable const& what) {
  std::vector<RunResults> const& runs = shown.runs;
  Plot plot;
  Range strains, values;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    HistoryTable const& history = runs[i].history;
    if (!history.has(what.column)) continue;
    plot.curves.push_back({run_label(runs[i]), history[axial_strain.column], history[what.column], run_stroke(i)});
  }
  if (!plot.curves.empty())
    for (Curve& points : shown.data.over(axial_strain, what)) plot.curves.push_back(std::move(points));
  for (Curve const& curve : plot.curves) strains.include(curve.x), values.include(curve.y);
  plot.x = strains.exact_axis(axial_strain);
  plot.y = values.axis(what);
  return plot;
}

/// The smallest and the largest of the finite numbers of curves.
std::pair<double, double> extent(std::vector<Curve> const& curves, std::vector<double> Curve::*numbers) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (Curve const& curve : curves)
    for (double const value : curve.*numbers)
      if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
  return {low, high};
}

/// Void ratio against stress before the shear, of the runs that have recorded it.
Piece consolidation_figure(std::vector<RunResults> const& runs) {
  Plot plot;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    HistoryTable const& history = runs[i].history;
    std::vector<double> const p = history.before("p_Pa"), e = history.before("void_ratio");
    if (p.size() < 2 || e.size() != p.size()) continue;
    plot.curves.push_back({run_label(runs[i]), p, e, run_stroke(i)});
    plot.description += fmt::format("{}: e {:.4g} at {:.3g} MPa, {:.4g} at {:.3g} MPa", run_label(runs[i]), e.front(),
                                    p.front() * mega, e.back(), p.back() * mega);
    if (std::optional<double> const broken = runs[i].number("/stages/prepare/broken_in_consolidation");
        runs[i].has_bonds() && broken)
      plot.description += fmt::format(", {} bonds broken", *broken);
    plot.description += ". ";
  }
  auto const [least, most] = extent(plot.curves, &Curve::x);
  auto const [densest, loosest] = extent(plot.curves, &Curve::y);
  if (!(0 < least && 1.01 * least < most && densest < loosest)) return "";  // no change of stress that could be shown
  double const step = tick_step(densest, loosest, 5);
  plot.title = "Void ratio against mean stress in the consolidation";
  plot.x = {{"mean stress p [MPa], logarithmic", "p_Pa", mega}, least * mega, 1.0001 * most * mega, true};
  plot.y = {{"void ratio e", "void_ratio"}, std::floor(densest / step) * step, std::ceil(loosest / step) * step};
  return figure("Consolidation", drawing(plot) + legend(plot.curves),
                "The void ratio e before the shear, while the mean stress p changes from that of the specimen to the confining "
                "stress, and the specimen comes to rest. " +
                    plot.description);
}

Piece stress_figure(ShownRuns const& shown) {
  std::vector<RunResults> const& runs = shown.runs;
  Plot plot = plot_of(shown, {"deviator stress q [MPa]", "q_Pa", mega});
  plot.title = "Deviator stress against axial strain";
  for (RunResults const& run : runs) {
    if (!run.has_peak()) continue;
    TestNumbers const n = test_numbers(run.history.curves());
    plot.description +=
        fmt::format("{}: {} {:.3g} MPa at {:.3g} %, residual {:.3g} MPa. ", run_label(run),
                    n.passed_peak ? "peak" : "largest so far", n.peak_q * mega, n.peak_eps1 * percent, n.residual_q * mega);
  }
  return figure("Stress and strain", drawing(plot) + legend(plot.curves),
                "How hard the specimen resists: the deviator stress q = σ₁ − σ₃, the difference of the vertical and the lateral "
                "stress on the walls, while the top and bottom close in on each other.");
}

Piece volume_figure(ShownRuns const& shown) {
  std::vector<RunResults> const& runs = shown.runs;
  Plot plot = plot_of(shown, {"volumetric strain εᵥ [%]", "eps_v", percent});
  if (plot.curves.empty()) return "";
  plot.title = "Volumetric strain against axial strain";
  for (Curve const& curve : plot.curves)
    plot.description += fmt::format("{}: {:+.3g} % at the end. ", curve.name, curve.y.back() * percent);
  return figure("Change of volume", drawing(plot) + legend(plot.curves),
                "Compression is positive: a rising curve means that the specimen gets denser, a falling one that it dilates. "
                "Below zero it takes more room than before the test. Strains are natural (logarithmic) ones.");
}

Piece intact_figure(ShownRuns const& shown) {
  std::vector<RunResults> const& runs = shown.runs;
  if (std::none_of(runs.begin(), runs.end(), [](RunResults const& run) { return run.has_bonds(); }))
    return "<p class=\"soft\">The sand is clean: there are no bonds that could break.</p>\n";
  Plot plot = plot_of(shown, {"intact bonds [% of those installed]", "bonds_intact_pct"});
  std::erase_if(plot.curves, [&](Curve const& curve) {
    return std::none_of(runs.begin(), runs.end(),
                        [&](RunResults const& run) { return run.has_bonds() && run_label(run) == curve.name; });
  });
  if (plot.curves.empty()) return "";
  plot.title = "Share of intact bonds against axial strain";
  plot.y = {plot.y.what, 0, percent};
  for (Curve const& curve : plot.curves) plot.description += fmt::format("{}: {:.3g} % at the end. ", curve.name, curve.y.back());
  return figure("Intact bonds", drawing(plot) + legend(plot.curves),
                "Bonds of hydrate between grains that still hold, as a share of those that were installed. A broken bond "
                "does not heal.");
}

/// Whether a history says what broke the bonds.
bool has_modes(HistoryTable const& history) {
  std::vector<std::string> columns{"bonds_intact"};
  for (BreakModeNames const& m : break_modes) columns.push_back(m.broken);
  return history.has_all(columns);
}

/// What broke the bonds of a run: a curve for each mode.
std::vector<Curve> mode_curves(HistoryTable const& history) {
  std::vector<Curve> curves;
  for (BreakModeNames const& m : break_modes) {
    if (m.mode == BreakMode::dissolved && history[m.broken].back() == 0) continue;  // no hydrate has changed
    Curve curve{"", history[axial_strain.column], {}, mode_stroke(m.mode)};
    for (std::size_t i = 0; i < history.rows(); ++i) {
      double all = history["bonds_intact"][i];
      for (BreakModeNames const& other : break_modes) all += history[other.broken][i];
      curve.y.push_back(all > 0 ? history[m.broken][i] / all * percent : 0);
    }
    curve.name = fmt::format("{}: {:.3g} % at the end", m.name, curve.y.back());
    curves.push_back(std::move(curve));
  }
  return curves;
}

/// A figure for each run with bonds, on the same axes.
Piece mode_figures(std::vector<RunResults> const& runs) {
  Range strains, shares;
  for (RunResults const& run : runs)
    for (Curve const& curve : has_modes(run.history) ? mode_curves(run.history) : std::vector<Curve>())
      strains.include(curve.x), shares.include(curve.y);
  Piece figures;
  for (RunResults const& run : runs) {
    if (!run.has_bonds() || !has_modes(run.history)) continue;
    Plot plot;
    plot.title = "Broken bonds by mode against axial strain, " + run_label(run);
    plot.curves = mode_curves(run.history);
    for (Curve const& curve : plot.curves) plot.description += curve.name + ". ";
    plot.x = strains.exact_axis(axial_strain);
    plot.y = shares.axis({"broken bonds [% of all]", "broken_pct"});
    figures += figure(
        "What broke the bonds: " + run_label(run), drawing(plot) + legend(plot.curves),
        "A bond breaks in tension or compression when the normal force reaches its strength, else by shear force and bending "
        "moment together; it then counts as broken in shear or in rolling, whichever had the larger part. Those that broke in "
        "the consolidation count as well.");
  }
  return figures;
}

struct Account {
  char const* name;
  std::vector<char const*> columns;
  Rgb colour;
};

/// The accounts of the ledger from bottom to top. What is stored counts as its change since the consolidation.
std::vector<Account> const& accounts() {
  static std::vector<Account> const all{
      {"stored in grains, bonds, walls and motion",
       {"grain_elastic_J_per_m", "bond_elastic_J_per_m", "wall_elastic_J_per_m", "kinetic_J_per_m"},
       colours::sky},
      {"lost by sliding", {"sliding_J_per_m"}, colours::orange},
      {"lost by rolling", {"rolling_J_per_m"}, colours::vermilion},
      {"lost by breaking bonds", {"breakage_J_per_m"}, colours::purple},
      {"lost with hydrate", {"dissolved_J_per_m"}, colours::green},
      {"lost by damping", {"dashpot_J_per_m", "damping_J_per_m"}, colours::grey}};
  return all;
}

/// An account that stays empty where no hydrate changes.
bool is_without_hydrate(Account const& account, HistoryTable const& history) {
  if (account.columns.front() != std::string_view("dissolved_J_per_m")) return false;
  std::vector<double> const& lost = history[account.columns.front()];
  return std::none_of(lost.begin(), lost.end(), [](double value) { return value != 0; });
}

Piece energy_figure(RunResults const& run) {
  HistoryTable const& history = run.history;
  Plot plot;
  Range values;
  std::vector<double> const strain = history[axial_strain.column];
  std::vector<double> top(history.rows(), 0.0);
  Piece entries;
  for (Account const& account : accounts()) {
    Area area{account.name, strain, top, top, account.colour};
    for (char const* const column : account.columns)
      for (std::size_t i = 0; i < history.rows(); ++i) area.high[i] += history[column][i] - history[column][0];
    if (is_without_hydrate(account, history)) continue;
    top = area.high;
    values.include(area.high);
    plot.description += fmt::format("{}: {:.3g} J per metre at the end. ", account.name, area.high.back() - area.low.back());
    entries = patch_entry(account.colour, account.name) + std::move(entries);
    plot.areas.push_back(std::move(area));
  }
  plot.curves.push_back({"work of the walls", strain, history["boundary_work_J_per_m"], {colours::black, "6 4", 1.6}});
  values.include(plot.curves[0].y);
  Range strains;
  strains.include(strain);
  plot.x = strains.exact_axis(axial_strain);
  plot.y = values.axis({"energy [J per metre]", "energy_J_per_m"});
  plot.title = "Energy balance, " + run_label(run);
  double const work = history["boundary_work_J_per_m"].back(), residual = history["residual_J_per_m"].back();
  return figure(
      "Where the work went: " + run_label(run),
      drawing(plot) + legend(line_entry(plot.curves[0].stroke, plot.curves[0].name) + std::move(entries)),
      fmt::format("The work of the walls since the consolidation (dashed) and what became of it, on top of each other. Each "
                  "part is counted by itself; at the end they miss the work by {:.2g} %. Per metre of thickness out of "
                  "the plane.",
                  work != 0 ? std::abs(residual / work) * percent : 0.0));
}

bool has_ledger(RunResults const& run) {
  if (!run.history.has("boundary_work_J_per_m") || !run.history.has("residual_J_per_m")) return false;
  for (Account const& account : accounts())
    for (char const* const column : account.columns)
      if (!run.history.has(column)) return false;
  return true;
}

}  // namespace

std::string run_label(RunResults const& run) {
  std::string label = run.name;
  std::optional<double> const stress = run.number("/scene/test/confining_stress");
  double const saturation = run.number("/scene/hydrate/saturation").value_or(0);
  label += run.has_bonds() ? fmt::format(": {:.3g} % hydrate", saturation * percent) : ": clean sand";
  if (stress) label += fmt::format(", {:.3g} MPa", *stress * mega);
  return label;
}

ShownRuns shown_runs(std::vector<RunResults> const& runs, LaboratoryOverlay& data) {
  return {runs, data, [&runs](std::size_t i) { return Curve{run_label(runs[i]), {}, {}, run_stroke(i)}; }};
}

Piece curve_figures(ShownRuns const& shown) {
  std::vector<RunResults> const& runs = shown.runs;
  return stress_figure(shown) + volume_figure(shown) + intact_figure(shown) + mode_figures(runs) + consolidation_figure(runs) +
         dilatancy_figure(shown);
}

Piece energy_figures(std::vector<RunResults> const& runs) {
  Piece figures;
  for (RunResults const& run : runs)
    if (has_ledger(run)) figures += energy_figure(run);
  return figures;
}

}  // namespace clathra
