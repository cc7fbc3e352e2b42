/// Pictures on the page on the seed paper: one test, 55 % at 3 MPa, of the first seed that has it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "domain/measurement/fabric.hpp"
#include "domain/measurement/strain_field.hpp"
#include "io/report/drawn_picture.hpp"
#include "io/report/grading_figure.hpp"
#include "io/report/markup.hpp"
#include "io/report/paper_figures.hpp"
#include "io/report/rose_diagrams.hpp"
#include "io/results/snapshot_file.hpp"

namespace clathra {
namespace {

constexpr double percent = 100, degrees = 180 / 3.14159265358979323846;
constexpr std::size_t picture_bytes = 220'000;

/// The snapshots of the test at the strains that the paper shows.
struct Looked {
  Snapshot start;
  std::vector<Snapshot> at;  ///< 2.54, 3.38, 6.71, 15.04 %
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
      if (snapshot.eps1 == 0)
        looked.start = std::move(snapshot);
      else if (shown)
        looked.at.push_back(std::move(snapshot));
    }
    if (!looked.start.x.empty() && !looked.at.empty()) return looked;
  }
  return {};
}

std::string grading_of(Looked const& looked) {
  std::string const html = grading_figure({grading_curve(looked.start.radius, "our discs", run_stroke(0))});
  return "<h3>Figure 9: Grading</h3>\n" + html;
}

std::string specimen_of(Looked const& looked) {
  Snapshot const& s = looked.start;
  std::string const image = drawn({view_of({&s}), mean_diameter(s), "Grains of the specimen by size",
                                   [&](MapView const& view) { return grain_map(s, view); }},
                                  picture_bytes);
  return figure("Figure 10: Specimen", strip(image),
                beside_words("20,000 discs, 26.5 mm by 53 mm.", fmt::format("{} discs, {:.3g} mm by {:.3g} mm under 3 MPa.",
                                                                            grouped(static_cast<double>(s.x.size())),
                                                                            1e3 * (s.right - s.left), 1e3 * (s.top - s.bottom))));
}

std::string bonds_of(Looked const& looked) {
  std::string pictures;
  for (Snapshot const& s : looked.at)
    pictures += titled(drawn({view_of({&s}), mean_diameter(s), "Intact and broken bonds at " + strain_text(s),
                              [&](MapView const& view) { return bond_map(s, view); }},
                             picture_bytes),
                       strain_text(s));
  return figure("Figure 18b: Bonds", strip(pictures) + legend(patch_entry(colours::grey, "intact bond") + mode_entries()),
                beside_words("a shear band develops in which most bonds break as the strain grows.", ""), true);
}

std::string strains_of(Looked const& looked) {
  std::string pictures;
  double most = 0;
  std::vector<std::vector<float>> fields;
  for (Snapshot const& s : looked.at) fields.push_back(shear_strain(s));
  most = upper_end(fields.back());
  if (!(most > 0)) return "";
  for (std::size_t i = 0; i < looked.at.size(); ++i) {
    Snapshot const& s = looked.at[i];
    pictures += titled(drawn({view_of({&s}), mean_diameter(s), "Shear strain at " + strain_text(s),
                              [&](MapView const& view) { return value_map(s, fields[i], most, view); }},
                             picture_bytes),
                       strain_text(s));
  }
  return figure(
      "Figure 20: Shear strain",
      strip(pictures) + colour_bar("shear strain", "0 %", fmt::format("{:g} % and more", most * percent)),
      beside_words("a concentrated band forms and grows thicker.",
                   fmt::format("difference of the principal natural strains over {:g} grain diameters.", strain_window)),
      true);
}

std::string roses_of(Looked const& looked) {
  Rose const before = rose_of(looked.start, ContactSet::touching);
  std::string roses = titled(normal_rose(before, before, "start"), strain_text(looked.start));
  std::string numbers;
  for (std::size_t const i : {std::size_t{0}, looked.at.size() - 1}) {
    Rose const rose = rose_of(looked.at[i], ContactSet::touching);
    roses += titled(normal_rose(rose, before, strain_text(looked.at[i])), strain_text(looked.at[i]));
    numbers += fmt::format(" {}: a = {:.2f} at {:.0f}°.", strain_text(looked.at[i]), rose.fabric.anisotropy(),
                           rose.fabric.direction * degrees);
  }
  return figure("Figure 21: Directions of contacts", strip(roses),
                beside_words("contacts turn to the vertical as the strain grows.",
                             "contacts and bonds, fitted by 1 + a cos 2(θ − θₐ); 90° is vertical." + numbers),
                true);
}

}  // namespace

std::string picture_figures(Reproduction const& r) {
  std::optional<Looked> const looked = looked_at(r);
  if (!looked) return "";
  return side_by_side(grading_of(*looked) + specimen_of(*looked)) + bonds_of(*looked) + strains_of(*looked) + roses_of(*looked);
}

}  // namespace clathra
