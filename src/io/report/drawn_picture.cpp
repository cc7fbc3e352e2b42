#include "io/report/drawn_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/report/markup.hpp"
#include "io/report/plot.hpp"
#include "io/report/png.hpp"
#include "io/results/export.hpp"
#include "io/results/snapshot_file.hpp"
#include "kernels/break_mode.hpp"

namespace clathra {

std::string strain_text(Snapshot const& s) { return fmt::format("ε₁ = {:.3g} %", s.eps1 * 100); }

Piece drawn(Picture const& wanted, std::size_t bytes) {
  constexpr double lowest = 120, highest = 1400, safety = 0.93;
  MapView view = wanted.view;
  double pixels = std::clamp(view.height / wanted.grain * wanted.pixels_per_grain, lowest, highest);
  for (;;) {
    view.pixels = static_cast<int>(pixels);
    Canvas const canvas = wanted.draw(view);
    std::string const png = png_bytes(canvas);
    if (png.size() <= bytes || pixels <= lowest) return picture(png, canvas, wanted.alt, wanted.data);
    double const shrink = std::sqrt(static_cast<double>(bytes) / static_cast<double>(png.size()));
    pixels = std::max(lowest, pixels * std::min(safety, shrink));
  }
}

DrawnData particles_behind(std::filesystem::path const& snapshot, std::string const& series, MapView const& view,
                           std::string const& column, std::vector<float> values) {
  return {"series,x_m,y_m,radius_m" + (column.empty() ? "" : "," + column), [=] {
            Snapshot const s = read_snapshot(snapshot);
            DataColumns shown{series, std::vector<std::vector<double>>(column.empty() ? 3 : 4)};
            for (std::size_t i = 0; i < s.x.size(); ++i) {
              double const r = double(s.radius[i]), x = s.x[i] - view.left, y = s.y[i] - view.bottom;
              if (x < -r || x > view.width + r || y < -r || y > view.height + r) continue;
              std::size_t k = 0;
              for (double const value : {s.x[i], s.y[i], r}) shown.columns[k++].push_back(value);
              if (!column.empty()) shown.columns[k].push_back(double(values[i]));
            }
            return data_rows({shown});
          }};
}

DrawnData pairs_behind(std::filesystem::path const& snapshot, std::string const& series, ShownPairs which) {
  return {"series,x_a_m,y_a_m,x_b_m,y_b_m,normal_force_N_per_m", [=] {
            Snapshot const s = read_snapshot(snapshot);
            std::vector<DataColumns> by_state;
            for (int state = 0; state < contact_state_count; ++state)
              by_state.push_back({fmt::format("{}, {}", series, contact_state_name(static_cast<std::uint8_t>(state))),
                                  std::vector<std::vector<double>>(5)});
            for (std::size_t k = 0; k < s.a.size(); ++k) {
              bool const bond = static_cast<ContactState>(s.state[k]) != ContactState::contact;
              if (which == ShownPairs::bonds ? !bond : s.normal_force[k] == 0) continue;
              auto const a = static_cast<std::size_t>(s.a[k]), b = static_cast<std::size_t>(s.b[k]);
              std::size_t column = 0;
              for (double const value : {s.x[a], s.y[a], s.x[b], s.y[b], s.normal_force[k]})
                by_state[s.state[k]].columns[column++].push_back(value);
            }
            return data_rows(by_state);
          }};
}

Piece mode_entries() {
  Piece entries;
  for (BreakModeNames const& m : break_modes)
    entries += patch_entry(mode_stroke(m.mode).colour, std::string("broken in ") + m.name);
  return entries;
}

double upper_end(std::vector<float> values) {
  values.erase(std::remove_if(values.begin(), values.end(), [](float v) { return !std::isfinite(v); }), values.end());
  if (values.empty()) return 0;
  auto const at = values.begin() + static_cast<std::ptrdiff_t>(0.98 * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  double const end = double(*at);
  return end > 0 ? std::ceil(end / tick_step(0, end, 10)) * tick_step(0, end, 10) : 0;
}

}  // namespace clathra
