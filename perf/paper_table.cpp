/// The table of a set of biaxial tests, from their output folders, as Markdown.
///   paper_table OUT...
/// Reads history.csv, events.csv and run.json of each folder. Three tables: the numbers of each test (test_numbers()); how well
/// each was controlled, with the share of the bonds broken after the peak that lie in the best band and pair of bands of 25 d50
/// width; and, where runs of one saturation differ in confining stress, their Mohr-Coulomb envelopes (paired_strength()). Below
/// them: the records that left sigma_3 by more than 1 %, with the bonds broken since the record before.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "domain/measurement/shear_band.hpp"
#include "domain/measurement/test_numbers.hpp"
#include "io/results/events.hpp"
#include "io/results/run_results.hpp"
#include "io/results/strength_groups.hpp"

namespace clathra {
namespace {

/// The shares of the points in one and in two bands, as text.
std::string shares_text(std::vector<double> const& x, std::vector<double> const& y, double width) {
  if (x.empty()) return "-";
  BandShares const shares = band_shares(x, y, width);
  char text[48];
  std::snprintf(text, sizeof text, "%.0f %% / %.0f %%", 100 * shares.one, 100 * shares.two);
  return text;
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

double target_stress(RunResults const& run) { return run.number("/scene/test/confining_stress").value_or(1); }

void print_numbers(std::vector<RunResults> const& runs) {
  std::printf(
      "| run | e at the start | peak q [MPa] | at eps_1 [%%] | E50 [MPa] | residual q [MPa] | eps_v at peak [%%] | largest eps_v "
      "[%%] | "
      "eps_v at end [%%] | intact at peak [%%] | intact at end [%%] | particle-steps | seconds |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (RunResults const& run : runs) {
    HistoryTable const& h = run.history;
    TestNumbers const n = test_numbers(h.curves());
    std::vector<double> const& eps_v = h["eps_v"];
    char intact[32] = "- | -";
    if (run.has_bonds()) std::snprintf(intact, sizeof intact, "%.1f | %.1f", h["bonds_intact_pct"][n.peak], n.intact_end);
    std::printf("| %s | %.4f | %.2f | %.2f | %.0f | %.2f | %+.2f | %+.2f | %+.2f | %s | %.2g | %.0f |\n", run.name.c_str(),
                h["void_ratio"][0], n.peak_q / 1e6, 100 * n.peak_eps1, n.secant_modulus.value_or(0) / 1e6, n.residual_q / 1e6,
                100 * n.eps_v_peak, 100 * *std::max_element(eps_v.begin(), eps_v.end()), 100 * n.eps_v_end, intact,
                h["step"].back() * run.number("/stages/plan/particles").value_or(0),
                run.number("/wall_seconds/shear").value_or(0));
  }
}

/// The shares of the bonds broken after the peak in one and in two bands.
std::string shares_after_peak(RunResults const& run, double peak_step) {
  std::vector<double> x, y;
  if (!std::filesystem::exists(run.folder / "events.csv")) return "-";
  for (BreakEvent const& event : read_events(run.folder / "events.csv").rows) {
    if (static_cast<double>(event.step) <= peak_step) continue;
    x.push_back(event.x);
    y.push_back(event.y);
  }
  return shares_text(x, y, 25 * run.number("/stages/plan/d50_m").value_or(0.1694e-3));
}

/// The misses go into `notes`.
void print_control(std::vector<RunResults> const& runs, std::string& notes) {
  std::printf(
      "\n| run | records with sigma_3 within 1 %% [%%] | mean difference of wall and contact stress [%%] | energy residual [%% "
      "of work] | "
      "post-peak breaks in one / two bands of 25 d50 |\n|---|---|---|---|---|\n");
  for (RunResults const& run : runs) {
    HistoryTable const& h = run.history;
    std::size_t const last = h.rows() - 1;
    double wall_contact = 0, energy = 0;
    for (std::size_t i = 0; i <= last; ++i) {
      wall_contact += std::abs(h["contact_sigma1_Pa"][i] / h["sigma1_Pa"][i] - 1) / static_cast<double>(last + 1);
      if (h.has("residual_J_per_m") && h["boundary_work_J_per_m"][i] > 0 && i > last / 20)
        energy = std::max(energy, std::abs(h["residual_J_per_m"][i] / h["boundary_work_J_per_m"][i]));
    }
    std::string residual = "-";
    if (h.has("residual_J_per_m")) {
      char text[16];
      std::snprintf(text, sizeof text, "%.3f", 100 * energy);
      residual = text;
    }
    std::vector<std::string> const missed = misses(h, target_stress(run));
    std::printf("| %s | %.1f | %.2f | %s | %s |\n", run.name.c_str(),
                100.0 * (1 - static_cast<double>(missed.size()) / static_cast<double>(last)), 100 * wall_contact,
                residual.c_str(), shares_after_peak(run, h["step"][test_numbers(h.curves()).peak]).c_str());
    for (std::string const& line : missed) notes += "- " + run.name + ": " + line + "\n";
  }
}

/// c and phi of tests, and how far the line misses them at most.
std::string envelope_cells(PairedStrength const& strength, std::vector<SeedTest> const& tests) {
  std::optional<Envelope> const& fit = strength.envelope;
  if (!fit) return "- | - | -";
  double const n = (1 + std::sin(fit->friction_angle)) / (1 - std::sin(fit->friction_angle));
  double miss = 0;
  for (SeedTest const& t : tests)
    miss = std::max(miss, std::abs(t.at.sigma1 - 2 * fit->cohesion * std::sqrt(n) - n * t.at.sigma3));
  constexpr double degrees = 180 / 3.14159265358979;
  EnvelopeErrors errors = fit->errors.value_or(EnvelopeErrors());
  if (strength.cohesion) {
    errors.cohesion = strength.cohesion->half_width.value_or(0);
    errors.friction_angle = strength.friction_angle->half_width.value_or(0);
  }
  char text[96];
  std::snprintf(text, sizeof text, "%.2f ± %.2f | %.1f ± %.1f | %.2f", fit->cohesion / 1e6, errors.cohesion / 1e6,
                fit->friction_angle * degrees, errors.friction_angle * degrees, miss / 1e6);
  return text;
}

void print_strength(std::vector<RunResults> const& runs) {
  std::string rows;
  for (StrengthGroup const& group : strength_groups(runs))
    if (group.at_several_stresses())
      rows += "| " + std::to_string(std::lround(group.saturation)) + " % | " + std::to_string(group.members.size()) + " | " +
              envelope_cells(group.at_peak, group.peaks.reached) + " | " +
              envelope_cells(group.residual, group.residuals.reached) + " |\n";
  if (rows.empty()) return;
  std::printf(
      "\n| hydrate | tests | peak: c [MPa] | phi [degrees] | largest misfit of sigma_1 [MPa] | residual: c [MPa] | phi [degrees] "
      "| "
      "largest misfit [MPa] |\n|---|---|---|---|---|---|---|---|\n%s",
      rows.c_str());
}

}  // namespace
}  // namespace clathra

int main(int argc, char** argv) {
  using namespace clathra;
  if (argc < 2) {
    std::fprintf(stderr, "usage: paper_table OUT...   (output folders of clathra run)\n");
    return 64;
  }
  std::vector<RunResults> runs;
  int code = 0;
  for (int k = 1; k < argc; ++k) {
    try {
      runs.push_back(read_run(argv[k]));
    } catch (FileProblem const& problem) {
      std::fprintf(stderr, "paper_table: %s\n", problem.what());
      code = 66;
    }
  }
  std::string notes;
  print_numbers(runs);
  print_control(runs, notes);
  print_strength(runs);
  if (!notes.empty()) std::printf("\nRecords outside 1 %% of sigma3:\n\n%s", notes.c_str());
  return code;
}
