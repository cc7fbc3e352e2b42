#include "io/report/grading_figure.hpp"

#include <algorithm>
#include <cmath>

#include "domain/scene/grading.hpp"
#include "io/report/markup.hpp"
#include "io/results/shown_units.hpp"

namespace clathra {
namespace {

constexpr Variable diameter{"diameter [mm], logarithmic", "diameter_m", 1e3};

/// An axis over the diameters of all curves, with some room at both ends.
Axis diameter_axis(std::vector<Curve> const& curves) {
  double low = curves.front().x.front(), high = curves.front().x.back();
  for (Curve const& curve : curves) {
    low = std::min(low, curve.x.front());
    high = std::max(high, curve.x.back());
  }
  return {diameter, low * diameter.factor / 1.25, high * diameter.factor * 1.25, true};
}

}  // namespace

Curve grading_curve(std::vector<float> const& radii, std::string const& name, Stroke const& stroke) {
  std::vector<float> sorted = radii;
  std::sort(sorted.begin(), sorted.end());
  double total = 0, finer = 0;
  for (float const r : sorted) total += double(r) * double(r);
  Curve curve{name, {}, {}, stroke};
  std::size_t const stride = std::max<std::size_t>(1, sorted.size() / 500);
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    if (i % stride == 0 || i + 1 == sorted.size()) {
      curve.x.push_back(2 * double(sorted[i]));
      curve.y.push_back((i + 1 == sorted.size() ? 1 : finer / total) * percent);
    }
    finer += double(sorted[i]) * double(sorted[i]);
  }
  return curve;
}

std::optional<Curve> target_curve(RunResults const& run) {
  if (run.text("/scene/grading/file").value_or("") != "" || run.text("/scene/specimen/file").value_or("?") != "")
    return std::nullopt;
  GradingScene scene;
  scene.table = run.text("/scene/grading/table").value_or(scene.table);
  scene.d50 = run.number("/scene/grading/d50").value_or(0);
  Grading const grading = Grading::of(scene);
  Curve curve{"asked for", {}, {}, {colours::black, "2 3", 3}};
  constexpr int points = 100;
  for (int i = 0; i <= points; ++i) {
    curve.x.push_back(grading.smallest() * std::pow(grading.largest() / grading.smallest(), double(i) / points));
    curve.y.push_back(grading.finer_than(curve.x.back()) * percent);
  }
  return curve;
}

Piece grading_figure(std::string const& title, std::vector<Curve> const& curves) {
  Plot plot;
  plot.title = title;
  plot.description = "Percent of the mass in finer grains against the diameter.";
  plot.x = diameter_axis(curves);
  plot.y = {{"finer by mass [%]", "finer_by_mass_pct"}, 0, percent};
  plot.curves = curves;
  return figure(
      plot.title, drawing(plot) + legend(curves),
      "The share of the mass that is in particles finer than a diameter, as a sieve analysis would give it. In two dimensions "
      "mass goes with the area of a particle.");
}

}  // namespace clathra
