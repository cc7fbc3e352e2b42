#pragma once
/// Pairs of discs that lie near each other, searched for on the host: of specimens that are read, bonded or looked at, whatever
/// their sizes and however far "near" is. A simulation lists those of its discs itself (kernels/neighbours.hpp).
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <vector>

#include "domain/parallel/ranks.hpp"
#include "domain/scene/specimen.hpp"

namespace clathra {

/// Discs of a specimen by index, a having the smaller id, and the distance of their surfaces [m] (negative: overlap).
struct NearPair {
  std::size_t a, b;
  double gap;
};

/// This rank's share of a specimen with the discs of other ranks behind it that lie within `reach` [m] (surface to surface) of
/// any of its own: ids, positions and radii alone. The share must be spatially together (by_place()), or everything comes.
Specimen with_halo(Ranks const& ranks, Specimen const& share, double reach);

/// The discs of a size and those smaller by square cell, cell by cell.
class CellsOfDiscs {
 public:
  /// A disc by index and the cell that it lies in.
  struct Entry {
    std::int64_t row, column;
    std::size_t disc;
  };

  /// @param largest  radius of those that are sorted [m];  @param reach  [m]
  CellsOfDiscs(Specimen const& specimen, double largest, double reach);

  /// Calls visit(one, other) for each pair whose cells are the same or side by side, `other` being one of the larger half of the
  /// sizes here; of two of these once, the smaller id first.
  template <class Visit>
  void for_each_pair(Specimen const& s, Visit const& visit) const {
    std::size_t from[3] = {0, 0, 0};  // in the rows below, of and above a disc: cells come in their order
    for (Entry const& at : all_) {
      for (std::int64_t k = 0; k < 3; ++k) {
        std::int64_t const row = at.row + k - 1;
        std::size_t& m = from[k];
        while (m < large_.size() && std::tie(large_[m].row, large_[m].column) < std::tuple(row, at.column - 1)) ++m;
        for (std::size_t n = m; n < large_.size() && large_[n].row == row && large_[n].column <= at.column + 1; ++n)
          if (!is_large(s, at.disc) || s.id[at.disc] < s.id[large_[n].disc]) visit(at.disc, large_[n].disc);
      }
    }
  }
  /// The largest radius of the smaller half of the sizes, 0 without any [m].
  double next_radius() const { return next_radius_; }

 private:
  bool is_large(Specimen const& s, std::size_t disc) const { return s.radius[disc] > largest_ / 2; }

  double largest_, next_radius_ = 0;
  std::vector<Entry> all_, large_;
};

/// Calls visit(pair) for each pair with a gap below `reach` [m] whose disc a is among the first `own` of the list, in any order.
/// Classes of discs, from a largest radius down to half of it, are searched one after the other, each among itself and all
/// smaller ones, by cells of its own size: few of a class fit into a cell, so few are looked at however wide the grading is.
/// @param reach  may be below zero
template <class Visit>
void for_each_near_pair(Specimen const& s, std::size_t own, double reach, Visit const& visit) {
  double largest = s.size() == 0 ? 0 : *std::max_element(s.radius.begin(), s.radius.end());
  while (largest > 0) {
    CellsOfDiscs const cells(s, largest, reach);
    cells.for_each_pair(s, [&](std::size_t one, std::size_t other) {
      std::size_t const a = s.id[one] < s.id[other] ? one : other, b = a == one ? other : one;
      if (a >= own) return;
      double const dx = s.x[b] - s.x[a], dy = s.y[b] - s.y[a];
      double const gap = std::sqrt(dx * dx + dy * dy) - (s.radius[a] + s.radius[b]);
      if (gap < reach) visit(NearPair{a, b, gap});
    });
    largest = cells.next_radius();
  }
}

/// The same as a list, sorted by (id of a, id of b).
std::vector<NearPair> near_pairs(Specimen const& specimen, std::size_t own, double reach);

}  // namespace clathra
