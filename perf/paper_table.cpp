/// The table of a set of biaxial tests, from their output folders, as Markdown.
///   paper_table OUT...
/// Reads history.csv, events.csv and run.json of each folder. Columns: peak deviator stress and its axial strain, residual
/// deviator stress (mean over 12-15 % strain, or the last fifth of a shorter test), volumetric strain at peak and end, intact
/// share, how well sigma_3 held, how far wall and contact stress differ, the energy residual, and the share of the bonds broken
/// after the peak that lie in the best band of 25 d50 width. Below it: the records that left sigma_3 by more than 1 %, with the
/// bonds broken since the record before.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "domain/measurement/test_phases.hpp"
#include "io/results/events.hpp"
#include "io/results/run_results.hpp"

namespace clathra {
namespace {

/// A straight band: points with `from` <= x cos(angle) + y sin(angle) <= `to`.
struct Band {
  double angle = 0, from = 0, to = 0;
  std::size_t points = 0;
  bool holds(double x, double y) const {
    double const across = std::cos(angle) * x + std::sin(angle) * y;
    return from <= across && across <= to;
  }
};

/// The band of the given width that holds the most points, over all directions.
Band best_band(std::vector<double> const& x, std::vector<double> const& y, double width) {
  Band best;
  for (int degree = 0; degree < 180; ++degree) {
    double const angle = degree * 3.14159265358979 / 180, c = std::cos(angle), s = std::sin(angle);
    std::vector<double> across(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) across[i] = c * x[i] + s * y[i];
    std::sort(across.begin(), across.end());
    for (std::size_t first = 0, last = 0; last < across.size(); ++last) {
      while (across[last] - across[first] > width) ++first;
      if (last - first + 1 > best.points) best = {angle, across[first], across[last], last - first + 1};
    }
  }
  return best;
}

/// The shares of points in the best band, and in it with the best band of what it leaves (a conjugate pair), as text.
std::string band_shares(std::vector<double> const& x, std::vector<double> const& y, double width) {
  if (x.empty()) return "-";
  Band const first = best_band(x, y, width);
  std::vector<double> rest_x, rest_y;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (first.holds(x[i], y[i])) continue;
    rest_x.push_back(x[i]);
    rest_y.push_back(y[i]);
  }
  Band const second = best_band(rest_x, rest_y, width);
  double const all = static_cast<double>(x.size());
  char text[48];
  std::snprintf(text, sizeof text, "%.0f %% / %.0f %%", 100 * static_cast<double>(first.points) / all,
                100 * static_cast<double>(first.points + second.points) / all);
  return text;
}

double mean_from(HistoryTable const& h, std::string const& column, double from) {
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < h["eps1"].size(); ++i) {
    if (h["eps1"][i] < from) continue;
    sum += h[column][i];
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

/// The records that left the confining stress by more than 1 %, one line each.
std::vector<std::string> misses(HistoryTable const& h, double target) {
  std::vector<std::string> lines;
  for (std::size_t i = 1; i < h["sigma3_Pa"].size(); ++i) {
    double const off = h["sigma3_Pa"][i] / target - 1;
    if (std::abs(off) <= 0.01) continue;
    char line[128];
    std::snprintf(line, sizeof line, "eps1 %.2f %%: sigma3 off by %+.2f %%, %.0f bonds broken since the record before",
                  100 * h["eps1"][i], 100 * off, h["bonds_intact"][i - 1] - h["bonds_intact"][i]);
    lines.push_back(line);
  }
  return lines;
}

/// Prints one row; the misses go into `notes`.
void print_row(std::string const& folder, std::string& notes) {
  RunResults const run = read_run(folder);
  HistoryTable const& h = run.history;
  std::vector<double> const& q = h["q_Pa"];
  std::size_t const peak = peak_row(q), last = q.size() - 1;
  double const target = h["sigma3_Pa"][0] > 0 ? std::round(h["sigma3_Pa"][0] / 1e5) * 1e5 : 1;
  double const residual = mean_from(h, "q_Pa", residual_from(h["eps1"][last]));
  double wall_contact = 0, energy = 0;
  for (std::size_t i = 0; i <= last; ++i) {
    wall_contact += std::abs(h["contact_sigma1_Pa"][i] / h["sigma1_Pa"][i] - 1) / static_cast<double>(last + 1);
    if (h.has("residual_J") && h["boundary_work_J"][i] > 0 && i > last / 20) {
      energy = std::max(energy, std::abs(h["residual_J"][i] / h["boundary_work_J"][i]));
    }
  }
  std::vector<double> x, y;
  if (std::filesystem::exists(run.folder / "events.csv")) {
    for (BreakEvent const& event : read_events(run.folder / "events.csv")) {
      if (static_cast<double>(event.step) <= h["step"][peak]) continue;
      x.push_back(event.x);
      y.push_back(event.y);
    }
  }
  double const d50 = run.number("/stages/plan/d50_m").value_or(0.1694e-3);
  std::vector<std::string> const missed = misses(h, target);
  std::printf("| %s | %.2f | %.2f | %.2f | %+.2f | %+.2f | %.1f | %.2f | %.3f | %.3f | %s |\n", folder.c_str(), q[peak] / 1e6,
              100 * h["eps1"][peak], residual / 1e6, 100 * h["eps_v"][peak], 100 * h["eps_v"][last],
              h["intact_initial_pct"][last], 100.0 * (1 - static_cast<double>(missed.size()) / static_cast<double>(last)),
              100 * wall_contact, 100 * energy, band_shares(x, y, 25 * d50).c_str());
  for (std::string const& line : missed) notes += "- " + folder + ": " + line + "\n";
}

}  // namespace
}  // namespace clathra

int main(int argc, char** argv) {
  using namespace clathra;
  if (argc < 2) {
    std::fprintf(stderr, "usage: paper_table OUT...   (output folders of clathra run)\n");
    return 64;
  }
  std::printf(
      "| run | peak q [MPa] | at eps1 [%%] | residual q [MPa] | eps_v at peak [%%] | eps_v at end [%%] | intact at end [%%] | "
      "records with sigma3 within 1 %% [%%] | mean wall-contact difference [%%] | energy residual [%% of work] | post-peak "
      "breaks in "
      "one / two bands of 25 d50 |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  std::string notes;
  int code = 0;
  for (int k = 1; k < argc; ++k) {
    try {
      print_row(argv[k], notes);
    } catch (FileProblem const& problem) {
      std::fprintf(stderr, "paper_table: %s\n", problem.what());
      code = 66;
    }
  }
  if (!notes.empty()) std::printf("\nRecords outside 1 %% of sigma3:\n\n%s", notes.c_str());
  return code;
}
