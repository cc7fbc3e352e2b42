/// The strain field whose nodes ride on grains.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "domain/measurement/strain_field.hpp"

namespace clathra {
namespace {

constexpr double farthest = 2;  // of a node from the centre that it is tied to [d50]

std::size_t place_of(int column, int row, int columns) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
}

/// Cells that fill the box around the centres of the discs but for a margin of less than a cell, the same on either side.
StrainGrid grid_over(Snapshot const& s, double spacing) {
  StrainGrid grid;
  if (!(spacing > 0)) return grid;
  double left = HUGE_VAL, right = -HUGE_VAL, bottom = HUGE_VAL, top = -HUGE_VAL;
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    if (!std::isfinite(s.x[i]) || !std::isfinite(s.y[i])) continue;
    left = std::min(left, s.x[i]), right = std::max(right, s.x[i]);
    bottom = std::min(bottom, s.y[i]), top = std::max(top, s.y[i]);
  }
  if (!(right > left) || !(top > bottom)) return grid;
  // A disc that is far off must not ask for more cells than there are discs to fill them.
  double const most = (4 * std::sqrt(static_cast<double>(s.x.size())) + 4) * std::max(1.0, s.d50 / spacing);
  grid.columns = static_cast<int>(std::min(most, (right - left) / spacing));
  grid.rows = static_cast<int>(std::min(most, (top - bottom) / spacing));
  grid.spacing = spacing;
  grid.left = (left + right - grid.columns * spacing) / 2;
  grid.bottom = (bottom + top - grid.rows * spacing) / 2;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      grid.x.push_back(grid.left + (column + 0.5) * spacing);
      grid.y.push_back(grid.bottom + (row + 0.5) * spacing);
    }
  return grid;
}

/// The disc that a node is tied to.
struct Tie {
  double distance_squared = HUGE_VAL;
  std::int32_t id = 0;
  std::size_t disc = 0;  ///< place in the snapshot of the start
  bool tied() const { return std::isfinite(distance_squared); }
};

/// Each disc offers itself to the nodes within its reach; the nearest one stays, whatever the order of the offers.
std::vector<Tie> tied_nodes(StrainGrid const& grid, Snapshot const& s) {
  int const columns = grid.columns + 1, rows = grid.rows + 1;
  std::vector<Tie> nodes(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  double const reach = farthest * s.d50;
  auto const first = [&](double from) { return static_cast<int>(std::max(0.0, std::ceil(from / grid.spacing))); };
  auto const last = [&](double to, int count) {
    return static_cast<int>(std::clamp(std::floor(to / grid.spacing), -1.0, count - 1.0));
  };
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    double const x = s.x[i] - grid.left, y = s.y[i] - grid.bottom;
    if (!(std::abs(x) < columns * grid.spacing + reach && std::abs(y) < rows * grid.spacing + reach)) continue;
    for (int row = first(y - reach); row <= last(y + reach, rows); ++row)
      for (int column = first(x - reach); column <= last(x + reach, columns); ++column) {
        double const dx = column * grid.spacing - x, dy = row * grid.spacing - y, squared = dx * dx + dy * dy;
        Tie& node = nodes[place_of(column, row, columns)];
        if (squared > reach * reach || squared > node.distance_squared) continue;
        if (squared < node.distance_squared || s.id[i] < node.id) node = {squared, s.id[i], i};
      }
  }
  return nodes;
}

/// Displacements of the nodes [m], which turn with their discs.
std::vector<Eigen::Vector2d> node_displacements(StrainGrid const& grid, Snapshot const& start, Snapshot const& now) {
  std::unordered_map<std::int32_t, std::size_t> place;
  for (std::size_t i = 0; i < now.id.size(); ++i) place[now.id[i]] = i;
  std::vector<Tie> const nodes = tied_nodes(grid, start);
  std::vector<Eigen::Vector2d> displacements(nodes.size(), Eigen::Vector2d::Constant(not_known));
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    auto const found = nodes[k].tied() ? place.find(nodes[k].id) : place.end();
    if (found == place.end()) continue;
    std::size_t const i = nodes[k].disc, j = found->second, columns = static_cast<std::size_t>(grid.columns) + 1;
    double const lx = grid.left + static_cast<double>(k % columns) * grid.spacing - start.x[i];
    double const ly = grid.bottom + static_cast<double>(k / columns) * grid.spacing - start.y[i];
    double const turned = double(now.angle[j]) - double(start.angle[i]), c = std::cos(turned), s = std::sin(turned);
    displacements[k] = {now.x[j] - start.x[i] + (c * lx - s * ly - lx), now.y[j] - start.y[i] + (s * lx + c * ly - ly)};
  }
  return displacements;
}

/// E_1 - E_2 of Green's strain E = (F^T F - 1) / 2.
double green_shear(Eigen::Matrix2d const& f) {
  Eigen::Matrix2d const e = (f.transpose() * f - Eigen::Matrix2d::Identity()) / 2;
  double const shear = std::hypot(e(0, 0) - e(1, 1), 2 * e(0, 1));
  return std::isfinite(shear) ? shear : not_known;
}

}  // namespace

StrainGrid grain_strain(Snapshot const& start, Snapshot const& now, double spacing) {
  StrainGrid grid = grid_over(start, spacing * start.d50);
  if (grid.x.empty()) return {};
  std::vector<Eigen::Vector2d> const u = node_displacements(grid, start, now);
  // Over a cell the strain is a mean; and a node stands for the surroundings of its grain, as wide as this.
  grid.smoothing = std::sqrt((grid.spacing * grid.spacing + start.d50 * start.d50) / 12);
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      auto const node = [&](int right, int up) { return u[place_of(column + right, row + up, grid.columns + 1)]; };
      Eigen::Matrix2d f = Eigen::Matrix2d::Identity();
      f.col(0) += (node(1, 0) - node(0, 0) + (node(1, 1) - node(0, 1))) / (2 * grid.spacing);
      f.col(1) += (node(0, 1) - node(0, 0) + (node(1, 1) - node(1, 0))) / (2 * grid.spacing);
      grid.deformation.push_back({f(0, 0), f(0, 1), f(1, 0), f(1, 1)});
      grid.shear.push_back(static_cast<float>(green_shear(f)));
    }
  return grid;
}

std::vector<float> shear_at_discs(StrainGrid const& grid, Snapshot const& s) {
  std::vector<float> values(s.x.size(), std::numeric_limits<float>::quiet_NaN());
  if (grid.shear.empty()) return values;
  auto const cell = [&](double from, int count) { return static_cast<int>(std::clamp(from / grid.spacing, 0.0, count - 1.0)); };
  for (std::size_t i = 0; i < values.size(); ++i) {
    double const x = s.x[i] - double(s.ux[i]) - grid.left, y = s.y[i] - double(s.uy[i]) - grid.bottom;
    if (std::isfinite(x) && std::isfinite(y))
      values[i] = grid.shear[place_of(cell(x, grid.columns), cell(y, grid.rows), grid.columns)];
  }
  return values;
}

}  // namespace clathra
