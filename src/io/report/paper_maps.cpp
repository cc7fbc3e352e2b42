/// Pictures on the page on Jiang et al. (2017): one test, 55 % at 3 MPa, of the first seed that has it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "domain/measurement/fabric.hpp"
#include "domain/measurement/shear_band.hpp"
#include "domain/measurement/strain_field.hpp"
#include "io/report/drawn_picture.hpp"
#include "io/report/grading_figure.hpp"
#include "io/report/markup.hpp"
#include "io/report/paper_figures.hpp"
#include "io/report/rose_diagrams.hpp"
#include "io/results/snapshot_file.hpp"

namespace clathra {
namespace {

constexpr double percent = 100, degrees = 180 / std::numbers::pi;
constexpr std::size_t picture_bytes = 220'000;

/// The snapshots of the test at the strains that the paper shows.
struct Looked {
  Snapshot start;
  std::vector<Snapshot> at;  ///< 2.54, 3.38, 6.71, 15.04 %
  std::filesystem::path start_file;
  std::vector<std::filesystem::path> files;  ///< of `at`
};

std::optional<Looked> looked_at(Reproduction const& r) {
  for (std::size_t i = 0; i < r.members.size(); ++i) {
    if (r.members[i].state != MemberState::finished || r.study.groups[r.members[i].group].name != paper_cell(55, 3)) continue;
    Looked looked;
    for (std::filesystem::path const& file : snapshot_files(r.folders[i])) {
      Snapshot snapshot = read_snapshot(file);
      constexpr double near = 5e-4;
      bool const shown = std::any_of(std::begin(paper_strains), std::end(paper_strains),
                                     [&](double strain) { return std::abs(snapshot.eps1 - strain) < near; });
      if (snapshot.eps1 == 0) {
        looked.start = std::move(snapshot);
        looked.start_file = file;
      } else if (shown) {
        looked.at.push_back(std::move(snapshot));
        looked.files.push_back(file);
      }
    }
    if (!looked.start.x.empty() && !looked.at.empty()) return looked;
  }
  return {};
}

Piece grading_of(Looked const& looked) {
  return grading_figure("Figure 9: Grading", {grading_curve(looked.start.radius, "our particles", run_stroke(0))});
}

Piece specimen_of(Looked const& looked) {
  Snapshot const& s = looked.start;
  Piece image = drawn(
      {view_of({&s}), mean_diameter(s), "Grains of the specimen by size", [&](MapView const& view) { return grain_map(s, view); },
       particles_behind(looked.start_file, strain_text(s), view_of({&s}))},
      picture_bytes);
  return figure(
      "Figure 10: Specimen", strip(std::move(image)),
      beside_words("20,000 particles, 26.5 mm by 53 mm.",
                   fmt::format("{} particles, {:.3g} mm by {:.3g} mm under 3 MPa.", grouped(static_cast<double>(s.x.size())),
                               1e3 * (s.right - s.left), 1e3 * (s.top - s.bottom))));
}

Piece bonds_of(Looked const& looked) {
  Piece pictures;
  for (std::size_t i = 0; i < looked.at.size(); ++i) {
    Snapshot const& s = looked.at[i];
    pictures += titled(drawn({view_of({&s}), mean_diameter(s), "Intact and broken bonds at " + strain_text(s),
                              [&](MapView const& view) { return bond_map(s, view); },
                              pairs_behind(looked.files[i], strain_text(s), ShownPairs::bonds)},
                             picture_bytes),
                       strain_text(s));
  }
  return figure("Figure 18b: Bonds", strip(pictures) + legend(patch_entry(colours::grey, "intact bond") + mode_entries()),
                beside_words("a shear band develops in which most bonds break as the strain grows.", ""), true);
}

/// A field of shear strain at each of the strains, and the bands fitted to it where the grains were at first.
struct ShownField {
  std::string name;
  std::vector<std::vector<float>> at_discs;
  std::vector<BandAt> bands;
};

ShownField grain_field(Looked const& looked) {
  ShownField field{"grain by grain", {}, {}};
  for (Snapshot const& s : looked.at) {
    StrainGrid const grid = grain_strain(looked.start, s);
    field.at_discs.push_back(shear_at_discs(grid, s));
    field.bands.push_back({s.eps1, fit_band(grid.x, grid.y, grid.shear, s.d50, grid.smoothing)});
  }
  return field;
}

ShownField averaged_field(Looked const& looked) {
  ShownField field{fmt::format("over {:g} grain diameters", strain_window), {}, {}};
  for (Snapshot const& s : looked.at) {
    field.at_discs.push_back(shear_strain(s));
    std::vector<double> x = s.x, y = s.y;
    for (std::size_t i = 0; i < x.size(); ++i) x[i] -= double(s.ux[i]), y[i] -= double(s.uy[i]);
    field.bands.push_back({s.eps1, fit_band(x, y, field.at_discs.back(), s.d50, smoothing_of_shear_strain(s))});
  }
  return field;
}

/// The field at all strains in the colours of the last one.
Piece field_strip(Looked const& looked, ShownField const& field) {
  double const most = upper_end(field.at_discs.back());
  if (!(most > 0)) return "";
  Piece pictures;
  for (std::size_t i = 0; i < looked.at.size(); ++i) {
    Snapshot const& s = looked.at[i];
    pictures += titled(drawn({view_of({&s}), mean_diameter(s), "Shear strain " + field.name + " at " + strain_text(s),
                              [&](MapView const& view) { return value_map(s, field.at_discs[i], most, view); },
                              particles_behind(looked.files[i], field.name + " at " + strain_text(s), view_of({&s}),
                                               "shear_strain", field.at_discs[i])},
                             picture_bytes),
                       strain_text(s));
  }
  return strip(pictures) + colour_bar("shear strain, " + field.name, "0 %", fmt::format("{:g} % and more", most * percent));
}

std::string bands_table(std::vector<ShownField> const& fields, double d50) {
  std::vector<std::vector<std::string>> rows;
  for (ShownField const& field : fields)
    for (auto const& [eps1, band] : field.bands) {
      std::vector<std::string> cells{field.name, fmt::format("{:.2f} %", eps1 * percent)};
      if (band)
        for (std::string const& cell :
             {fmt::format("{:.0f}°", band->inclination * degrees), fmt::format("{:.1f} d50", band->thickness / d50),
              fmt::format("{:.1f} d50", band->gaussian_deviation / d50), fmt::format("{:.1f} %", band->inside * percent),
              with_minus(fmt::format("{:.1f} %", band->outside * percent)), fmt::format("{:.0f} %", band->explained * percent)})
          cells.push_back(cell);
      cells.resize(8, "–");
      rows.push_back(cells);
    }
  return table({"shear strain", "ε₁", "inclination", "thickness", "deviation of the Gaussian", "inside", "beside", "explained"},
               rows);
}

std::string onset_text(ShownField const& field) {
  std::optional<double> const onset = band_onset(field.bands);
  return field.name + (onset ? fmt::format(" from ε₁ = {:.2g} % on", *onset * percent) : " none");
}

Piece strains_of(Looked const& looked) {
  std::vector<ShownField> const fields{grain_field(looked), averaged_field(looked)};
  Piece pictures;
  for (ShownField const& field : fields) pictures += field_strip(looked, field);
  if (pictures.empty()) return "";
  return figure(
      "Figure 20: Shear strain", pictures + bands_table(fields, looked.start.d50),
      beside_words(
          "a concentrated band forms and grows thicker.",
          fmt::format(
              "above, as in the paper, nodes d50 apart ride on the nearest grain and turn with it: E₁ − E₂ of "
              "Green's strain. Below, the difference of the principal natural strains, fitted over {:g} grain "
              "diameters. The table has the best band of each, measured where the grains were at first. A band that lasts, "
              "with twice the strain beside it or more and its direction until the end: {}, {}.",
              strain_window, onset_text(fields[0]), onset_text(fields[1]))),
      true);
}

constexpr std::pair<ContactSet, char const*> contact_sets[] = {
    {ContactSet::touching, "touching"}, {ContactSet::mechanical, "touching or bonded"}, {ContactSet::bonded, "bonded"}};

/// Start, 2.54 % and the end: the strains of the paper's Fig. 21.
std::vector<Snapshot const*> fabric_snapshots(Looked const& looked) {
  std::vector<Snapshot const*> shown{&looked.start, &looked.at.front()};
  if (looked.at.size() > 1) shown.push_back(&looked.at.back());
  return shown;
}

std::string fabric_table(Looked const& looked) {
  std::vector<std::vector<std::string>> rows;
  for (auto const& [set, name] : contact_sets)
    for (Snapshot const* const s : fabric_snapshots(looked)) {
      Rose const rose = rose_of(*s, set);
      if (rose.pairs == 0) continue;
      rows.push_back({name, fmt::format("{:.2f} %", s->eps1 * percent), grouped(static_cast<double>(rose.pairs)),
                      fmt::format("{:.3f}", rose.fabric.anisotropy()), fmt::format("{:.3f}", rose.fabric.deviator),
                      fmt::format("{:.0f}°", rose.fabric.direction * degrees)});
    }
  return table({"pairs", "ε₁", "number", "a", "F₁ − F₂", "θₐ"}, rows);
}

Piece roses_of(Looked const& looked) {
  Rose const before = rose_of(looked.start, ContactSet::touching);
  Piece roses;
  for (Snapshot const* const s : fabric_snapshots(looked))
    roses += titled(normal_rose(rose_of(*s, ContactSet::touching), before, strain_text(*s)), strain_text(*s));
  return figure(
      "Figure 21: Directions of contacts", strip(roses) + fabric_table(looked),
      beside_words("contacts turn to the vertical as the strain grows.",
                   "grains that touch, fitted by 1 + a cos 2(θ − θₐ); 90° is vertical, dashed is the start. The table adds "
                   "bonds across a gap, which claim 15 counts as the paper does, and bonds alone; F is the mean of n ⊗ n."),
      true);
}

}  // namespace

Piece picture_figures(Reproduction const& r) {
  std::optional<Looked> const looked = looked_at(r);
  if (!looked) return "";
  return side_by_side(grading_of(*looked) + specimen_of(*looked)) + bonds_of(*looked) + strains_of(*looked) + roses_of(*looked);
}

}  // namespace clathra
