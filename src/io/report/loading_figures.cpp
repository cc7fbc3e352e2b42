#include "io/report/loading_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "domain/scene/loading_stage.hpp"
#include "domain/scene/scene.hpp"
#include "io/report/curves.hpp"
#include "io/report/markup.hpp"
#include "io/report/plot.hpp"
#include "io/report/response_envelope.hpp"
#include "io/results/run_record.hpp"
#include "io/results/shown_units.hpp"
#include "io/results/stage_numbers.hpp"

namespace clathra {

std::vector<LoadingStage> stages_of_run(RunResults const& run) {
  auto const scene = run.record.find("scene");
  if (scene == run.record.end()) return {};
  try {
    return stages_of(scene_of(*scene));
  } catch (std::exception const&) {  // a record with holes: its curves are drawn all the same
    return {};
  }
}

namespace {

bool is_compression_alone(RunResults const& run) { return run.test_kind() == "biaxial"; }

/// The rows of the stages that a question says yes to.
template <class Wanted>
std::vector<std::size_t> rows_where(RunResults const& run, Wanted const& wanted) {
  std::vector<std::size_t> rows;
  std::vector<LoadingStage> const stages = stages_of_run(run);
  for (std::size_t i = 0; i < run.history.rows(); ++i)
    for (LoadingStage const& stage : stages)
      if (stage.name == run.history.stages()[i] && wanted(stage)) rows.push_back(i);
  return rows;
}

/// Columns of those rows. @param curve  its name and stroke;  @param x,y  functions of (history, row)
template <class Wanted, class X, class Y>
Curve curve_where(RunResults const& run, Curve curve, Wanted const& wanted, X const& x, Y const& y) {
  for (std::size_t const i : rows_where(run, wanted)) {
    double const at = x(run.history, i), value = y(run.history, i);
    if (!std::isfinite(at) || !std::isfinite(value)) continue;
    curve.x.push_back(at);
    curve.y.push_back(value);
  }
  return curve;
}

auto column(char const* name) {
  return [name](HistoryTable const& history, std::size_t i) { return history[name][i]; };
}

/// Draws curves of two points and more over two axes that hold zero.
Piece figure_of(ShownRuns const& shown, char const* heading, char const* title, Variable const& x, Variable const& y,
                std::vector<Curve> curves, std::string const& caption) {
  std::erase_if(curves, [](Curve const& curve) { return curve.x.size() < 2; });
  if (curves.empty()) return "";
  for (Curve& points : shown.data.over(x, y)) curves.push_back(std::move(points));
  Plot plot;
  Range over, values;
  for (Curve const& curve : curves) {
    over.include(curve.x);
    values.include(curve.y);
    plot.description += fmt::format("{}: {:.3g} at {:.3g}, {:.3g} at {:.3g} at the end. ", curve.name, curve.y.front() * y.factor,
                                    curve.x.front() * x.factor, curve.y.back() * y.factor, curve.x.back() * x.factor);
  }
  plot.title = title;
  plot.curves = std::move(curves);
  plot.x = over.axis(x);
  plot.y = values.axis(y);
  return figure(heading, drawing(plot) + legend(plot.curves), caption);
}

template <class Wanted, class X, class Y>
std::vector<Curve> curves_where(ShownRuns const& shown, Wanted const& wanted, X const& x, Y const& y) {
  std::vector<Curve> curves;
  for (std::size_t i = 0; i < shown.runs.size(); ++i)
    if (!is_compression_alone(shown.runs[i])) curves.push_back(curve_where(shown.runs[i], shown.style(i), wanted, x, y));
  return curves;
}

bool any_stage(LoadingStage const&) { return true; }
bool is_put_on(LoadingStage const& stage) { return stage.has_stress_only() && stage.increments > 1 && !stage.hydrate.any(); }
bool is_one_dimensional(LoadingStage const& stage) { return stage.vertical.has_stress() && stage.lateral.hold; }
bool is_undrained(LoadingStage const& stage) { return stage.lateral.follow == Follow::constant_volume; }
bool is_dead_load(LoadingStage const& stage) { return stage.vertical.has_stress() && stage.increments == 1; }
bool is_sheared(LoadingStage const& stage) { return stage.vertical.has_rate(); }

Piece stress_path(ShownRuns const& shown) {
  return figure_of(
      shown, "Stress path", "Deviator stress against mean stress", {"mean stress p [MPa]", "p_Pa", mega},
      {"deviator stress q [MPa]", "q_Pa", mega}, curves_where(shown, any_stage, column("p_Pa"), column("q_Pa")),
      "Effective stresses on the walls: p = (σ₁ + σ₃)/2 and q = σ₁ − σ₃ with σ₁ vertical and σ₃ lateral, whichever is "
      "larger. In the notation of MIT s is p and t is q/2. A path under constant lateral stress rises at 2 to 1.");
}

/// Void ratio over the logarithm of the stress that was put on.
Piece void_ratio_figure(ShownRuns const& shown) {
  Variable const stress{"vertical stress σ₁ [MPa], logarithmic", "sigma1_Pa", mega}, ratio{"void ratio e", "void_ratio"};
  std::vector<Curve> curves = curves_where(
      shown, is_put_on, [](HistoryTable const& history, std::size_t i) { return history["sigma1_Pa"][i]; }, column("void_ratio"));
  std::erase_if(curves, [](Curve const& curve) { return curve.x.size() < 2; });
  if (curves.empty()) return "";
  for (Curve& points : shown.data.over(stress, ratio)) curves.push_back(std::move(points));
  double least = HUGE_VAL, most = -HUGE_VAL, densest = HUGE_VAL, loosest = -HUGE_VAL;
  Plot plot;
  for (Curve& curve : curves) {
    curve.marked = curve.x.size() < 100;
    auto const [low, high] = std::minmax_element(curve.x.begin(), curve.x.end());
    auto const [dense, loose] = std::minmax_element(curve.y.begin(), curve.y.end());
    least = std::min(least, *low), most = std::max(most, *high);
    densest = std::min(densest, *dense), loosest = std::max(loosest, *loose);
    plot.description += fmt::format("{}: e {:.4g} at {:.3g} MPa, {:.4g} at {:.3g} MPa, {:.4g} at the end. ", curve.name,
                                    curve.y.front(), curve.x.front() * mega, *dense, *high * mega, curve.y.back());
  }
  if (!(0 < least && least < most && densest < loosest)) return "";
  double const step = tick_step(densest, loosest, 5);
  plot.title = "Void ratio against vertical stress";
  plot.curves = std::move(curves);
  plot.x = {stress, least * mega, 1.0001 * most * mega, true};
  plot.y = {ratio, std::floor(densest / step) * step, std::ceil(loosest / step) * step};
  return figure(
      "Compression", drawing(plot) + legend(plot.curves),
      "The void ratio e at rest under each increment of the stress, on the way up and on the way down. Where the lateral "
      "stress is put on alike, σ₁ is p.");
}

Piece lateral_stress(ShownRuns const& shown) {
  return figure_of(
      shown, "Lateral stress at rest", "Lateral stress against vertical stress", {"vertical stress σ₁ [MPa]", "sigma1_Pa", mega},
      {"lateral stress σ₃ [MPa]", "sigma3_Pa", mega},
      curves_where(shown, is_one_dimensional, column("sigma1_Pa"), column("sigma3_Pa")),
      "Compressed without lateral strain: the slope is the coefficient of earth pressure at rest K₀ = dσ₃/dσ₁. After "
      "unloading the lateral stress stays behind.");
}

Piece pore_pressure(ShownRuns const& shown) {
  auto const u = [](HistoryTable const& history, std::size_t i) { return history["sigma3_Pa"][0] - history["sigma3_Pa"][i]; };
  return figure_of(
      shown, "Pore pressure", "Pore pressure against axial strain", axial_strain, {"pore pressure u [MPa]", "u_Pa", mega},
      curves_where(shown, is_undrained, column("eps1"), u),
      "What the pore water would have to carry at constant volume under a constant total lateral stress: u = σ₃ at the "
      "beginning − σ₃. It rises where the sand would contract, and falls where it would dilate.");
}

Piece stress_ratio(ShownRuns const& shown) {
  auto const ratio = [](HistoryTable const& history, std::size_t i) { return history["q_Pa"][i] / history["p_Pa"][i]; };
  return figure_of(shown, "Stress ratio", "Stress ratio against axial strain", axial_strain, {"stress ratio q/p", "q_over_p"},
                   curves_where(shown, is_sheared, column("eps1"), ratio),
                   "q/p = 2 sin φ of the friction that is mobilised, where there is no cohesion.");
}

Piece dead_load(ShownRuns const& shown) {
  return figure_of(shown, "Strain under the dead load", "Axial strain against time", {"time [ms]", "time_s", milli}, axial_strain,
                   curves_where(shown, is_dead_load, column("time_s"), column("eps1")),
                   "Nothing in the bonds knows a clock: the specimen either comes to rest or fails. The platens have a largest "
                   "speed, so that a collapse is paced by them.");
}

}  // namespace

Piece dilatancy_figure(ShownRuns const& shown) {
  constexpr double stretch = 0.005;
  std::vector<Curve> curves;
  for (std::size_t i = 0; i < shown.runs.size(); ++i) {
    Curve curve = shown.style(i);
    HistoryTable const& history = shown.runs[i].history;
    std::vector<double> const &eps1 = history["eps1"], &eps_v = history["eps_v"], &q = history["q_Pa"], &p = history["p_Pa"];
    std::vector<std::size_t> const rows = rows_where(shown.runs[i], [](LoadingStage const& stage) {
      return stage.name == shear_stage && stage.lateral.follow != Follow::constant_volume;
    });
    for (std::size_t from = 0, to = 0; to < rows.size(); ++to) {
      while (from < to && eps1[rows[to]] - eps1[rows[from + 1]] >= stretch) ++from;
      std::size_t const a = rows[from], b = rows[to];
      if (double const shear = 2 * (eps1[b] - eps1[a]) - (eps_v[b] - eps_v[a]);
          eps1[b] - eps1[a] >= stretch && shear > 0 && std::isfinite(q[a] / p[a] + q[b] / p[b])) {
        curve.x.push_back(-(eps_v[b] - eps_v[a]) / shear);
        curve.y.push_back(0.5 * (q[a] / p[a] + q[b] / p[b]));
      }
    }
    curves.push_back(std::move(curve));
  }
  return figure_of(
      shown, "Stress and dilatancy", "Stress ratio against dilatancy", {"dilatancy −dεᵥ/dγ", "dilatancy"},
      {"stress ratio q/p", "q_over_p"}, std::move(curves),
      "How fast the specimen widens as it is sheared, over stretches of 0.5 % of axial strain, and the stress ratio in "
      "their middle; γ = ε₁ − ε₃. Rowe's relation is a rising line: sand bears more while it dilates.");
}

Piece loading_figures(ShownRuns const& shown) {
  return response_envelopes(shown) + stress_path(shown) + void_ratio_figure(shown) + lateral_stress(shown) +
         pore_pressure(shown) + stress_ratio(shown) + dead_load(shown);
}

namespace {

struct ShownNumber {
  char const *of, *shown;
  double factor;
  char const* unit;
};

constexpr ShownNumber of_course[] = {{"path", "path", percent, " %"},
                                     {"start_sigma1_Pa", "σ₁ at the beginning", mega, " MPa"},
                                     {"end_sigma1_Pa", "σ₁ at the end", mega, " MPa"},
                                     {"start_sigma3_Pa", "σ₃ at the beginning", mega, " MPa"},
                                     {"end_sigma3_Pa", "σ₃ at the end", mega, " MPa"},
                                     {"end_void_ratio", "e at the end", 1, ""}};
constexpr ShownNumber of_behaviour[] = {{"bulk_modulus_Pa", "bulk modulus", mega, " MPa"},
                                        {"constrained_modulus_Pa", "M<sub>oed</sub>", mega, " MPa"},
                                        {"k0", "K₀ at the end", 1, ""},
                                        {"k0_of_increments", "K₀ of the increments", 1, ""},
                                        {"secant_stiffness_Pa", "E<sub>ur</sub>", mega, " MPa"},
                                        {"damping_ratio", "damping ratio of the last loop", percent, " %"},
                                        {"strain_per_cycle", "strain a cycle", percent, " %"},
                                        {"largest_pore_pressure_ratio", "largest r<sub>u</sub>", 1, ""},
                                        {"phase_transformation_eps1", "phase transformation at ε₁", percent, " %"},
                                        {"peak_q_Pa", "largest q", mega, " MPa"},
                                        {"largest_q_Pa", "largest q", mega, " MPa"},
                                        {"failed_eps1", "failed at ε₁", percent, " %"}};

template <std::size_t count>
std::string number_lines(nlohmann::json const& stage, ShownNumber const (&numbers)[count]) {
  std::string text;
  for (ShownNumber const& n : numbers)
    if (auto const found = stage.find(n.of); found != stage.end() && found->is_number())
      text += fmt::format("{} {:.4g}{}<br>", n.shown, found->template get<double>() * n.factor, n.unit);
  return text;
}

std::string stage_row(std::string const& name, std::string const& ended_by, nlohmann::json const& stage) {
  auto const verdict = stage.find("quasi_static");
  bool const is_quasi_static = verdict == stage.end() || *verdict != 0;
  return fmt::format("<tr><th>{}</th><td>{}{}</td><td>{}</td><td>{}</td></tr>\n", escaped(name),
                     ended_by.empty() ? "not ended" : escaped(ended_by), is_quasi_static ? "" : "<br>not quasi-static",
                     number_lines(stage, of_course), number_lines(stage, of_behaviour));
}

}  // namespace

Piece stage_tables(std::vector<RunResults> const& runs) {
  std::string text;
  for (RunResults const& run : runs) {
    auto const stages = run.record.find("stages"), loading = run.record.find("loading");
    if (is_compression_alone(run) || stages == run.record.end() || loading == run.record.end()) continue;
    std::string rows;
    for (auto const& end : *loading)
      if (std::string const name = end.value("stage", ""); stages->contains(name))
        rows += stage_row(name, end.value("ended_by", ""), stages->at(name));
    text += (runs.size() > 1 ? "<h3>" + escaped(run_label(run)) + "</h3>\n" : "") +
            "<div class=\"scroll\"><table><thead><tr><th>stage</th><th>ended by</th><th>course</th><th>numbers</th></tr></thead>"
            "<tbody>\n" +
            rows + "</tbody></table></div>\n";
  }
  return text;
}

}  // namespace clathra
