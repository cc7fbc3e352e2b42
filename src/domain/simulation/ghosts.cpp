#include "domain/simulation/ghosts.hpp"

#include <algorithm>
#include <cmath>

#include "domain/parallel/migration.hpp"

namespace clathra {

void Ghosts::refresh(ParticleSoA const& particles, Box const& box) const {
  if (box.periodic) images_.refresh(particles, box);
  if (!ranks_.alone()) halo_.refresh(ranks_, particles);
}

void Ghosts::refresh(ParticleSoA const& particles, Box const& box, AnyField const& field) const {
  if (box.periodic) images_.refresh(particles, field);
  if (!ranks_.alone()) halo_.refresh(ranks_, particles, field);
}

void Ghosts::migrate_discs(AffineFrame const& motion, double seconds_of_a_search, ParticleSoA& particles,
                           AuxiliaryFields const& with_discs, OldRows& old, Field<int>& old_row, Scratch& scratch) {
  if (ranks_.alone()) return;
  decomposition_.follow(motion);
  rebalance_if_it_pays(particles, seconds_of_a_search);
  migrate(ranks_, decomposition_, particles, with_discs, old, old_row, scratch);
}

Bounds Ghosts::own_bounds(Bounds const& all, Box const& box) const {
  if (box.periodic) {
    Real const tilt = box.edges.xy;
    return {box.x + std::min(tilt, 0.0), box.x + box.width() + std::max(tilt, 0.0), box.y, box.y + box.height()};
  }
  if (ranks_.alone()) return all;
  Rectangle const own = decomposition_.rectangle(ranks_.rank());
  return {std::max(all.left, own.left), std::min(all.right, own.right), std::max(all.bottom, own.bottom),
          std::min(all.top, own.top)};
}

void Ghosts::rebuild(ParticleSoA& particles, Box const& box, Real reach) {
  if (box.periodic) images_.rebuild(particles, box, reach);
  if (!ranks_.alone()) halo_.rebuild(ranks_, decomposition_, particles, reach);
}

void Ghosts::rebalance_if_it_pays(ParticleSoA const& particles, double seconds_of_a_search) {
  constexpr double worth = 4, least_imbalance = 1.05;
  double slowest[2] = {busy_seconds_, seconds_of_a_search};
  ranks_.max(slowest, 2);
  double const mean = 1e-9 * static_cast<double>(ranks_.sum(std::llround(1e9 * busy_seconds_))) / ranks_.count();
  if (slowest[0] < least_imbalance * mean || slowest[0] - mean < worth * slowest[1]) return;
  double const seconds_a_disc = busy_seconds_ / std::max(particles.owned, 1);
  double const weight = 1e6 * seconds_a_disc / std::max(ranks_.max(seconds_a_disc), 1e-300);
  decomposition_ = Decomposition::bisect(ranks_, particles, std::max<std::int64_t>(1, std::llround(weight)));
  busy_seconds_ = 0;
}

}  // namespace clathra
