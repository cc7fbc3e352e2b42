#include "io/report/hydrate_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "domain/scene/phase_boundary.hpp"
#include "io/report/markup.hpp"
#include "io/results/shown_units.hpp"

namespace clathra {
namespace {

bool changes_hydrate(RunResults const& run) { return run.history.has("saturation_pct") && run.history.has("temperature_degC"); }

}  // namespace

std::vector<HydrateStageRows> stages_that_change_hydrate(RunResults const& run) {
  if (!changes_hydrate(run)) return {};
  HistoryTable const& history = run.history;
  auto const differ = [&](std::size_t a, std::size_t b) {
    for (char const* const column : {"temperature_degC", "pore_pressure_Pa", "saturation_pct"})
      if (history[column][a] != history[column][b]) return true;
    return false;
  };
  std::vector<HydrateStageRows> stages;
  for (std::size_t from = 0, to = 0; from < history.rows(); from = to) {
    while (to < history.rows() && history.stages()[to] == history.stages()[from]) ++to;
    std::size_t before = from;  // the last row of the hydrate that there was
    while (before + 1 < to && !differ(before + 1, from)) ++before;
    if (before + 1 < to) stages.push_back({history.stages()[from], before, to});
  }
  return stages;
}

std::vector<std::size_t> rows_where_hydrate_changes(RunResults const& run) {
  std::vector<std::size_t> rows;
  for (HydrateStageRows const& stage : stages_that_change_hydrate(run))
    for (std::size_t i = stage.before; i < stage.end; ++i) rows.push_back(i);
  return rows;
}

namespace {

/// A quantity of the rows, its name in the legend, and how its line is dashed.
struct Quantity {
  char const *name, *column, *dash;
  double factor;  ///< to the unit that the axis counts in
};

constexpr Variable increments{"increment at rest", "increment"};

/// Curves of several quantities over the increments, in the colour of their run.
Piece over_increments(ShownRuns const& shown, char const* heading, Variable const& y, std::vector<Quantity> const& quantities,
                      std::string const& caption) {
  Plot plot;
  Range numbers, values;
  std::size_t drawn = 0;
  for (std::size_t r = 0; r < shown.runs.size(); ++r) {
    if (!changes_hydrate(shown.runs[r])) continue;
    HistoryTable const& history = shown.runs[r].history;
    std::vector<std::size_t> const rows = rows_where_hydrate_changes(shown.runs[r]);
    for (Quantity const& quantity : quantities) {
      if (rows.size() < 2 || !history.has(quantity.column)) continue;
      Curve curve = shown.style(r);
      curve.stroke.dash = quantity.dash;
      curve.name += std::string(": ") + quantity.name;
      for (std::size_t k = 0; k < rows.size(); ++k) {
        curve.x.push_back(static_cast<double>(k));
        curve.y.push_back(quantity.factor * history[quantity.column][rows[k]]);
      }
      numbers.include(curve.x);
      values.include(curve.y);
      plot.description +=
          fmt::format("{}: {:.3g}, {:.3g} at the end. ", curve.name, curve.y.front() * y.factor, curve.y.back() * y.factor);
      plot.curves.push_back(std::move(curve));
      ++drawn;
    }
  }
  if (drawn == 0) return "";
  plot.title = std::string(heading) + " over the increments of the hydrate";
  plot.x = numbers.exact_axis(increments);
  plot.y = values.axis(y);
  return figure(heading, drawing(plot) + legend(plot.curves), caption);
}

/// Of the salinity of the first run, as far as it was fitted and no higher than the paths reach.
Curve boundary_of(RunResults const& run, double most) {
  Curve curve{"boundary of stability", {}, {}, {colours::black, "", 1.6}};
  double const salinity = run.number("/scene/hydrate/salinity").value_or(0);
  constexpr int points = 100;
  for (int i = 0; i <= points; ++i) {
    double const temperature = 20.0 * i / points, pressure = equilibrium_pressure(temperature, salinity);
    if (pressure > most) break;
    curve.x.push_back(temperature);
    curve.y.push_back(pressure);
  }
  return curve;
}

Piece path_in_the_plane(ShownRuns const& shown) {
  Plot plot;
  Range temperatures, pressures;
  double most = 0;
  RunResults const* first = nullptr;
  for (std::size_t r = 0; r < shown.runs.size(); ++r) {
    if (!changes_hydrate(shown.runs[r])) continue;
    if (!first) first = &shown.runs[r];
    HistoryTable const& history = shown.runs[r].history;
    Curve curve = shown.style(r);
    curve.marked = true;
    for (std::size_t const i : rows_where_hydrate_changes(shown.runs[r])) {
      curve.x.push_back(history["temperature_degC"][i]);
      curve.y.push_back(history["pore_pressure_Pa"][i]);
      if (std::isfinite(curve.y.back())) most = std::max(most, curve.y.back());
    }
    if (curve.x.empty()) continue;
    plot.description += fmt::format("{}: from {:.3g} degC and {:.3g} MPa to {:.3g} degC and {:.3g} MPa. ", curve.name,
                                    curve.x.front(), curve.y.front() * mega, curve.x.back(), curve.y.back() * mega);
    plot.curves.push_back(std::move(curve));
  }
  if (plot.curves.empty()) return "";
  plot.curves.push_back(boundary_of(*first, 1.3 * most));
  for (Curve const& curve : plot.curves) temperatures.include(curve.x), pressures.include(curve.y);
  plot.title = "Pore pressure against temperature";
  plot.x = temperatures.axis({"temperature [°C]", "temperature_degC"});
  plot.y = pressures.axis({"pore pressure [MPa]", "pore_pressure_Pa", mega});
  return figure(
      "Temperature and pressure", drawing(plot) + legend(plot.curves),
      "Methane hydrate is stable on the cold side of the boundary (Tishchenko et al. 2005, at the salinity of the pore "
      "water), under the higher pressure. How much hydrate is lost is given beside this path, unless a stage has a rate "
      "of dissociation.");
}

}  // namespace

Piece hydrate_figures(ShownRuns const& shown) {
  return path_in_the_plane(shown) +
         over_increments(
             shown, "Hydrate and bonds", {"saturation, intact bonds [%]", "percent"},
             {{"saturation", "saturation_pct", "", 1}, {"intact bonds", "bonds_intact_pct", "8 3", 1}},
             "At rest after each increment: the saturation, and the bonds that are left of those that were installed. "
             "Bonds that are gone have dissolved or broken.") +
         over_increments(
             shown, "Stresses while hydrate changes", {"effective stress [MPa]", "stress_Pa", mega},
             {{"σ₁", "sigma1_Pa", "", 1}, {"σ₃", "sigma3_Pa", "8 3", 1}},
             "Effective stresses on the walls. Under a constant total stress they fall by what the pore pressure rises.") +
         over_increments(shown, "Strain while hydrate changes", {"strain [%]", "strain", percent},
                         {{"ε₁", "eps1", "", 1}, {"εᵥ", "eps_v", "8 3", 1}},
                         "Axial and volumetric strain since the consolidation, compression positive.");
}

}  // namespace clathra
