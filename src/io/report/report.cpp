#include "io/report/report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "io/formats/text_file.hpp"
#include "io/report/curves.hpp"
#include "io/report/grading_figure.hpp"
#include "io/report/hydrate_figures.hpp"
#include "io/report/loading_figures.hpp"
#include "io/report/map_figures.hpp"
#include "io/report/markup.hpp"
#include "io/report/sand_strength.hpp"
#include "io/report/strength.hpp"
#include "io/report/summary_table.hpp"

namespace clathra {
namespace {

constexpr std::size_t largest_page = 4'800'000;  // bytes
constexpr std::size_t most_runs_with_pictures = 8;

std::string title_of(std::vector<RunResults> const& runs) {
  auto const kind_of = [](RunResults const& run) { return run.test_kind() == "list" ? "stages" : run.test_kind(); };
  std::string kind = kind_of(runs.front());
  for (RunResults const& run : runs)
    if (kind_of(run) != kind) kind.clear();
  std::replace(kind.begin(), kind.end(), '_', ' ');
  std::string const what = kind == "biaxial" ? "Biaxial compression" : kind.empty() ? "Tests" : "Test, " + kind;
  return runs.size() == 1 ? what + ": " + runs.front().name : fmt::format("{}: {} runs", what, runs.size());
}

/// A part of the page with its heading, or nothing where it is empty.
Piece part(std::string const& heading, Piece contents) {
  return contents.empty() ? "" : "<h2>" + escaped(heading) + "</h2>\n" + std::move(contents);
}

Piece everything_but_pictures(std::vector<RunResults> const& runs, LaboratoryOverlay& data) {
  ShownRuns const shown = shown_runs(runs, data);
  Piece text = part("Summary", summary_table(runs)) + part("Stages", stage_tables(runs)) +
               part("Hydrate", hydrate_part(shown, strength_of_sand(runs))) +
               part("Loading", side_by_side(loading_figures(shown))) + part("Curves", side_by_side(curve_figures(shown)));
  if (Piece strength = strength_figures(runs); !strength.empty()) text += part("Strength", side_by_side(std::move(strength)));
  if (Piece energy = energy_figures(runs); !energy.empty()) text += part("Energy", side_by_side(std::move(energy)));
  return std::move(text) + data.note();
}

/// Which runs have pictures, in words, where not all have.
std::string note_on_missing_pictures(std::vector<RunResults> const& runs, std::vector<std::size_t> const& shown) {
  std::string without;
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (runs[i].snapshots.empty()) without += (without.empty() ? "" : ", ") + escaped(runs[i].name);
  std::string note;
  if (!without.empty())
    note +=
        "There are no pictures of " + without + ": without snapshots (output.snapshots in the scene) only the curves are known. ";
  if (shown.size() == most_runs_with_pictures)
    note += fmt::format("Pictures are shown of the first {} runs that have snapshots.", most_runs_with_pictures);
  return note.empty() ? "" : "<p class=\"soft\">" + note + "</p>\n";
}

/// @param room  bytes that the pictures may take in the page
Piece pictures(std::vector<RunResults> const& runs, std::size_t room) {
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < runs.size() && shown.size() < most_runs_with_pictures; ++i)
    if (!runs[i].snapshots.empty()) shown.push_back(i);
  std::string const note = note_on_missing_pictures(runs, shown);
  if (shown.empty()) return part("Pictures", note);
  std::size_t const each = room / (shown.size() * pictures_per_run) * 3 / 4;  // four characters for three bytes
  std::vector<Curve> gradings;
  Piece text;
  for (std::size_t const i : shown) {
    MapFigures figures = map_figures(runs[i], run_stroke(i), each);
    text += part(runs.size() > 1 ? "Pictures of " + run_label(runs[i]) : "Pictures", side_by_side(std::move(figures.figures)));
    gradings.push_back(std::move(figures.grading));
  }
  if (std::optional<Curve> target = target_curve(runs[shown.front()])) gradings.push_back(std::move(*target));
  return std::move(text) + part("Grading", side_by_side(grading_figure("Grading curve", gradings))) + note;
}

}  // namespace

std::vector<Figure> write_report(std::vector<std::filesystem::path> const& run_folders, std::filesystem::path const& html,
                                 std::optional<LaboratoryData> const& data) {
  std::vector<RunResults> const runs = read_runs(run_folders);
  LaboratoryOverlay overlay = data ? LaboratoryOverlay(*data, page_tests(runs)) : LaboratoryOverlay();
  Piece body = "<h1>" + escaped(title_of(runs)) + "</h1>\n<p class=\"lead\">" + escaped(summary_sentence(runs)) + "</p>\n";
  body += warning_list(runs) + note_on_missing_columns(runs) + everything_but_pictures(runs, overlay);
  constexpr std::size_t least_room = 1'000'000, text_of_pictures = 100'000;
  std::size_t const taken = body.html.size() + text_of_pictures * runs.size();
  body += pictures(runs, taken + least_room < largest_page ? largest_page - taken : least_room);
  replace_text_file(html, page(title_of(runs), body.html));
  return std::move(body.figures);
}

}  // namespace clathra
