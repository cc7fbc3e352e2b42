#include "domain/measurement/specimen_facts.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "domain/measurement/disc_grading.hpp"
#include "domain/parallel/near_pairs.hpp"
#include "domain/parallel/redistribution.hpp"
#include "kernels/exact_sum.hpp"

namespace clathra {
namespace {

constexpr double farthest_of_all = 1e300;

/// The disc nearest to each wall of those of this rank.
void look_at_walls(Specimen const& part, std::array<DiscAtWall, 4>& at_wall) {
  for (DiscAtWall& at : at_wall) at = {-1, farthest_of_all, farthest_of_all};
  for (std::size_t i = 0; i < part.size(); ++i) {
    double const depths[] = {part.x[i] - part.left, part.right - part.x[i], part.y[i] - part.bottom, part.top - part.y[i]};
    for (std::size_t wall = 0; wall < 4; ++wall) {
      DiscAtWall& at = at_wall[wall];
      at.space = std::min(at.space, depths[wall] - part.radius[i]);
      if (std::tie(depths[wall], part.id[i]) < std::tie(at.depth, at.id)) at.depth = depths[wall], at.id = part.id[i];
    }
  }
}

/// The smallest of the ranks' ids that count.
int smallest_id(Ranks const& ranks, bool counts, int id) { return static_cast<int>(ranks.min(counts ? id : farthest_of_all)); }

/// Columns of motion that are empty stand for rest.
FastestDisc fastest_of(Specimen const& part, Ranks const& ranks) {
  auto const number = [](std::vector<double> const& column, std::size_t i) { return column.empty() ? 0 : column[i]; };
  FastestDisc fastest;
  for (std::size_t i = 0; i < part.size(); ++i) {
    double const speed = std::hypot(number(part.vx, i), number(part.vy, i)) + std::abs(number(part.omega, i)) * part.radius[i];
    if (fastest.id < 0 || speed > fastest.speed || (speed == fastest.speed && part.id[i] < fastest.id))
      fastest = {part.id[i], speed};
  }
  double const speed = ranks.max(fastest.speed);
  return {smallest_id(ranks, fastest.id >= 0 && fastest.speed == speed, fastest.id), speed};
}

/// This rank's discs by their places, so many of them, and those of others that may touch them behind them.
Specimen with_neighbours(Specimen const& part, Ranks const& ranks, std::size_t& own) {
  Specimen bare;
  bare.id = part.id;
  for (ParticleColumn const& column : particle_columns) (bare.*column.of).resize(part.size());
  bare.x = part.x;
  bare.y = part.y;
  bare.radius = part.radius;
  Specimen const here = by_place(ranks, std::move(bare));
  own = here.size();
  return with_halo(ranks, here, 0);
}

/// The deepest of all ranks' deepest pairs; of equal ones that with the smallest ids.
void agree(Ranks const& ranks, OverlappingPair& deepest) {
  double const share = ranks.max(deepest.share);
  if (share == 0) return;
  bool mine = deepest.share == share;
  for (int* const id : {&deepest.id_a, &deepest.id_b}) {
    int const smallest = smallest_id(ranks, mine, *id);
    mine = mine && *id == smallest;
    *id = smallest;
  }
  double place[] = {mine ? deepest.x : -farthest_of_all, mine ? deepest.y : -farthest_of_all};
  ranks.max(place, 2);
  deepest = {share, deepest.id_a, deepest.id_b, place[0], place[1]};
}

}  // namespace

SpecimenOutline outline_of(Specimen const& part, Ranks const& ranks) {
  SpecimenOutline outline;
  outline.discs = ranks.sum(static_cast<std::int64_t>(part.size()));
  outline.sizes = sizes_of(part.radius, ranks);
  outline.void_ratio = part.width() * part.height() / solid_area(part.radius, ranks) - 1;
  double farthest = 0;
  for (double const at : {part.left, part.right, part.bottom, part.top}) farthest = std::max(farthest, std::abs(at));
  std::int64_t outside = 0;
  for (std::size_t i = 0; i < part.size(); ++i) {
    farthest = std::max({farthest, std::abs(part.x[i]), std::abs(part.y[i])});
    outside += part.x[i] < part.left || part.x[i] > part.right || part.y[i] < part.bottom || part.y[i] > part.top;
  }
  outline.farthest = ranks.max(farthest);
  outline.outside = ranks.sum(outside);
  look_at_walls(part, outline.at_wall);
  for (DiscAtWall& at : outline.at_wall) {
    double const depth = ranks.min(at.depth);
    at.id = smallest_id(ranks, at.depth == depth, at.id);
    at.depth = depth;
    at.space = ranks.min(at.space);
  }
  outline.fastest = fastest_of(part, ranks);
  return outline;
}

SpecimenDesign design_of(Specimen const& part, Ranks const& ranks) {
  Grading const grading = grading_of(part.radius, ranks);
  return {ranks.sum(static_cast<std::int64_t>(part.size())), part.width(), part.height(), part.void_ratio,
          grading.scaled(part.d50 > 0 ? part.d50 / grading.d50() : 1)};
}

SpecimenOverlaps overlaps_of(Specimen const& part, Ranks const& ranks) {
  Specimen by_rectangles;
  std::size_t own = part.size();
  if (!ranks.alone()) by_rectangles = with_neighbours(part, ranks, own);
  Specimen const& s = ranks.alone() ? part : by_rectangles;
  double largest = 0;
  for (double const r : part.radius) largest = std::max(largest, r);
  largest = ranks.max(largest);
  SpecimenOverlaps found;
  ExactSum stress(SumUnits::near(largest * largest));
  for_each_near_pair(s, own, 0, [&](NearPair const& p) {
    double const sum = s.radius[p.a] + s.radius[p.b], share = -p.gap / std::min(s.radius[p.a], s.radius[p.b]);
    ++found.touching;
    found.deep += share > deep_pair;
    found.through += share > 1;
    stress.add(-p.gap * (sum + p.gap));
    OverlappingPair const pair{share, s.id[p.a], s.id[p.b], s.x[p.a], s.y[p.a]};
    OverlappingPair& deepest = found.deepest;
    bool const first = std::tie(pair.id_a, pair.id_b) < std::tie(deepest.id_a, deepest.id_b);
    if (share > deepest.share || (share == deepest.share && first)) deepest = pair;
  });
  agree(ranks, found.deepest);
  std::int64_t counts[] = {found.touching, found.deep, found.through};
  ranks.sum(counts, 3);
  found.touching = counts[0], found.deep = counts[1], found.through = counts[2];
  found.stress = stress.over(ranks.summation()) / (2 * part.width() * part.height());
  return found;
}

}  // namespace clathra
