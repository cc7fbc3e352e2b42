#include "domain/measurement/specimen_facts.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>
#include <vector>

#include "domain/measurement/disc_grading.hpp"
#include "domain/parallel/decomposition.hpp"
#include "kernels/exact_sum.hpp"

namespace clathra {
namespace {

constexpr double none = 1e300;

/// The disc nearest to each wall of those of this rank.
void look_at_walls(Specimen const& part, std::array<DiscAtWall, 4>& at_wall) {
  for (DiscAtWall& at : at_wall) at = {-1, none, none};
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
int smallest_id(Ranks const& ranks, bool counts, int id) { return static_cast<int>(ranks.min(counts ? id : none)); }

struct PlacedDisc {
  double x, y, radius;
  int id;
  bool own;  ///< of this rank, not one that reaches over from a neighbour
};

/// This rank's discs by their places, and those of others that may touch them.
std::vector<PlacedDisc> with_neighbours(Specimen const& part, double largest, Ranks const& ranks) {
  std::vector<PlacedDisc> discs;
  if (ranks.alone()) {
    for (std::size_t i = 0; i < part.size(); ++i) discs.push_back({part.x[i], part.y[i], part.radius[i], part.id[i], true});
    return discs;
  }
  Decomposition const cuts = Decomposition::bisect(ranks, part.x, part.y, 1);
  std::vector<Rectangle> rectangles;
  for (int rank = 0; rank < ranks.count(); ++rank) rectangles.push_back(cuts.rectangle(rank));
  std::vector<std::vector<double>> to(rectangles.size());
  for (std::size_t i = 0; i < part.size(); ++i) {
    double const x = part.x[i], y = part.y[i], reach = part.radius[i] + largest;
    auto const owner = static_cast<std::size_t>(cuts.owner(x, y));
    for (std::size_t rank = 0; rank < to.size(); ++rank) {
      Rectangle const& r = rectangles[rank];
      if (rank == owner || (x > r.left - reach && x < r.right + reach && y > r.bottom - reach && y < r.top + reach))
        to[rank].insert(to[rank].end(), {x, y, part.radius[i], double(part.id[i]), rank == owner ? 1.0 : 0.0});
    }
  }
  for (auto const& numbers : ranks.exchange(std::move(to)))
    for (auto n = numbers.begin(); n != numbers.end(); n += 5)
      discs.push_back({n[0], n[1], n[2], static_cast<int>(n[3]), n[4] > 0});
  return discs;
}

/// A disc and the cell that it lies in.
struct Cell {
  std::int64_t row, column;
  PlacedDisc const* disc;
  bool operator<(Cell const& other) const {
    return std::tie(row, column, disc->id) < std::tie(other.row, other.column, other.disc->id);
  }
};

/// Discs nearer than a few sizes are found by cells of that size: classes of discs from a largest radius down to half of it, each
/// with the discs of its own class and of all smaller ones. Few of one class fit into a cell, so few are looked at.
template <class Visit>
void for_each_near_pair(std::vector<PlacedDisc> const& discs, double largest, Visit const& visit) {
  for (double size = largest, smaller = 0; size > 0; size = smaller, smaller = 0) {
    auto const index = [&](double at) { return static_cast<std::int64_t>(std::clamp(std::floor(at / (2 * size)), -1e18, 1e18)); };
    auto const is_member = [&](PlacedDisc const& disc) { return disc.radius > size / 2; };
    std::vector<Cell> cells, members;
    for (PlacedDisc const& disc : discs) {
      if (disc.radius > size) continue;
      cells.push_back({index(disc.y), index(disc.x), &disc});
      if (!is_member(disc)) smaller = std::max(smaller, disc.radius);
    }
    std::sort(cells.begin(), cells.end());
    std::copy_if(cells.begin(), cells.end(), std::back_inserter(members), [&](Cell const& c) { return is_member(*c.disc); });
    std::size_t from[3] = {0, 0, 0};  // in the rows below, of and above a disc: cells come in their order
    for (Cell const& cell : cells) {
      for (std::int64_t k = 0; k < 3; ++k) {
        std::int64_t const row = cell.row + k - 1;
        std::size_t& at = from[k];
        while (at < members.size() && std::tie(members[at].row, members[at].column) < std::tuple(row, cell.column - 1)) ++at;
        for (std::size_t m = at; m < members.size() && members[m].row == row && members[m].column <= cell.column + 1; ++m)
          if (!is_member(*cell.disc) || cell.disc->id < members[m].disc->id) visit(*cell.disc, *members[m].disc);
      }
    }
  }
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
  double place[] = {mine ? deepest.x : -none, mine ? deepest.y : -none};
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
  return outline;
}

SpecimenOverlaps overlaps_of(Specimen const& part, Ranks const& ranks) {
  double largest = 0;
  for (double const r : part.radius) largest = std::max(largest, r);
  largest = ranks.max(largest);
  SpecimenOverlaps found;
  ExactSum stress(SumUnits::near(largest * largest));
  std::vector<PlacedDisc> const discs = with_neighbours(part, largest, ranks);
  for_each_near_pair(discs, largest, [&](PlacedDisc const& one, PlacedDisc const& other) {
    PlacedDisc const &a = one.id < other.id ? one : other, &b = one.id < other.id ? other : one;
    double const dx = b.x - a.x, dy = b.y - a.y, sum = a.radius + b.radius, square = dx * dx + dy * dy;
    if (!a.own || !(square < sum * sum)) return;
    double const branch = std::sqrt(square), share = (sum - branch) / std::min(a.radius, b.radius);
    ++found.touching;
    found.deep += share > deep_pair;
    found.through += share > 1;
    stress.add((sum - branch) * branch);
    OverlappingPair const pair{share, a.id, b.id, a.x, a.y};
    OverlappingPair& deepest = found.deepest;
    bool const first = std::tie(a.id, b.id) < std::tie(deepest.id_a, deepest.id_b);
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
