#include "io/report/laboratory_overlay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "io/report/markup.hpp"
#include "io/results/shown_units.hpp"

namespace clathra {
namespace {

bool belongs_to(LaboratorySeries const& series, PageTest const& test) {
  constexpr double saturation_width = 0.5, stress_width = 0.05;
  return (!series.saturation || std::abs(*series.saturation - test.saturation) <= saturation_width) &&
         (!series.confining_stress ||
          std::abs(*series.confining_stress - test.confining_stress) <= stress_width * test.confining_stress);
}

Stroke stroke_of(std::size_t series) {
  static constexpr std::array<Rgb, 3> rgb{colours::black, Rgb{110, 110, 110}, Rgb{120, 80, 40}};
  return {rgb[series % rgb.size()], "1 4"};
}

}  // namespace

PageTest page_test(Scene const& scene) { return {percent * scene.hydrate.saturation, scene.test.confining_stress}; }

std::vector<PageTest> page_tests(std::vector<RunResults> const& runs) {
  std::vector<PageTest> tests;
  for (RunResults const& run : runs)
    tests.push_back(
        {percent * run.number("/scene/hydrate/saturation").value_or(0), run.number("/scene/test/confining_stress").value_or(0)});
  return tests;
}

LaboratoryOverlay::LaboratoryOverlay(LaboratoryData data, std::vector<PageTest> const& tests) : data_(std::move(data)) {
  shown_.resize(data_.series.size());
  for (LaboratorySeries const& series : data_.series)
    belongs_.push_back(std::any_of(tests.begin(), tests.end(), [&](PageTest const& test) { return belongs_to(series, test); }));
}

std::vector<Curve> LaboratoryOverlay::over(Variable const& x, Variable const& y) {
  std::vector<Curve> curves;
  for (std::size_t i = 0; i < data_.series.size(); ++i) {
    LaboratorySeries const& series = data_.series[i];
    if (!belongs_[i] || x.column != series.axes->x_column || y.column != series.axes->y_column) continue;
    curves.push_back({series.name, series.x, series.y, stroke_of(curves.size()), true});
    shown_[i] = true;
  }
  return curves;
}

std::string LaboratoryOverlay::note() const {
  std::string names;
  for (std::size_t i = 0; i < data_.series.size(); ++i)
    if (!shown_[i])
      names += fmt::format("{}{} ({}{})", names.empty() ? "" : ", ", data_.series[i].name, data_.series[i].axes->figure,
                           belongs_[i] ? ", for which there is no figure" : ", of another saturation or confining stress");
  return names.empty() ? "" : "<p class=\"soft\">Of " + escaped(data_.source) + " no figure shows: " + escaped(names) + ".</p>\n";
}

}  // namespace clathra
