/// Pictures of one test on the page on a paper.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "domain/measurement/fabric.hpp"
#include "domain/measurement/shear_band.hpp"
#include "domain/measurement/strain_field.hpp"
#include "io/report/drawn_picture.hpp"
#include "io/report/grading_figure.hpp"
#include "io/report/markup.hpp"
#include "io/report/paper_figures.hpp"
#include "io/report/rose_diagrams.hpp"
#include "io/results/shown_units.hpp"
#include "io/results/snapshot_file.hpp"

namespace clathra {
namespace {

constexpr std::size_t picture_bytes = 220'000;

Piece grading_of(PaperFigure const& f, ShownTest const& test) {
  return grading_figure(f.title, {grading_curve(test.start.radius, "our particles", run_stroke(0))});
}

Piece specimen_of(PaperFigure const& f, ShownTest const& test) {
  Snapshot const& s = test.start;
  Piece image = drawn(
      {view_of({&s}), mean_diameter(s), "Grains of the specimen by size", [&](MapView const& view) { return grain_map(s, view); },
       particles_behind(test.start_file, strain_text(s), view_of({&s}))},
      picture_bytes);
  return figure(f.title, strip(std::move(image)),
                beside_words(f.words, filled(f.ours, {{"particles", grouped(static_cast<double>(s.x.size()))},
                                                      {"width", fmt::format("{:.3g} mm", 1e3 * (s.right - s.left))},
                                                      {"height", fmt::format("{:.3g} mm", 1e3 * (s.top - s.bottom))}})));
}

Piece bonds_of(PaperFigure const& f, ShownTest const& test) {
  Piece pictures;
  for (std::size_t i = 0; i < test.at.size(); ++i) {
    Snapshot const& s = test.at[i];
    pictures += titled(drawn({view_of({&s}), mean_diameter(s), "Intact and broken bonds at " + strain_text(s),
                              [&](MapView const& view) { return bond_map(s, view); },
                              pairs_behind(test.files[i], strain_text(s), ShownPairs::bonds)},
                             picture_bytes),
                       strain_text(s));
  }
  return figure(f.title, strip(std::move(pictures)) + legend(patch_entry(colours::grey, "intact bond") + mode_entries()),
                beside_words(f.words, f.ours), true);
}

/// A field of shear strain at each of the strains, and the bands fitted to it where the grains were at first.
struct ShownField {
  std::string name;
  std::vector<std::vector<float>> at_discs;
  std::vector<BandAt> bands;
};

ShownField grain_field(ShownTest const& test) {
  ShownField field{"grain by grain", {}, {}};
  for (Snapshot const& s : test.at) {
    StrainGrid const grid = grain_strain(test.start, s);
    field.at_discs.push_back(shear_at_discs(grid, s));
    field.bands.push_back({s.eps1, fit_band(grid.x, grid.y, grid.shear, s.d50, grid.smoothing)});
  }
  return field;
}

ShownField averaged_field(ShownTest const& test) {
  ShownField field{fmt::format("over {:g} grain diameters", strain_window), {}, {}};
  for (Snapshot const& s : test.at) {
    field.at_discs.push_back(shear_strain(s));
    std::vector<double> x = s.x, y = s.y;
    for (std::size_t i = 0; i < x.size(); ++i) x[i] -= double(s.ux[i]), y[i] -= double(s.uy[i]);
    field.bands.push_back({s.eps1, fit_band(x, y, field.at_discs.back(), s.d50, smoothing_of_shear_strain(s))});
  }
  return field;
}

/// The field at all strains in the colours of the last one.
Piece field_strip(ShownTest const& test, ShownField const& field) {
  double const most = upper_end(field.at_discs.back());
  if (!(most > 0)) return "";
  Piece pictures;
  for (std::size_t i = 0; i < test.at.size(); ++i) {
    Snapshot const& s = test.at[i];
    pictures += titled(drawn({view_of({&s}), mean_diameter(s), "Shear strain " + field.name + " at " + strain_text(s),
                              [&](MapView const& view) { return value_map(s, field.at_discs[i], most, view); },
                              particles_behind(test.files[i], field.name + " at " + strain_text(s), view_of({&s}), "shear_strain",
                                               field.at_discs[i])},
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

Piece strains_of(PaperFigure const& f, ShownTest const& test) {
  std::vector<ShownField> const fields{grain_field(test), averaged_field(test)};
  Piece pictures;
  for (ShownField const& field : fields) pictures += field_strip(test, field);
  if (pictures.empty()) return "";
  return figure(f.title, pictures + bands_table(fields, test.start.d50),
                beside_words(f.words, filled(f.ours, {{"window", fmt::format("{:g}", strain_window)},
                                                      {"bands", onset_text(fields[0]) + ", " + onset_text(fields[1])}})),
                true);
}

constexpr std::pair<ContactSet, char const*> contact_sets[] = {
    {ContactSet::touching, "touching"}, {ContactSet::mechanical, "touching or bonded"}, {ContactSet::bonded, "bonded"}};

/// Start, the first of the strains and the last.
std::vector<Snapshot const*> fabric_snapshots(ShownTest const& test) {
  std::vector<Snapshot const*> shown{&test.start, &test.at.front()};
  if (test.at.size() > 1) shown.push_back(&test.at.back());
  return shown;
}

std::string fabric_table(ShownTest const& test) {
  std::vector<std::vector<std::string>> rows;
  for (auto const& [set, name] : contact_sets)
    for (Snapshot const* const s : fabric_snapshots(test)) {
      Rose const rose = rose_of(*s, set);
      if (rose.pairs == 0) continue;
      rows.push_back({name, fmt::format("{:.2f} %", s->eps1 * percent), grouped(static_cast<double>(rose.pairs)),
                      fmt::format("{:.3f}", rose.fabric.anisotropy()), fmt::format("{:.3f}", rose.fabric.deviator),
                      fmt::format("{:.0f}°", rose.fabric.direction * degrees)});
    }
  return table({"pairs", "ε₁", "number", "a", "F₁ − F₂", "θₐ"}, rows);
}

Piece roses_of(PaperFigure const& f, ShownTest const& test) {
  Rose const before = rose_of(test.start, ContactSet::touching);
  Piece roses;
  for (Snapshot const* const s : fabric_snapshots(test))
    roses += titled(normal_rose(rose_of(*s, ContactSet::touching), before, strain_text(*s)), strain_text(*s));
  return figure(f.title, strip(roses) + fabric_table(test), beside_words(f.words, f.ours), true);
}

}  // namespace

ShownTest shown_test(Reproduction const& r, std::string const& group) {
  for (std::size_t i = 0; i < r.members.size(); ++i) {
    if (r.members[i].state != MemberState::finished || r.study.groups[r.members[i].group].name != group) continue;
    ShownTest test;
    for (std::filesystem::path const& file : snapshot_files(r.folders[i])) {
      Snapshot snapshot = read_snapshot(file);
      std::vector<double> const& strains = r.paper.strains;
      if (snapshot.eps1 == 0) {
        test.start = std::move(snapshot);
        test.start_file = file;
      } else if (std::any_of(strains.begin(), strains.end(), [&](double strain) { return is_near(snapshot.eps1, strain); })) {
        test.at.push_back(std::move(snapshot));
        test.files.push_back(file);
      }
    }
    if (!test.start.x.empty() && !test.at.empty()) return test;
  }
  return {};
}

Piece picture_figure(PaperFigure const& f, ShownTest const& test) {
  if (test.at.empty()) return "";
  if (f.kind == FigureKind::grading) return grading_of(f, test);
  if (f.kind == FigureKind::specimen) return specimen_of(f, test);
  if (f.kind == FigureKind::bonds) return bonds_of(f, test);
  return f.kind == FigureKind::shear_strain ? strains_of(f, test) : roses_of(f, test);
}

}  // namespace clathra
