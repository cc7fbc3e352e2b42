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

/// What the stages of one name came to, of runs of one name. Stresses in Pa.
struct Outcome {
  std::string name;
  std::vector<double> loads;      ///< q before the hydrate changes
  std::vector<double> failed_at;  ///< sigma_3 where runs failed, or nothing was left of it
  std::vector<double> stood_at;   ///< and at the last rest before
  std::vector<double> stood_to;   ///< the least of those that came to rest in the end
};

/// Where a run failed under its load in a stage: p and q [Pa].
std::optional<std::pair<double, double>> failure_of(RunResults const& run, std::string const& stage) {
  std::string const at = "/stages/" + stage + "/";
  auto const p = run.number(at + "failed_p_Pa"), q = run.number(at + "failed_q_Pa");
  return p && q ? std::optional(std::pair{*p, *q}) : std::nullopt;
}

std::string end_of(RunResults const& run, std::string const& stage) {
  if (auto const loading = run.record.find("loading"); loading != run.record.end())
    for (auto const& end : *loading)
      if (end.value("stage", "") == stage) return end.value("ended_by", "");
  return {};
}

void add_outcome(std::vector<Outcome>& outcomes, std::string const& name, RunResults const& run, HydrateStageRows const& rows) {
  auto at = std::find_if(outcomes.begin(), outcomes.end(), [&](Outcome const& o) { return o.name == name; });
  if (at == outcomes.end()) at = outcomes.insert(outcomes.end(), Outcome{name, {}, {}, {}, {}});
  std::vector<double> const &sigma3 = run.history["sigma3_Pa"], &eps1 = run.history["eps1"];
  at->loads.push_back(run.history["q_Pa"][rows.before]);
  std::string const end = end_of(run, rows.stage);
  auto const failure = failure_of(run, rows.stage);
  if (failure || end == "no effective stress") {
    double const strain = run.number("/stages/" + rows.stage + "/failed_eps1").value_or(HUGE_VAL);
    std::size_t last = rows.before;
    while (last + 2 < rows.end && eps1[last + 1] < strain) ++last;
    at->failed_at.push_back(failure ? failure->first - failure->second / 2 : sigma3[rows.end - 1]);
    at->stood_at.push_back(sigma3[last]);
  } else if (end == "rest") {
    auto const from = sigma3.begin() + static_cast<std::ptrdiff_t>(rows.before);
    at->stood_to.push_back(*std::min_element(from, sigma3.begin() + static_cast<std::ptrdiff_t>(rows.end)));
  }
}

/// Where runs failed: a curve of one point each.
std::vector<Curve> failures_of(std::vector<RunResults> const& runs) {
  std::vector<Curve> failures;
  for (RunResults const& run : runs)
    for (HydrateStageRows const& rows : stages_that_change_hydrate(run))
      if (auto const failure = failure_of(run, rows.stage))
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
    curve.marked = rows.size() < 100;
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
  for (std::size_t r = 0; r < shown.runs.size(); ++r) {
    std::vector<HydrateStageRows> const stages = stages_that_change_hydrate(shown.runs[r]);
    for (HydrateStageRows const& rows : stages)
      add_outcome(outcomes, shown.style(r).name + (stages.size() > 1 ? ", " + rows.stage : ""), shown.runs[r], rows);
  }
  if (outcomes.empty()) return "";
  auto const stress = [](std::vector<double> const& values) {
    if (values.empty()) return std::string("–");
    return values.size() > 1 ? with_interval(values, mega) : fmt::format("{:.3g}", values.front() * mega);
  };
  std::vector<std::vector<std::string>> rows;
  for (Outcome const& o : outcomes) {
    double const load = mean_interval(o.loads).mean;
    rows.push_back({o.name, fmt::format("{:.3g}", load * mega),
                    sand ? fmt::format("{:.3g}", sand->lateral_stress(load) * mega) : std::string("–"),
                    fmt::format("{} of {}", o.failed_at.size(), o.loads.size()), stress(o.stood_at), stress(o.failed_at),
                    fmt::format("{} of {}", o.stood_to.size(), o.loads.size()), stress(o.stood_to)});
  }
  return "<p class=\"soft\">Stresses in MPa: the load, the lateral stress at which the sand alone bears it no more, and what "
         "became "
         "of the specimens. One failed between the stress at which it rested last and that at which its failure began; what "
         "neither "
         "failed nor came to rest was cut off by another end of its stage.</p>\n" +
         table({"test", "q", "σ₃ of the sand", "failed", "after rest at σ₃", "at σ₃", "came to rest", "least σ₃ of these"}, rows);
}

Piece hydrate_part(ShownRuns const& shown, std::optional<SandStrength> const& sand) {
  Piece figures = hydrate_figures(shown) + failure_figure(shown, sand);
  return figures.empty() ? "" : side_by_side(std::move(figures)) + failure_table(shown, sand);
}

}  // namespace clathra
