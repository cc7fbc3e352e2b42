#include "io/report/group_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string_view>

#include "io/report/markup.hpp"
#include "io/results/interval_text.hpp"
#include "io/results/shown_units.hpp"
#include "io/scene/schema.hpp"

namespace clathra {

std::vector<GroupCurves> curves_of_groups(Study const& study, std::vector<MemberResult> const& members,
                                          std::vector<std::filesystem::path> const& folders) {
  std::vector<GroupCurves> groups;
  for (std::size_t g = 0; g < study.groups.size(); ++g) {
    std::vector<std::filesystem::path> own;
    for (std::size_t i = 0; i < members.size(); ++i)
      if (members[i].group == g && members[i].state == MemberState::finished) own.push_back(folders[i]);
    if (own.empty()) continue;
    std::vector<RunResults> runs = read_runs(own);
    groups.push_back({study.groups[g].name, study.groups[g].settings, seed_bands(runs), run_stroke(groups.size()), {}});
    for (RunResults& run : runs)
      if (run.test_kind() != "biaxial") groups.back().other_tests.push_back(std::move(run));
  }
  return groups;
}

/// Whether a column says something: a clean sand has no bonds, and at constant volume only rounding is left of the strain.
bool says_something(GroupCurves const& group, ShownBand const& what) {
  SeedBand const& band = group.bands[what.column];
  return std::any_of(band.mean.begin(), band.mean.end(),
                     [&](double value) { return std::abs(value * what.axis.factor) > least_shown; });
}

/// Shares end at 100 %.
Axis axis_of(ShownBand const& what, Range const& values) {
  bool const share = possible_range(curve_columns[what.column]).most == percent;
  return share ? Axis{what.axis, 0, percent} : values.axis(what.axis);
}

Area area_of(GroupCurves const& group, ShownBand const& what) {
  SeedBand const& band = group.bands[what.column];
  return {group.name, band.eps1, band.low, band.high, group.stroke.colour, 0.22};
}

Curve mean_of(GroupCurves const& group, ShownBand const& what) {
  SeedBand const& band = group.bands[what.column];
  return {group.name, band.eps1, band.mean, group.stroke};
}

/// What the bands of a figure are, and that few seeds make them wide.
std::string note_on_bands(std::vector<GroupCurves> const& groups, ShownBand const& what) {
  constexpr std::size_t enough = 5;
  std::size_t fewest = std::numeric_limits<std::size_t>::max();
  bool cut = false;
  for (GroupCurves const& group : groups) {
    SeedBand const& band = group.bands[what.column];
    if (band.seeds.size() > 1 && says_something(group, what)) fewest = std::min(fewest, band.seeds.size()), cut |= band.cut;
  }
  if (fewest == std::numeric_limits<std::size_t>::max()) return " Lines: one seed, which has no interval.";
  std::string note = " Lines: mean over the seeds; bands: its 95 % confidence interval at each strain";
  note += cut ? ", as far as such values are possible." : ".";
  if (fewest >= enough) return note;
  auto const deviations = [](std::size_t seeds) { return students_half_width(1, static_cast<int>(seeds)); };
  return note + fmt::format(" Of {} seeds it is wide: {:.1f} standard deviations to either side; of {} it would be {:.1f}.",
                            fewest, deviations(fewest), enough, deviations(enough));
}

/// The means of all groups with their bands in one figure.
Piece overlay(std::vector<GroupCurves> const& groups, ShownBand const& what, std::vector<Curve> const& more) {
  Plot plot;
  Range strains, values;
  for (GroupCurves const& group : groups) {
    if (!says_something(group, what)) continue;
    plot.areas.push_back(area_of(group, what));
    plot.curves.push_back(mean_of(group, what));
    strains.include(plot.curves.back().x);
    values.include(plot.areas.back().low);
    values.include(plot.areas.back().high);
    plot.description += fmt::format("{}: {:.3g} at the end. ", group.name, plot.curves.back().y.back() * what.axis.factor);
  }
  if (plot.curves.empty()) return "";
  for (Curve const& curve : more) {
    strains.include(curve.x);
    values.include(curve.y);
    plot.curves.push_back(curve);
  }
  plot.title = std::string(what.heading) + ", mean over the seeds";
  plot.x = strains.exact_axis(axial_strain);
  plot.y = axis_of(what, values);
  return figure(what.heading, drawing(plot) + legend(plot.curves), what.caption + note_on_bands(groups, what));
}

std::string with_interval(std::vector<double> const& values, double factor) {
  return with_minus(interval_text(mean_interval(values), factor));
}

/// A number of the envelopes against the saturation, with its interval as a vertical line.
Piece strength_figure(std::vector<GroupNumbers> const& materials, std::string const& heading, Variable const& number,
                      std::vector<Curve> const& more) {
  Plot plot;
  Range saturations, values;
  PossibleRange const range = possible_range(number.column);
  std::vector<std::pair<double, MeanInterval>> points;
  for (GroupNumbers const& material : materials) {
    std::string const* const setting = value_in(material.settings, saturation_key);
    auto const found = material.values.find(number.column);
    if (!setting || found == material.values.end()) continue;
    double const value = std::atof(setting->c_str());
    points.emplace_back(setting->find('%') == std::string::npos ? value * percent : value, mean_interval(found->second));
  }
  std::set<double> distinct;
  for (auto const& [saturation, mean] : points) distinct.insert(saturation);
  if (distinct.size() < 2 || distinct.size() < points.size()) return "";  // several materials at one saturation have no one line
  std::sort(points.begin(), points.end(), [](auto const& a, auto const& b) { return a.first < b.first; });
  Curve means{"mean over the seeds", {}, {}, {colours::vermilion, ""}, true};
  for (auto const& [saturation, m] : points) {
    means.x.push_back(saturation);
    means.y.push_back(m.mean);
    plot.curves.push_back(
        {"95 % interval", {saturation, saturation}, {range.cut(m.low()), range.cut(m.high())}, {colours::dark, "", 2}});
    values.include(plot.curves.back().y);
    plot.description += fmt::format("{:g} % hydrate: {}. ", saturation, interval_text(m, number.factor));
  }
  saturations.include(means.x);
  values.include(means.y);
  plot.curves.push_back(std::move(means));
  for (Curve const& curve : more) {
    saturations.include(curve.x);
    values.include(curve.y);
    plot.curves.push_back(curve);
  }
  plot.title = heading + " against hydrate saturation";
  plot.x = saturations.axis(hydrate_saturation);
  plot.y = values.axis(number);
  return figure(plot.title, drawing(plot),
                "One envelope for each seed, fitted to its members at all confining stresses. Points: mean over the seeds; "
                "vertical lines: its 95 % confidence interval, as far as such values are possible.");
}

}  // namespace clathra
