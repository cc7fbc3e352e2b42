#include "domain/tiled.hpp"

#include <algorithm>
#include <cmath>

#include "domain/loose_placement.hpp"
#include "domain/settling.hpp"

namespace clathra {

namespace {

constexpr double loose_solid_fraction = 0.5;
constexpr std::int64_t relaxation_steps = 3000;  // about what a wave needs to cross some tens of grains and come to rest

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
  double const w = cell.width(), h = cell.height();
  auto const columns = static_cast<int>(std::ceil(width / w)) + 1, rows = static_cast<int>(std::ceil(height / h)) + 1;
  std::size_t const n = cell.size();
  std::vector<std::size_t> place(n);
  for (std::size_t i = 0; i < n; ++i) place[static_cast<std::size_t>(cell.id[i])] = i;
  // new_id[tile * n + id of the cell's disc], -1 where the box cuts it away
  std::vector<int> new_id(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows) * n, -1);
  auto const tile_at = [&](int column, int row) {
    return (static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column)) * n;
  };
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      for (std::size_t i = 0; i < n; ++i) {
        double const x = cell.x[i] - cell.left + column * w, y = cell.y[i] - cell.bottom + row * h, r = cell.radius[i];
        if (x < r || x > width - r || y < r || y > height - r) continue;
        new_id[tile_at(column, row) + static_cast<std::size_t>(cell.id[i])] = static_cast<int>(whole.id.size());
        whole.id.push_back(static_cast<int>(whole.id.size()));
        whole.x.push_back(x);
        whole.y.push_back(y);
        whole.radius.push_back(r);
        whole.angle.push_back(0);
      }
    }
  }
  whole.vx.assign(whole.size(), 0);
  whole.vy.assign(whole.size(), 0);
  whole.omega.assign(whole.size(), 0);
  for (SpecimenContact const& c : cell.contacts) {
    std::size_t const a = place[static_cast<std::size_t>(c.id_a)], b = place[static_cast<std::size_t>(c.id_b)];
    // The image of b that touches a lies in the same tile or in the one next to it.
    auto const column_shift = static_cast<int>(-std::llround((cell.x[b] - cell.x[a]) / w)),
               row_shift = static_cast<int>(-std::llround((cell.y[b] - cell.y[a]) / h));
    for (int row = std::max(0, -row_shift); row < std::min(rows, rows - row_shift); ++row) {
      for (int column = std::max(0, -column_shift); column < std::min(columns, columns - column_shift); ++column) {
        int const id_a = new_id[tile_at(column, row) + static_cast<std::size_t>(c.id_a)];
        int const id_b = new_id[tile_at(column + column_shift, row + row_shift) + static_cast<std::size_t>(c.id_b)];
        if (id_a < 0 || id_b < 0) continue;
        SpecimenContact copy = c;
        copy.id_a = std::min(id_a, id_b);
        copy.id_b = std::max(id_a, id_b);
        if (id_a > id_b) {
          copy.moment = -c.moment;
          copy.bond_moment = -c.bond_moment;
        }
        whole.contacts.push_back(copy);
      }
    }
  }
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
