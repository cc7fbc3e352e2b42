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
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace {

using Table = std::map<std::string, std::vector<double>>;

/// A CSV file by column name; an absent file is an empty table.
Table read_csv(std::string const& path) {
  std::ifstream file(path);
  Table table;
  std::string line, cell;
  if (!std::getline(file, line)) return table;
  std::vector<std::string> names;
  for (std::istringstream header(line); std::getline(header, cell, ',');) names.push_back(cell);
  while (std::getline(file, line)) {
    std::istringstream row(line);
    for (std::string const& name : names) {
      std::getline(row, cell, ',');
      table[name].push_back(std::atof(cell.c_str()));
    }
  }
  return table;
}

/// The first number after `"key":` in a JSON text.
double json_number(std::string const& text, std::string const& key, double absent) {
  std::size_t const at = text.find("\"" + key + "\":");
  return at == std::string::npos ? absent : std::atof(text.c_str() + at + key.size() + 3);
}

std::string read_text(std::string const& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

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

double mean_between(Table const& h, std::string const& column, double from, double to) {
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < h.at("eps1").size(); ++i) {
    if (h.at("eps1")[i] < from || h.at("eps1")[i] > to) continue;
    sum += h.at(column)[i];
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

/// The records that left the confining stress by more than 1 %, one line each.
std::vector<std::string> misses(Table const& h, double target) {
  std::vector<std::string> lines;
  for (std::size_t i = 1; i < h.at("sigma3_Pa").size(); ++i) {
    double const off = h.at("sigma3_Pa")[i] / target - 1;
    if (std::abs(off) <= 0.01) continue;
    char line[128];
    std::snprintf(line, sizeof line, "eps1 %.2f %%: sigma3 off by %+.2f %%, %.0f bonds broken since the record before",
                  100 * h.at("eps1")[i], 100 * off, h.at("bonds_intact")[i - 1] - h.at("bonds_intact")[i]);
    lines.push_back(line);
  }
  return lines;
}

/// Prints one row; the misses go into `notes`.
bool print_row(std::string const& folder, std::string& notes) {
  Table const h = read_csv(folder + "/history.csv"), e = read_csv(folder + "/events.csv");
  std::string const record = read_text(folder + "/run.json");
  if (h.empty()) {
    std::fprintf(stderr, "paper_table: %s/history.csv cannot be read\n", folder.c_str());
    return false;
  }
  auto const& q = h.at("q_Pa");
  std::size_t const peak = static_cast<std::size_t>(std::max_element(q.begin(), q.end()) - q.begin()), last = q.size() - 1;
  double const end = h.at("eps1")[last], target = h.at("sigma3_Pa")[0] > 0 ? std::round(h.at("sigma3_Pa")[0] / 1e5) * 1e5 : 1;
  double const residual = mean_between(h, "q_Pa", end > 0.14 ? 0.12 : 0.8 * end, 1);
  double wall_contact = 0, energy = 0;
  for (std::size_t i = 0; i <= last; ++i) {
    wall_contact += std::abs(h.at("contact_sigma1_Pa")[i] / h.at("sigma1_Pa")[i] - 1) / static_cast<double>(last + 1);
    if (h.count("residual_J") && h.at("boundary_work_J")[i] > 0 && i > last / 20) {
      energy = std::max(energy, std::abs(h.at("residual_J")[i] / h.at("boundary_work_J")[i]));
    }
  }
  std::vector<double> x, y;
  if (e.count("step")) {
    for (std::size_t i = 0; i < e.at("step").size(); ++i) {
      if (e.at("step")[i] <= h.at("step")[peak]) continue;
      x.push_back(e.at("x_m")[i]);
      y.push_back(e.at("y_m")[i]);
    }
  }
  double const d50 = json_number(record, "d50_m", 0.1694e-3);
  std::vector<std::string> const missed = misses(h, target);
  std::printf("| %s | %.2f | %.2f | %.2f | %+.2f | %+.2f | %.1f | %.2f | %.3f | %.3f | %s |\n", folder.c_str(), q[peak] / 1e6,
              100 * h.at("eps1")[peak], residual / 1e6, 100 * h.at("eps_v")[peak], 100 * h.at("eps_v")[last],
              h.at("intact_initial_pct")[last], 100.0 * (1 - static_cast<double>(missed.size()) / static_cast<double>(last)),
              100 * wall_contact, 100 * energy, band_shares(x, y, 25 * d50).c_str());
  for (std::string const& line : missed) notes += "- " + folder + ": " + line + "\n";
  return true;
}

}  // namespace

int main(int argc, char** argv) {
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
  bool complete = true;
  for (int k = 1; k < argc; ++k) complete = print_row(argv[k], notes) && complete;
  if (!notes.empty()) std::printf("\nRecords outside 1 %% of sigma3:\n\n%s", notes.c_str());
  return complete ? 0 : 66;
}
