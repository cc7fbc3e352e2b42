#include "io/report/map_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "domain/measurement/principal_axes.hpp"
#include "domain/measurement/strain_field.hpp"
#include "domain/measurement/test_numbers.hpp"
#include "io/report/curves.hpp"
#include "io/report/drawn_picture.hpp"
#include "io/report/grading_figure.hpp"
#include "io/report/maps.hpp"
#include "io/report/markup.hpp"
#include "io/report/rose_diagrams.hpp"
#include "io/results/shown_units.hpp"
#include "io/results/snapshot_file.hpp"

namespace clathra {
namespace {

/// A run's snapshots as they are shown, with the view that they share.
struct Shown {
  RunResults const& run;
  std::size_t bytes;
  std::vector<Snapshot> snapshots;
  bool passed_peak = false;
  std::size_t peak = 0;  ///< the one nearest to the peak, or to the largest q so far
  MapView view;
  std::vector<std::filesystem::path> files;

  Snapshot const& first() const { return snapshots.front(); }
  Snapshot const& last() const { return snapshots.back(); }
  std::filesystem::path const& file_of(Snapshot const& s) const { return files[static_cast<std::size_t>(&s - snapshots.data())]; }
};

/// The grains in the middle, at the start and at the end.
Piece detail_pictures(Shown const& shown) {
  constexpr double detail_grains = 13, pixels_per_grain = 55;
  std::vector<Snapshot const*> ends{&shown.first()};
  if (shown.snapshots.size() > 1) ends.push_back(&shown.last());
  Piece pictures;
  for (Snapshot const* const at : ends) {
    MapView const view = detail_of(*at, detail_grains);
    std::string const text = fmt::format("middle, {:.2g} mm wide, at {}", view.width * milli, strain_text(*at));
    Picture const detail{view,
                         mean_diameter(*at),
                         fmt::format("Grains and bonds in the middle at {}, {}", strain_text(*at), run_label(shown.run)),
                         [at](MapView const& v) { return detail_map(*at, v); },
                         particles_behind(shown.file_of(*at), text, view),
                         pixels_per_grain};
    pictures += titled(drawn(detail, shown.bytes), text);
  }
  return pictures;
}

Piece specimen_figure(Shown const& shown) {
  Snapshot const& s = shown.first();
  auto const [least, most] = std::minmax_element(s.radius.begin(), s.radius.end());
  std::string const text = fmt::format("{:.3g} mm wide, {:.3g} mm high, at {}", (s.right - s.left) * milli,
                                       (s.top - s.bottom) * milli, strain_text(s));
  Picture const grains{shown.view, mean_diameter(s), "Grains of the specimen by size, " + run_label(shown.run),
                       [&](MapView const& view) { return grain_map(s, view); },
                       particles_behind(shown.file_of(s), text, shown.view)};
  Piece entries = patch_entry(map_colours::grain, "grain");
  std::string caption = fmt::format(
      "The {} particles at the start of the shear, coloured by their size, and the grains in the middle of the specimen",
      grouped(static_cast<double>(s.x.size())));
  if (shown.run.has_bonds()) {
    entries += patch_entry(map_colours::hydrate, "hydrate") + patch_entry(colours::dark, "bond that holds") + mode_entries();
    caption +=
        ". Hydrate is drawn in the width of its bond, with a line on each bond that holds and a coloured mark where one broke";
  }
  Piece const size_bar = colour_bar("diameter", fmt::format("{:.3g} mm", 2 * milli * double(*least)),
                                    fmt::format("{:.3g} mm", 2 * milli * double(*most)));
  return figure(
      "The specimen",
      strip(titled(drawn(grains, shown.bytes), text) + stack(detail_pictures(shown))) + size_bar + legend(std::move(entries)),
      caption + ".", true);
}

Piece bond_figure(Shown const& shown) {
  if (!shown.run.has_bonds()) return "";
  Piece pictures;
  for (Snapshot const& s : shown.snapshots) {
    auto const broken = std::count_if(s.state.begin(), s.state.end(), [](std::uint8_t state) { return state > std::uint8_t{1}; });
    pictures += titled(drawn({shown.view, mean_diameter(s),
                              fmt::format("Intact and broken bonds at {}, {}", strain_text(s), run_label(shown.run)),
                              [&](MapView const& view) { return bond_map(s, view); },
                              pairs_behind(shown.file_of(s), strain_text(s), ShownPairs::bonds)},
                             shown.bytes),
                       fmt::format("{}, {} broken", strain_text(s), grouped(static_cast<double>(broken))));
  }
  return figure("Bonds", strip(pictures) + legend(patch_entry(colours::grey, "intact bond") + mode_entries()),
                "Each line is a bond between two grains: thin and grey while it holds, thick and coloured by what broke it "
                "afterwards, at the place where its two grains are now. Broken bonds line up where the specimen shears.",
                true);
}

Piece force_figure(Shown const& shown) {
  Snapshot const& s = shown.snapshots[shown.peak];
  Piece image =
      drawn({view_of({&s}), mean_diameter(s), fmt::format("Normal forces at {}, {}", strain_text(s), run_label(shown.run)),
             [&](MapView const& view) { return force_map(s, view); },
             pairs_behind(shown.file_of(s), strain_text(s), ShownPairs::forces)},
            shown.bytes);
  Piece entries =
      patch_entry(map_colours::pressing, "pressing, above the mean") + patch_entry(map_colours::weak, "pressing, below the mean");
  if (shown.run.has_bonds()) entries += patch_entry(map_colours::pulling, "pulling");
  return figure(
      "Force chains", strip(titled(std::move(image), strain_text(s))) + legend(std::move(entries)),
      fmt::format("How the load finds its way through the grains {}: a line from centre to centre of two grains, as wide as the "
                  "normal force between them is large.",
                  shown.passed_peak ? "near the peak" : "near the largest q so far, which no peak follows yet"));
}

Piece strain_figure(Shown const& shown) {
  Snapshot const& s = shown.last();
  std::vector<float> const values = shear_strain(s);
  double const most = upper_end(values);
  if (!(most > 0)) return "";
  Piece image =
      drawn({view_of({&s}), mean_diameter(s), fmt::format("Shear strain at {}, {}", strain_text(s), run_label(shown.run)),
             [&](MapView const& view) { return value_map(s, values, most, view); },
             particles_behind(shown.file_of(s), strain_text(s), shown.view, "shear_strain", values)},
            shown.bytes);
  return figure(
      "Where it sheared",
      strip(titled(std::move(image), strain_text(s))) +
          colour_bar("shear strain", "0 %", fmt::format("{:g} % and more", most * percent)),
      fmt::format("The shear strain that each place has gone through by then: the difference of the principal natural "
                  "strains, averaged over {:g} grain diameters. Were it the same everywhere, it would be {:.3g} %; bands "
                  "stand out.",
                  strain_window, (2 * s.eps1 - s.eps_v) * percent));
}

Piece rose_figure(Shown const& shown) {
  Snapshot const& s = shown.snapshots[shown.peak];
  Rose const now = rose_of(s, ContactSet::mechanical), before = rose_of(shown.first(), ContactSet::mechanical);
  if (now.pairs == 0) return "";
  PrincipalAxes const stress = principal_stress(s);
  std::string const label = run_label(shown.run) + ", " + strain_text(s);
  constexpr double to_degrees = 180 / std::numbers::pi;
  return figure(
      "Directions of contacts and forces",
      strip(titled(normal_rose(now, before, label), "number of contacts") +
            titled(force_rose(now, before, label), "mean normal force")),
      fmt::format(
          "How many of the {} pairs that press or hold each other point in each direction, and how large their mean normal force "
          "is "
          "there, both relative to the mean over all directions (ring 1), at {}. Dashed: at the start. Red line: the fit "
          "1 + a cos 2(θ − θₐ), with a = {:.2f} at θₐ = {:.0f}° for the contacts and a = {:.2f} at {:.0f}° for the forces; "
          "90° is vertical. The mean stress of the grains is {:.4g} and {:.4g} MPa, the larger one at {:.0f}°.",
          grouped(static_cast<double>(now.pairs)), strain_text(s), now.fabric.anisotropy(), now.fabric.direction * to_degrees,
          now.force_anisotropy, now.force_direction * to_degrees, stress.major * 1e-6, stress.minor * 1e-6,
          stress.direction * to_degrees));
}

/// A snapshot's file is named by its step.
std::int64_t step_of(std::filesystem::path const& file) { return std::atoll(file.stem().c_str()); }

Shown read_shown(RunResults const& run, std::size_t bytes) {
  std::vector<std::int64_t> steps;
  for (std::filesystem::path const& file : run.snapshots) steps.push_back(step_of(file));
  TestNumbers const numbers = run.has_peak() ? test_numbers(run.history.curves()) : TestNumbers();
  auto const peak_step = static_cast<std::int64_t>(run.history["step"][numbers.peak]);
  std::vector<std::size_t> const which = shown_snapshots(steps, peak_step);
  Shown shown{run, bytes, {}, numbers.passed_peak, which.size() > 1 ? std::size_t{1} : std::size_t{0}, {}, {}};
  if (which.size() == 2 && std::abs(steps[which[0]] - peak_step) < std::abs(steps[which[1]] - peak_step)) shown.peak = 0;
  std::vector<Snapshot const*> all;
  for (std::size_t const i : which) shown.files.push_back(run.snapshots[i]);
  for (std::filesystem::path const& file : shown.files) shown.snapshots.push_back(read_snapshot(file));
  for (Snapshot const& s : shown.snapshots) all.push_back(&s);
  shown.view = view_of(all);
  return shown;
}

}  // namespace

std::vector<std::size_t> shown_snapshots(std::vector<std::int64_t> const& steps, std::int64_t peak_step) {
  auto const nearest = std::min_element(steps.begin(), steps.end(), [&](std::int64_t a, std::int64_t b) {
    return std::abs(a - peak_step) < std::abs(b - peak_step);
  });
  std::vector<std::size_t> which{0, static_cast<std::size_t>(nearest - steps.begin()), steps.size() - 1};
  which.erase(std::unique(which.begin(), which.end()), which.end());
  return which;
}

MapFigures map_figures(RunResults const& run, Stroke const& stroke, std::size_t bytes) {
  Shown const shown = read_shown(run, bytes);
  MapFigures result;
  result.figures = specimen_figure(shown) + bond_figure(shown) + force_figure(shown) + strain_figure(shown) + rose_figure(shown);
  result.grading = grading_curve(shown.first().radius, run_label(run), stroke);
  return result;
}

}  // namespace clathra
