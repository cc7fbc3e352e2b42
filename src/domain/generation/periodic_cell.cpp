#include "domain/generation/periodic_cell.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "domain/generation/compression.hpp"
#include "domain/generation/loose_discs.hpp"
#include "domain/generation/random_sequential_addition.hpp"

namespace clathra {

namespace {

/// A box covered by copies of a periodic cell. Discs are numbered tile by tile as they come; what a tile holds follows from its
/// place alone, so that no list of all discs is needed.
class Tiling {
 public:
  Tiling(Specimen const& cell, double width, double height)
      : cell_(cell),
        width_(width),
        height_(height),
        columns_(static_cast<int>(std::ceil(width / cell.width())) + 1),
        rows_(static_cast<int>(std::ceil(height / cell.height())) + 1),
        place_(cell.size()),
        first_id_(static_cast<std::size_t>(tiles()) + 1, 0) {
    for (std::size_t i = 0; i < cell_.size(); ++i) place_[static_cast<std::size_t>(cell_.id[i])] = i;
    for (int tile = 0; tile < tiles(); ++tile) {
      int kept = 0;
      for (std::size_t i = 0; i < cell_.size(); ++i) kept += keeps(tile, i) ? 1 : 0;
      first_id_[static_cast<std::size_t>(tile) + 1] = first_id_[static_cast<std::size_t>(tile)] + kept;
    }
  }
  int tiles() const { return columns_ * rows_; }

  /// Adds the discs of a tile that lie wholly in the box.
  void copy_discs(int tile, Specimen& whole) const {
    int id = first_id_[static_cast<std::size_t>(tile)];
    for (std::size_t i = 0; i < cell_.size(); ++i) {
      if (!keeps(tile, i)) continue;
      whole.id.push_back(id++);
      whole.x.push_back(x(tile, i));
      whole.y.push_back(y(tile, i));
      whole.radius.push_back(cell_.radius[i]);
      for (auto* field : {&whole.angle, &whole.vx, &whole.vy, &whole.omega}) field->push_back(0);
    }
  }

  /// Adds the contacts, with their history, whose first disc is in a tile and whose second one is in the box.
  void copy_contacts(int tile, Specimen& whole) const {
    std::map<int, std::vector<int>> ids;  // of the discs of this tile and those around it
    int const column = tile % columns_, row = tile / columns_;
    for (SpecimenContact const& c : cell_.contacts) {
      std::size_t const a = place_[static_cast<std::size_t>(c.id_a)], b = place_[static_cast<std::size_t>(c.id_b)];
      // The image of b that touches a lies in the same tile or in the one next to it.
      auto const right = static_cast<int>(-std::llround((cell_.x[b] - cell_.x[a]) / cell_.width())),
                 up = static_cast<int>(-std::llround((cell_.y[b] - cell_.y[a]) / cell_.height()));
      if (column + right < 0 || column + right >= columns_ || row + up < 0 || row + up >= rows_) continue;
      int const other = (row + up) * columns_ + column + right;
      for (int const t : {tile, other}) {
        if (ids[t].empty()) ids[t] = ids_of(t);
      }
      add_contact(whole, c, ids[tile][a], ids[other][b]);
    }
  }

 private:
  double x(int tile, std::size_t i) const { return cell_.x[i] - cell_.left + (tile % columns_) * cell_.width(); }
  double y(int tile, std::size_t i) const { return cell_.y[i] - cell_.bottom + (tile / columns_) * cell_.height(); }
  bool keeps(int tile, std::size_t i) const {
    double const at_x = x(tile, i), at_y = y(tile, i), r = cell_.radius[i];
    return !(at_x < r || at_x > width_ - r || at_y < r || at_y > height_ - r);
  }

  /// By place in the cell; -1 where the box cuts a disc away.
  std::vector<int> ids_of(int tile) const {
    std::vector<int> ids(cell_.size(), -1);
    int id = first_id_[static_cast<std::size_t>(tile)];
    for (std::size_t i = 0; i < cell_.size(); ++i) {
      if (keeps(tile, i)) ids[i] = id++;
    }
    return ids;
  }

  static void add_contact(Specimen& whole, SpecimenContact copy, int id_a, int id_b) {
    if (id_a < 0 || id_b < 0) return;
    copy.id_a = std::min(id_a, id_b);
    copy.id_b = std::max(id_a, id_b);
    if (id_a > id_b) {
      copy.moment = -copy.moment;
      copy.bond_moment = -copy.bond_moment;
    }
    whole.contacts.push_back(copy);
  }

  Specimen const& cell_;
  double width_, height_;
  int columns_, rows_;
  std::vector<std::size_t> place_;  // of a disc of the cell, by id
  std::vector<int> first_id_;       // of each tile
};

}  // namespace

PackedSpecimen pack_periodic_cell(Scene const& scene, SpecimenDesign const& design, std::int64_t particles,
                                  ProgressCallback const& progress) {
  Specimen specimen;
  specimen.periodic = true;
  specimen.density = scene.grains.density;
  specimen.d50 = design.grading.d50();
  specimen.radius = LooseDiscs(design.grading, particles, 1, scene.run.seed).radii(0);
  double solid = 0;
  for (double r : specimen.radius) solid += pi * r * r;
  std::optional<Placement> placed;
  for (double fraction = loose_solid_fraction; !placed; fraction *= looser) {
    double const side = std::sqrt(solid / fraction);
    specimen.right = specimen.top = side;
    placed = place_by_random_addition(specimen.radius, {0, 0, side, side, true}, scene.run.seed, 1);
  }
  specimen.x = placed->x;
  specimen.y = placed->y;
  for (std::int64_t i = 0; i < particles; ++i) specimen.id.push_back(static_cast<int>(i));
  return compress(specimen, scene, design, progress);
}

Specimen replicate(Specimen const& cell, double width, double height, Ranks const& ranks) {
  Specimen whole;
  whole.right = width;
  whole.top = height;
  whole.density = cell.density;
  whole.d50 = cell.d50;
  whole.stress = cell.stress;
  Tiling const tiling(cell, width, height);
  int const first = tiling.tiles() * ranks.rank() / ranks.count(), last = tiling.tiles() * (ranks.rank() + 1) / ranks.count();
  for (int tile = first; tile < last; ++tile) {
    tiling.copy_discs(tile, whole);
    tiling.copy_contacts(tile, whole);
  }
  return whole;
}

}  // namespace clathra
