#include "io/report/sand_strength.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "io/report/group_curves.hpp"
#include "io/report/hydrate_figures.hpp"
#include "io/report/markup.hpp"
#include "io/results/shown_units.hpp"
#include "io/results/strength_groups.hpp"
#include "io/scene/schema.hpp"

namespace clathra {

double SandStrength::flow_value() const {
  double const tangent = std::tan(std::numbers::pi / 4 + friction_angle / 2);
  return tangent * tangent;
}

double SandStrength::lateral_stress(double deviator) const {
  double const n = flow_value();
  return (deviator - 2 * cohesion * std::sqrt(n)) / (n - 1);
}

double SandStrength::deviator_at_mean(double mean) const {
  return 2 * cohesion * std::cos(friction_angle) + 2 * mean * std::sin(friction_angle);
}

std::optional<SandStrength> strength_of_sand(std::vector<RunResults> const& runs) {
  for (StrengthGroup const& group : strength_groups(runs))
    if (group.saturation == 0 && group.at_peak.envelope && group.at_peak.envelope->friction_angle > 0)
      return SandStrength{group.at_peak.envelope->cohesion, group.at_peak.envelope->friction_angle};
  return {};
}

std::optional<SandStrength> strength_of_sand(std::vector<GroupNumbers> const& materials) {
  for (GroupNumbers const& material : materials) {
    auto const cohesion = material.values.find("peak_cohesion_Pa"), angle = material.values.find("peak_friction_angle_deg");
    if (cohesion == material.values.end() || angle == material.values.end()) continue;
    std::string const* const saturation = value_in(material.settings, saturation_key);
    if (!saturation || std::atof(saturation->c_str()) > 0) continue;
    SandStrength const sand{mean_interval(cohesion->second).mean, mean_interval(angle->second).mean / degrees};
    if (sand.friction_angle > 0) return sand;
  }
  return {};
}

namespace {

/// What runs of one name came to. Stresses in Pa.
struct Outcome {
  std::string name;
  std::vector<double> loads, failed_at,
      stood_to;  ///< q before the hydrate changes; sigma_3 where runs failed, the least of others
};

/// Where a run failed under its load while its hydrate changed: p and q [Pa].
std::optional<std::pair<double, double>> failure_of(RunResults const& run) {
  auto const loading = run.record.find("loading");
  if (loading == run.record.end()) return {};
  for (auto const& end : *loading) {
    std::string const at = "/stages/" + end.value("stage", "") + "/";
    auto const p = run.number(at + "failed_p_Pa"), q = run.number(at + "failed_q_Pa");
    if (p && q) return std::pair{*p, *q};
  }
  return {};
}

void add_outcome(std::vector<Outcome>& outcomes, std::string const& name, RunResults const& run,
                 std::vector<std::size_t> const& rows) {
  auto at = std::find_if(outcomes.begin(), outcomes.end(), [&](Outcome const& o) { return o.name == name; });
  if (at == outcomes.end()) at = outcomes.insert(outcomes.end(), Outcome{name, {}, {}, {}});
  at->loads.push_back(run.history["q_Pa"][rows.front()]);
  if (auto const failure = failure_of(run)) return at->failed_at.push_back(failure->first - failure->second / 2);
  double least = HUGE_VAL;
  for (std::size_t const i : rows) least = std::min(least, run.history["sigma3_Pa"][i]);
  at->stood_to.push_back(least);
}

/// Where runs failed: a curve of one point each.
std::vector<Curve> failures_of(std::vector<RunResults> const& runs) {
  std::vector<Curve> failures;
  for (RunResults const& run : runs)
    if (auto const failure = rows_where_hydrate_changes(run).size() < 2 ? std::nullopt : failure_of(run))
      failures.push_back({"failed here", {failure->first}, {failure->second}, {colours::vermilion, "2 3", 4}, true});
  return failures;
}

/// Stresses from no load up to a mean one.
Curve line_of(SandStrength const& sand, double most) {
  return {"strength of the clean sand",
          {0, most},
          {sand.deviator_at_mean(0), sand.deviator_at_mean(most)},
          {colours::black, "6 3", 1.6}};
}

}  // namespace

Piece failure_figure(ShownRuns const& shown, std::optional<SandStrength> const& sand) {
  Plot plot;
  Range means, deviators;
  for (std::size_t r = 0; r < shown.runs.size(); ++r) {
    RunResults const& run = shown.runs[r];
    std::vector<std::size_t> const rows = rows_where_hydrate_changes(run);
    if (rows.size() < 2) continue;
    Curve curve = shown.style(r);
    for (std::size_t const i : rows) {
      curve.x.push_back(run.history["p_Pa"][i]);
      curve.y.push_back(run.history["q_Pa"][i]);
    }
    plot.curves.push_back(std::move(curve));
  }
  if (plot.curves.empty()) return "";
  for (Curve& failure : failures_of(shown.runs)) plot.curves.push_back(std::move(failure));
  for (Curve const& curve : plot.curves) means.include(curve.x), deviators.include(curve.y);
  Variable const mean{"mean stress p [MPa]", "p_Pa", mega}, deviator{"deviator stress q [MPa]", "q_Pa", mega};
  if (sand) {
    plot.curves.push_back(line_of(*sand, means.axis(mean).to / mega));
    deviators.include(plot.curves.back().y);
  }
  plot.title = "Stress paths while hydrate changes, and the strength of the sand";
  plot.x = means.axis(mean);
  plot.y = deviators.axis(deviator);
  for (Curve const& curve : plot.curves)
    plot.description += fmt::format("{}: from p {:.3g}, q {:.3g} MPa to {:.3g}, {:.3g} MPa. ", curve.name, curve.x.front() * mega,
                                    curve.y.front() * mega, curve.x.back() * mega, curve.y.back() * mega);
  std::string const of_sand =
      sand ? fmt::format(
                 "Sand without hydrate bears q = 2 c cos φ + 2 p sin φ, with c = {:.3g} MPa and φ = {:.3g}° of the peaks on "
                 "this page. ",
                 sand->cohesion * mega, sand->friction_angle * degrees)
           : std::string(
                 "What the sand alone bears is drawn where clean sand stands on this page that was sheared at two lateral "
                 "stresses or more. ");
  return figure("Where specimens fail", drawing(plot) + legend(plot.curves),
                of_sand + "A path that leaves the strength of its bonds behind fails where it meets that of the sand.");
}

Piece failure_table(ShownRuns const& shown, std::optional<SandStrength> const& sand) {
  std::vector<Outcome> outcomes;
  for (std::size_t r = 0; r < shown.runs.size(); ++r)
    if (std::vector<std::size_t> const rows = rows_where_hydrate_changes(shown.runs[r]); rows.size() >= 2)
      add_outcome(outcomes, shown.style(r).name, shown.runs[r], rows);
  if (outcomes.empty()) return "";
  auto const stress = [](std::vector<double> const& values) {
    return values.empty()      ? std::string("–")
           : values.size() > 1 ? with_interval(values, mega)
                               : fmt::format("{:.3g}", values.front() * mega);
  };
  std::vector<std::vector<std::string>> rows;
  for (Outcome const& o : outcomes) {
    std::vector<double> predicted;
    if (sand)
      for (double const load : o.loads) predicted.push_back(sand->lateral_stress(load));
    rows.push_back({o.name, stress(o.loads), stress(predicted), fmt::format("{} of {}", o.failed_at.size(), o.loads.size()),
                    stress(o.failed_at), stress(o.stood_to)});
  }
  return "<p class=\"soft\">Stresses in MPa: the load, the lateral stress at which the sand alone bears it no more, and what "
         "became of "
         "the specimens.</p>\n" +
         table({"test", "q", "σ₃ of the sand", "failed", "at σ₃", "least σ₃ of those that stood"}, rows);
}

Piece hydrate_part(ShownRuns const& shown, std::optional<SandStrength> const& sand) {
  Piece figures = hydrate_figures(shown) + failure_figure(shown, sand);
  return figures.empty() ? "" : side_by_side(std::move(figures)) + failure_table(shown, sand);
}

}  // namespace clathra
