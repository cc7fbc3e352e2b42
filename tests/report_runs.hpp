#pragma once
/// Folders of runs that nobody ran: histories of a known shape, and snapshots of a lattice, for the tests of the report.
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "io/results/history.hpp"
#include "io/results/run_record.hpp"
#include "io/results/snapshot_file.hpp"
#include "made_up_lattice.hpp"

namespace clathra {

/// q rises along a line to its peak, falls along another to the residual value at 8 % strain, and stays there; 301 records to 15
/// %.
struct MadeUpTest {
  double sigma3 = 1e6, peak_q = 5e6, peak_eps1 = 0.02, residual_q = 2e6;
  double saturation = 0.55;
  bool energy = false;
  std::vector<std::string> overrides = {};  ///< of the scene in run.json
  int breaking = 1;                         ///< bonds that break in each mode from record to record
  bool consolidation = false;               ///< recorded, in made_up_consolidation rows

  double q(double eps1) const {
    constexpr double residual_eps1 = 0.08;
    if (eps1 <= peak_eps1) return peak_q * eps1 / peak_eps1;
    double const part = std::min(1.0, (eps1 - peak_eps1) / (residual_eps1 - peak_eps1));
    return peak_q + part * (residual_q - peak_q);
  }
};

inline constexpr int made_up_records = 300;
inline constexpr double made_up_strain = 0.15;
inline constexpr int made_up_consolidation = 20;

inline HistoryRow made_up_row(MadeUpTest const& test, int i) {
  HistoryRow row;
  row.step = 100 * i;
  row.eps1 = made_up_strain * i / made_up_records;
  row.eps_v = -0.1 * row.eps1;
  row.sigma3_Pa = test.sigma3;
  row.q_Pa = test.q(row.eps1);
  row.sigma1_Pa = test.sigma3 + row.q_Pa;
  row.void_ratio = 0.24;
  if (test.saturation > 0) {
    row.bonds_intact = 1000 - 2 * i;
    row.broken[BreakMode::rolling] = test.breaking * i;
    row.broken[BreakMode::shear] = test.breaking * i;
    row.bonds_intact_pct = static_cast<double>(row.bonds_intact) / 10;
  }
  return row;
}

/// From sigma_3 / 20 to sigma_3 in equal steps, while e falls from 0.26 by 0.001 each.
inline HistoryRow made_up_consolidation_row(MadeUpTest const& test, int i) {
  HistoryRow row;
  row.stage = consolidation_stage;
  row.step = 10 * i;
  row.sigma1_Pa = row.sigma3_Pa = row.p_Pa = test.sigma3 * (i + 1) / made_up_consolidation;
  row.void_ratio = 0.26 - 0.001 * i;
  row.eps1 = 1;  // such rows belong to no curve of the shear
  row.eps_v = 2;
  return row;
}

inline void write_made_up_record(std::filesystem::path const& folder, MadeUpTest const& test) {
  RunRecord record;
  record.version = "0.1.0";
  record.git_hash = "abc";
  record.input = parse_scene("[specimen]\nparticles = 2000\n", "my.toml", "", test.overrides);
  record.input.scene.hydrate.saturation = test.saturation;
  record.input.scene.test.confining_stress = test.sigma3;
  record.stages["plan"]["particles"] = 2000;
  record.warnings = {"the <wall> is \"near\""};
  record.state_hash = 0xabcull;
  record.exit_reason = "finished";
  write_run_record(folder / "run.json", record);
}

inline void write_made_up_run(std::filesystem::path const& folder, MadeUpTest const& test) {
  std::filesystem::create_directories(folder);
  HistoryFile history(folder / "history.csv", test.energy);
  for (int i = 0; test.consolidation && i < made_up_consolidation; ++i) history.write(made_up_consolidation_row(test, i));
  for (int i = 0; i <= made_up_records; ++i) {
    if (test.energy) {
      EnergyRow energy;
      energy.boundary_work = i;
      energy.sliding = 0.5 * i;
      energy.grain_elastic = 0.5 * i;
      history.write(made_up_row(test, i), energy);
    } else {
      history.write(made_up_row(test, i));
    }
  }
  history.close();
  write_made_up_record(folder, test);
}

/// Snapshots at the start, at the peak and at the end, the last one sheared by u_x = shear * y.
inline void write_made_up_snapshots(std::filesystem::path const& folder, Snapshot snapshot, double shear) {
  SnapshotSeries series(folder);
  for (int const record : {0, 40, made_up_records}) {
    snapshot.step = 100 * record;
    snapshot.eps1 = made_up_strain * record / made_up_records;
    if (record > 0) snapshot.state.front() = static_cast<std::uint8_t>(broken_in(BreakMode::shear));
    if (record == made_up_records)
      for (std::size_t i = 0; i < snapshot.x.size(); ++i) {
        snapshot.ux[i] = static_cast<float>(shear * snapshot.y[i]);
        snapshot.x[i] += double(snapshot.ux[i]);
      }
    series.write(snapshot);
  }
}

inline std::string content_of(std::filesystem::path const& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace clathra
