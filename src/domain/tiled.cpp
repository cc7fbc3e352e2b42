#include "domain/tiled.hpp"

#include <algorithm>
#include <cmath>

#include "domain/loose_placement.hpp"
#include "domain/settling.hpp"

namespace clathra {

namespace {

constexpr double loose_solid_fraction = 0.5;
constexpr std::int64_t relaxation_steps = 3000;  // about what a wave needs to cross some tens of grains and come to rest

/// A box covered by copies of a periodic cell.
class Tiling {
 public:
  Tiling(Specimen const& cell, double width, double height)
      : cell_(cell),
        width_(width),
        height_(height),
        columns_(static_cast<int>(std::ceil(width / cell.width())) + 1),
        rows_(static_cast<int>(std::ceil(height / cell.height())) + 1),
        new_id_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) * cell.size(), -1) {}

  /// Adds the discs that lie wholly in the box, numbered as they come.
  void copy_discs(Specimen& whole) {
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) {
        for (std::size_t i = 0; i < cell_.size(); ++i) {
          double const x = cell_.x[i] - cell_.left + column * cell_.width(), y = cell_.y[i] - cell_.bottom + row * cell_.height();
          double const r = cell_.radius[i];
          if (x < r || x > width_ - r || y < r || y > height_ - r) continue;
          id_in_tile(column, row, cell_.id[i]) = static_cast<int>(whole.id.size());
          whole.id.push_back(static_cast<int>(whole.id.size()));
          whole.x.push_back(x);
          whole.y.push_back(y);
          whole.radius.push_back(r);
          whole.angle.push_back(0);
        }
      }
    }
    for (auto* field : {&whole.vx, &whole.vy, &whole.omega}) field->assign(whole.size(), 0);
  }

  /// Adds the contacts between discs that are in the box, with their history.
  void copy_contacts(Specimen& whole) {
    std::vector<std::size_t> place(cell_.size());
    for (std::size_t i = 0; i < cell_.size(); ++i) place[static_cast<std::size_t>(cell_.id[i])] = i;
    for (SpecimenContact const& c : cell_.contacts) {
      std::size_t const a = place[static_cast<std::size_t>(c.id_a)], b = place[static_cast<std::size_t>(c.id_b)];
      // The image of b that touches a lies in the same tile or in the one next to it.
      auto const right = static_cast<int>(-std::llround((cell_.x[b] - cell_.x[a]) / cell_.width())),
                 up = static_cast<int>(-std::llround((cell_.y[b] - cell_.y[a]) / cell_.height()));
      for (int row = std::max(0, -up); row < std::min(rows_, rows_ - up); ++row)
        for (int column = std::max(0, -right); column < std::min(columns_, columns_ - right); ++column)
          add_contact(whole, c, id_in_tile(column, row, c.id_a), id_in_tile(column + right, row + up, c.id_b));
    }
  }

 private:
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

  /// The new id of a disc of the cell in a tile, -1 where the box cuts it away.
  int& id_in_tile(int column, int row, int id) {
    std::size_t const tile =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
    return new_id_[tile * cell_.size() + static_cast<std::size_t>(id)];
  }

  Specimen const& cell_;
  double width_, height_;
  int columns_, rows_;
  std::vector<int> new_id_;
};

}  // namespace

PackedSpecimen pack_periodic_cell(Scene const& scene, SampleDesign const& design, std::int64_t particles,
                                  ProgressCallback const& progress) {
  double const d50 = design.grading.d50();
  GenerationFriction knob;
  if (design.void_ratio > 0.25) knob.shape_factor = 2;
  Specimen specimen;
  specimen.periodic = true;
  specimen.density = scene.grains.density;
  specimen.d50 = d50;
  specimen.radius = random_radii(design.grading, particles, scene.run.seed, 100);
  double solid = 0;
  for (double r : specimen.radius) solid += pi * r * r;
  double const side = std::sqrt(solid / loose_solid_fraction);
  specimen.right = specimen.top = side;
  Placement const placed = place_loosely(specimen.radius, {0, 0, side, side, true}, scene.run.seed, 1);
  specimen.x = placed.x;
  specimen.y = placed.y;
  for (std::int64_t i = 0; i < particles; ++i) specimen.id.push_back(static_cast<int>(i));
  Simulation simulation(specimen, generation_laws(scene, knob), 0.25 * d50);
  SettlingTarget target;
  target.stress = scene.bond.stress;
  target.void_ratio = design.void_ratio;
  target.d50 = d50;
  PackedSpecimen packed;
  double const share = settle(simulation, scene, knob, target, progress);
  packed.specimen = simulation.specimen();
  packed.specimen.stress = scene.bond.stress;
  packed.friction = knob.friction * share;
  packed.shape_factor = knob.shape_factor * share;
  packed.disc_steps = simulation.steps() * simulation.discs();
  return packed;
}

Specimen replicate(Specimen const& cell, double width, double height) {
  Specimen whole;
  whole.right = width;
  whole.top = height;
  whole.density = cell.density;
  whole.d50 = cell.d50;
  whole.stress = cell.stress;
  Tiling tiling(cell, width, height);
  tiling.copy_discs(whole);
  tiling.copy_contacts(whole);
  return whole;
}

PackedSpecimen pack_by_tiling(Scene const& scene, SampleDesign const& design, ProgressCallback const& progress) {
  double const d50 = design.grading.d50();
  std::int64_t const tile = std::min(scene.sample.tile_particles, design.particles);
  PackedSpecimen packed = pack_periodic_cell(scene, design, tile, progress);
  Specimen const whole = replicate(packed.specimen, design.width, design.height);
  GenerationFriction knob;
  if (design.void_ratio > 0.25) knob.shape_factor = 2;
  Simulation simulation(whole, generation_laws(scene, knob), 0.05 * d50);
  // The cell's equilibrium is kept inside; the walls close the cut discs' gaps at a speed whose wave stays below the stress.
  prepare_servo(simulation, scene.bond.stress, 1e-3, d50, 0.8);
  double const quiet = 0.5 * scene.bond.stress / (simulation.density() / (1 + design.void_ratio) * wave_speed(simulation));
  simulation.loading.x.largest_speed = simulation.loading.y.largest_speed = quiet;
  for (std::int64_t n = 0; n < relaxation_steps; ++n) {
    simulation.step();
    if (n % 100 == 99) {
      report(progress, {"generate", 0.7 + 0.3 * static_cast<double>(n) / relaxation_steps, "relaxing near the walls",
                        packed.disc_steps + simulation.steps() * simulation.discs()});
    }
  }
  packed.disc_steps += simulation.steps() * simulation.discs();
  packed.specimen = simulation.specimen();
  packed.specimen.stress = scene.bond.stress;
  packed.unbalanced = simulation.measures().unbalanced_ratio(simulation.discs());
  packed.stress_x = simulation.stress().x;
  packed.stress_y = simulation.stress().y;
  return packed;
}

}  // namespace clathra
