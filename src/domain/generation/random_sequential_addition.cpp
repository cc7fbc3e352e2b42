#include "domain/generation/random_sequential_addition.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

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

struct Stratum {
  double left, right, bottom, top;
};

/// A region in parts of equal area, to which discs are dealt out in turn: centres anywhere would be more in one half than in the
/// other by as much as chance will have it, and a large assembly keeps that, since discs find their places among their
/// neighbours.
class Strata {
 public:
  /// @param discs  to be placed
  Strata(Region const& region, double largest_radius, std::size_t discs) : region_(region) {
    constexpr double discs_in_each = 50, diameters_across = 4;
    double const by_number = std::sqrt(region.width * region.height * discs_in_each / static_cast<double>(discs)),
                 side = std::max(by_number, diameters_across * 2 * largest_radius);
    columns_ = static_cast<std::size_t>(std::max(1.0, std::floor(region.width / side)));
    rows_ = static_cast<std::size_t>(std::max(1.0, std::floor(region.height / side)));
    turns_.resize(columns_ * rows_);
  }

  /// Where the centre of the n-th disc is to lie, n from 0 on. Whenever all parts have had a disc they are shuffled anew.
  Stratum of(std::size_t n, std::uint64_t seed, std::uint64_t stream) {
    std::size_t const turn = n % turns_.size();
    if (turn == 0) {
      std::iota(turns_.begin(), turns_.end(), std::size_t(0));
      shuffle(turns_, seed, stream + n / turns_.size());
    }
    auto const column = static_cast<double>(turns_[turn] % columns_), row = static_cast<double>(turns_[turn] / columns_);
    double const width = region_.width / static_cast<double>(columns_), height = region_.height / static_cast<double>(rows_);
    return {region_.left + column * width, region_.left + (column + 1) * width, region_.bottom + row * height,
            region_.bottom + (row + 1) * height};
  }

 private:
  Region region_;
  std::size_t columns_, rows_;
  std::vector<std::size_t> turns_;
};

/// A part of a region without the margins that discs of a radius keep from its closed sides.
Stratum inside_margins(Region const& region, Stratum part, double radius) {
  double const margin = region.periodic ? 0 : radius;
  part.left = std::max(part.left, region.left + (region.open_left ? 0 : margin));
  part.right = std::min(part.right, region.left + region.width - (region.open_right ? 0 : margin));
  part.bottom = std::max(part.bottom, region.bottom + margin);
  part.top = std::min(part.top, region.bottom + region.height - margin);
  return part;
}

}  // namespace

std::optional<Placement> place_by_random_addition(std::vector<double> const& radii, Region const& region, std::uint64_t seed,
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
  constexpr std::uint64_t of_strata = 1ULL << 40;
  Strata strata(region, largest, radii.size());
  std::uint64_t counter = 0;
  for (std::size_t n = 0; n < order.size(); ++n) {
    std::size_t const i = order[n];
    Stratum const part = inside_margins(region, strata.of(n, seed, of_strata * (1 + stream)), radii[i]);
    int tries = 0;
    double x = 0, y = 0;
    do {
      if (++tries > most_tries) return {};
      x = part.left + uniform_random(seed, stream, counter++) * (part.right - part.left);
      y = part.bottom + uniform_random(seed, stream, counter++) * (part.top - part.bottom);
    } while (!occupancy.is_free(x, y, radii[i]));
    placed.x[i] = x;
    placed.y[i] = y;
    occupancy.add({x, y, radii[i]});
  }
  return placed;
}

}  // namespace clathra
