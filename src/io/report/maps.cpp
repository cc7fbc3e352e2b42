#include "io/report/maps.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "io/report/colours.hpp"

namespace clathra {

double mean_diameter(Snapshot const& s) {
  return 2 * std::accumulate(s.radius.begin(), s.radius.end(), 0.0) / static_cast<double>(s.radius.size());
}

namespace {

using namespace map_colours;

ContactState state_of(Snapshot const& s, std::size_t pair) { return static_cast<ContactState>(s.state[pair]); }

bool is_broken(ContactState state) { return state != ContactState::contact && state != ContactState::bonded; }

/// The branch of a pair, shortened about its middle to the length that it has when the discs touch.
struct Branch {
  double x0, y0, x1, y1;
  Branch(Snapshot const& s, std::size_t pair) {
    auto const a = static_cast<std::size_t>(s.a[pair]), b = static_cast<std::size_t>(s.b[pair]);
    double const dx = s.x[b] - s.x[a], dy = s.y[b] - s.y[a], length = std::hypot(dx, dy);
    double const touching = double(s.radius[a]) + double(s.radius[b]);
    double const part = length > touching ? touching / length / 2 : 0.5;
    double const x = (s.x[a] + s.x[b]) / 2, y = (s.y[a] + s.y[b]) / 2;
    x0 = x - part * dx, x1 = x + part * dx, y0 = y - part * dy, y1 = y + part * dy;
  }
  Branch middle_half() const {
    Branch half = *this;
    half.x0 += (x1 - x0) / 4, half.x1 -= (x1 - x0) / 4, half.y0 += (y1 - y0) / 4, half.y1 -= (y1 - y0) / 4;
    return half;
  }
};

void draw(Canvas& canvas, MapView const& view, Branch const& at, double width, Rgb colour) {
  canvas.line(view.x(at.x0), view.y(at.y0), view.x(at.x1), view.y(at.y1), width, colour);
}

void draw_walls(Canvas& canvas, MapView const& view, Snapshot const& s) {
  double const left = view.x(s.left), right = view.x(s.right), bottom = view.y(s.bottom), top = view.y(s.top);
  constexpr double width = 2;
  canvas.line(left, bottom, left, top, width, wall);
  canvas.line(right, bottom, right, top, width, wall);
  canvas.line(left, bottom, right, bottom, width, wall);
  canvas.line(left, top, right, top, width, wall);
}

/// A disc that leaves a thin gap to its neighbours where it is large enough to be seen as one.
double drawn_radius(double pixels) { return pixels > 3 ? pixels - 0.5 : pixels; }

}  // namespace

Canvas MapView::canvas() const { return Canvas(std::max(1, static_cast<int>(std::lround(width * scale()))), pixels); }

MapView view_of(std::vector<Snapshot const*> const& snapshots) {
  double left = snapshots.front()->left, right = snapshots.front()->right;
  double bottom = snapshots.front()->bottom, top = snapshots.front()->top;
  for (Snapshot const* const s : snapshots) {
    left = std::min(left, s->left), right = std::max(right, s->right);
    bottom = std::min(bottom, s->bottom), top = std::max(top, s->top);
  }
  double const margin = 0.006 * (top - bottom);
  return {left - margin, bottom - margin, right - left + 2 * margin, top - bottom + 2 * margin, 0};
}

MapView detail_of(Snapshot const& s, double diameters) {
  double const width = s.right - s.left, height = s.top - s.bottom;
  double const side = std::min({width, height, diameters * mean_diameter(s)});
  return {s.left + (width - side) / 2, s.bottom + (height - side) / 2, side, side, 0};
}

Canvas grain_map(Snapshot const& s, MapView const& view) {
  auto const [least, most] = std::minmax_element(s.radius.begin(), s.radius.end());
  double const low = double(*least), span = double(*most) - low;
  Canvas canvas = view.canvas();
  for (std::size_t i = 0; i < s.x.size(); ++i)
    canvas.disc(view.x(s.x[i]), view.y(s.y[i]), drawn_radius(double(s.radius[i]) * view.scale()),
                ramp(span > 0 ? (double(s.radius[i]) - low) / span : 0.5));
  draw_walls(canvas, view, s);
  return canvas;
}

Canvas detail_map(Snapshot const& s, MapView const& view) {
  Canvas canvas = view.canvas();
  constexpr double rim_pixels = 1.4;
  for (std::size_t k = 0; k < s.a.size(); ++k)
    if (state_of(s, k) == ContactState::bonded) draw(canvas, view, Branch(s, k), s.width[k] * view.scale(), hydrate);
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    double const radius = double(s.radius[i]) * view.scale(), x = view.x(s.x[i]), y = view.y(s.y[i]);
    canvas.disc(x, y, radius, rim);
    if (radius > rim_pixels) canvas.disc(x, y, radius - rim_pixels, grain);
  }
  for (std::size_t k = 0; k < s.a.size(); ++k) {
    ContactState const state = state_of(s, k);
    if (state == ContactState::contact) continue;
    Branch const at = Branch(s, k).middle_half();  // so that pairs stay apart
    draw(canvas, view, at, is_broken(state) ? 6 : 2.5, is_broken(state) ? state_colour(state) : colours::dark);
  }
  return canvas;
}

Canvas bond_map(Snapshot const& s, MapView const& view) {
  Canvas canvas = view.canvas();
  double const unit = mean_diameter(s) * view.scale();
  for (std::size_t k = 0; k < s.a.size(); ++k)
    if (state_of(s, k) == ContactState::bonded) draw(canvas, view, Branch(s, k), std::min(1.2, 0.12 * unit), colours::grey);
  for (std::size_t k = 0; k < s.a.size(); ++k)
    if (is_broken(state_of(s, k))) draw(canvas, view, Branch(s, k), std::min(5.0, 0.3 * unit), state_colour(state_of(s, k)));
  draw_walls(canvas, view, s);
  return canvas;
}

Canvas force_map(Snapshot const& s, MapView const& view) {
  Canvas canvas = view.canvas();
  double sum = 0, count = 0;
  for (double const force : s.normal_force)
    if (force > 0) sum += force, count += 1;
  double const mean = count > 0 ? sum / count : 1, unit = mean_diameter(s) * view.scale();
  constexpr double width_of_mean = 0.16, widest = 0.8;  // in diameters
  auto const draw_those = [&](auto const& chosen, Rgb colour) {
    for (std::size_t k = 0; k < s.a.size(); ++k)
      if (double const part = s.normal_force[k] / mean; chosen(part))
        draw(canvas, view, Branch(s, k), unit * std::min(widest, width_of_mean * std::abs(part)), colour);
  };
  draw_those([](double part) { return part > 0 && part < 1; }, weak);
  draw_those([](double part) { return part < 0; }, pulling);
  draw_those([](double part) { return part >= 1; }, pressing);
  draw_walls(canvas, view, s);
  return canvas;
}

Canvas value_map(Snapshot const& s, std::vector<float> const& values, double most, MapView const& view) {
  Canvas canvas = view.canvas();
  constexpr double overlap = 1.08;  // closes the pores, so that the field is what is seen
  for (std::size_t i = 0; i < s.x.size(); ++i)
    canvas.disc(view.x(s.x[i]), view.y(s.y[i]), overlap * double(s.radius[i]) * view.scale(),
                std::isfinite(values[i]) ? ramp(double(values[i]) / most) : unknown);
  draw_walls(canvas, view, s);
  return canvas;
}

}  // namespace clathra
