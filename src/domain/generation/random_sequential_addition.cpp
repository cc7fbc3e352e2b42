#include "domain/generation/random_sequential_addition.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

#include "domain/generation/random.hpp"

namespace clathra {

namespace {

/// Placed discs in square cells, for quick overlap tests.
class Occupancy {
 public:
  Occupancy(Region const& region, double cell)
      : region_(region),
        columns_(std::max(1, static_cast<int>(region.width / cell))),
        rows_(std::max(1, static_cast<int>(region.height / cell))),
        cells_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {}

  bool is_free(double x, double y, double radius) const {
    int const column = column_of(x), row = row_of(y);
    for (int r = row - 1; r <= row + 1; ++r) {
      for (int c = column - 1; c <= column + 1; ++c) {
        if (!region_.periodic && (r < 0 || r >= rows_ || c < 0 || c >= columns_)) continue;
        for (PlacedDisc const& d : cells_[index((c + columns_) % columns_, (r + rows_) % rows_)]) {
          double dx = std::abs(d.x - x), dy = std::abs(d.y - y);
          if (region_.periodic) {
            dx = std::min(dx, region_.width - dx);
            dy = std::min(dy, region_.height - dy);
          }
          if (dx * dx + dy * dy < (d.radius + radius) * (d.radius + radius)) return false;
        }
      }
    }
    return true;
  }
  void add(PlacedDisc const& disc) { cells_[index(column_of(disc.x), row_of(disc.y))].push_back(disc); }

 private:
  int column_of(double x) const {
    return std::clamp(static_cast<int>((x - region_.left) / region_.width * columns_), 0, columns_ - 1);
  }
  int row_of(double y) const { return std::clamp(static_cast<int>((y - region_.bottom) / region_.height * rows_), 0, rows_ - 1); }
  std::size_t index(int c, int r) const {
    return static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(c);
  }

  Region region_;
  int columns_, rows_;
  std::vector<std::vector<PlacedDisc>> cells_;
};

}  // namespace

Placement place_by_random_addition(std::vector<double> const& radii, Region const& region, std::uint64_t seed,
                                   std::uint64_t stream, std::vector<PlacedDisc> const& around) {
  constexpr int most_tries = 20000;
  std::vector<std::size_t> order(radii.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return radii[a] > radii[b]; });
  Placement placed{std::vector<double>(radii.size()), std::vector<double>(radii.size())};
  double largest = radii[order.front()];
  for (PlacedDisc const& disc : around) largest = std::max(largest, disc.radius);
  Occupancy occupancy(region, 2.0 * largest);
  for (PlacedDisc const& disc : around) {
    if (disc.x + disc.radius + largest > region.left && disc.x - disc.radius - largest < region.left + region.width)
      occupancy.add(disc);
  }
  std::uint64_t counter = 0;
  for (std::size_t i : order) {
    double const margin = region.periodic ? 0 : radii[i], left = region.open_left ? 0 : margin,
                 right = region.open_right ? 0 : margin;
    int tries = 0;
    double x = 0, y = 0;
    do {
      if (++tries > most_tries)
        throw std::runtime_error("no room for disc " + std::to_string(i) + " of " + std::to_string(radii.size()) +
                                 " in a loose placement");
      x = region.left + left + uniform_random(seed, stream, counter++) * (region.width - (left + right));
      y = region.bottom + margin + uniform_random(seed, stream, counter++) * (region.height - 2 * margin);
    } while (!occupancy.is_free(x, y, radii[i]));
    placed.x[i] = x;
    placed.y[i] = y;
    occupancy.add({x, y, radii[i]});
  }
  return placed;
}

}  // namespace clathra
