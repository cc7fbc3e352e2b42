#include "domain/parallel/decomposition.hpp"

#include <algorithm>
#include <cmath>

namespace clathra {

namespace {

constexpr int bins = 2048;  // a cut is found to this part of the side

/// A group of ranks whose rectangle is still to be cut, and the discs in it.
struct Group {
  int first_rank, ranks;
  int parent;  // cut that made it, -1 for the whole
  bool above;
  std::array<double, 4> extent;  // left, right, bottom, top of the discs of all ranks
};

/// The extents of the groups over all ranks; a group without discs gets a point.
void find_extents(Ranks const& ranks, std::vector<Group>& groups, std::vector<int> const& group_of, std::vector<double> const& x,
                  std::vector<double> const& y) {
  std::vector<double> extremes(4 * groups.size(), -1e300);
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (group_of[i] < 0) continue;
    double* const e = &extremes[4 * static_cast<std::size_t>(group_of[i])];
    e[0] = std::max(e[0], -x[i]);
    e[1] = std::max(e[1], x[i]);
    e[2] = std::max(e[2], -y[i]);
    e[3] = std::max(e[3], y[i]);
  }
  ranks.max(extremes.data(), static_cast<int>(extremes.size()));
  for (std::size_t g = 0; g < groups.size(); ++g) {
    double const* const e = &extremes[4 * g];
    groups[g].extent = e[1] < -1e299 ? std::array<double, 4>{0, 0, 0, 0} : std::array<double, 4>{-e[0], e[1], -e[2], e[3]};
  }
}

bool cut_upright(Group const& g) { return g.extent[1] - g.extent[0] >= g.extent[3] - g.extent[2]; }

/// Side that is cut: where it begins, and the length of a bin.
std::array<double, 2> scale(Group const& g) {
  double const low = cut_upright(g) ? g.extent[0] : g.extent[2], high = cut_upright(g) ? g.extent[1] : g.extent[3];
  return {low, std::max((high - low) / bins, 1e-300)};
}

/// The edge of the bins below which the lower half of the ranks finds its share of the weight.
double best_cut(Group const& g, std::int64_t const* weights) {
  std::int64_t total = 0, below = 0;
  for (int b = 0; b < bins; ++b) total += weights[b];
  double const wanted = static_cast<double>(total) * (g.ranks / 2) / g.ranks;
  int edge = 0;
  while (edge < bins &&
         std::abs(static_cast<double>(below + weights[edge]) - wanted) <= std::abs(static_cast<double>(below) - wanted))
    below += weights[edge++];
  auto const [low, bin] = scale(g);
  return low + edge * bin;
}

/// The weights of all ranks' discs in the bins of each group's side.
std::vector<std::int64_t> weights_by_bin(Ranks const& ranks, std::vector<Group> const& groups, std::vector<int> const& group_of,
                                         std::vector<double> const& x, std::vector<double> const& y, std::int64_t weight) {
  std::vector<std::int64_t> weights(groups.size() * bins, 0);
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (group_of[i] < 0) continue;
    auto const group = static_cast<std::size_t>(group_of[i]);
    auto const [low, bin] = scale(groups[group]);
    auto const at = static_cast<int>(((cut_upright(groups[group]) ? x[i] : y[i]) - low) / bin);
    weights[group * bins + static_cast<std::size_t>(std::clamp(at, 0, bins - 1))] += weight;
  }
  ranks.sum(weights.data(), static_cast<int>(weights.size()));
  return weights;
}

/// Cuts each group in two. @param child  on return the new groups below and above each cut, -1 for single ranks
std::vector<Group> cut_groups(std::vector<Group> const& groups, std::vector<std::int64_t> const& weights, std::vector<Cut>& cuts,
                              std::vector<std::array<int, 2>>& child) {
  std::vector<Group> next;
  child.assign(groups.size(), {-1, -1});
  for (std::size_t k = 0; k < groups.size(); ++k) {
    Group const& g = groups[k];
    auto const cut = static_cast<int>(cuts.size());
    if (g.parent >= 0) {
      Cut& parent = cuts[static_cast<std::size_t>(g.parent)];
      (g.above ? parent.above : parent.below) = cut;
    }
    cuts.push_back({cut_upright(g), best_cut(g, &weights[k * bins]), -1, -1});
    for (bool const above : {false, true}) {
      int const lower = g.ranks / 2, first = above ? g.first_rank + lower : g.first_rank, count = above ? g.ranks - lower : lower;
      (above ? cuts.back().above : cuts.back().below) = -1 - first;
      if (count == 1) continue;
      child[k][above ? 1 : 0] = static_cast<int>(next.size());
      next.push_back({first, count, cut, above, {}});
    }
  }
  return next;
}

}  // namespace

Decomposition::Decomposition(std::vector<Cut> cuts) : cuts_(std::move(cuts)) {}

Decomposition Decomposition::bisect(Ranks const& ranks, ParticleSoA const& particles, std::int64_t weight) {
  if (ranks.count() == 1) return {};
  auto const n = static_cast<std::size_t>(particles.owned);
  auto const host_x = host_copy(particles.x);
  auto const host_y = host_copy(particles.y);
  return bisect(ranks, {host_x.data(), host_x.data() + n}, {host_y.data(), host_y.data() + n}, weight);
}

Decomposition Decomposition::bisect(Ranks const& ranks, std::vector<double> const& x, std::vector<double> const& y,
                                    std::int64_t weight) {
  if (ranks.count() == 1) return {};
  std::size_t const n = x.size();
  std::vector<int> group_of(n, 0);
  std::vector<Group> groups{{0, ranks.count(), -1, false, {}}};
  std::vector<Cut> cuts;
  std::vector<std::array<int, 2>> child;
  while (!groups.empty()) {
    find_extents(ranks, groups, group_of, x, y);
    std::size_t const first_cut = cuts.size();
    groups = cut_groups(groups, weights_by_bin(ranks, groups, group_of, x, y, weight), cuts, child);
    for (std::size_t i = 0; i < n; ++i) {
      if (group_of[i] < 0) continue;
      auto const group = static_cast<std::size_t>(group_of[i]);
      Cut const& cut = cuts[first_cut + group];
      group_of[i] = child[group][(cut.upright ? x[i] : y[i]) < cut.at ? 0 : 1];
    }
  }
  return Decomposition(std::move(cuts));
}

Rectangle Decomposition::rectangle(int rank) const {
  Rectangle r;
  // From the cut that names the rank up to the first one.
  int wanted = -1 - rank;
  for (int at = static_cast<int>(cuts_.size()) - 1; at >= 0; --at) {
    Cut const& cut = cuts_[static_cast<std::size_t>(at)];
    if (cut.below != wanted && cut.above != wanted) continue;
    if (cut.below == wanted)
      (cut.upright ? r.right : r.top) = std::min(cut.upright ? r.right : r.top, cut.at);
    else
      (cut.upright ? r.left : r.bottom) = std::max(cut.upright ? r.left : r.bottom, cut.at);
    wanted = at;
  }
  return r;
}

void Decomposition::follow(AffineFrame const& f) {
  for (Cut& cut : cuts_) cut.at = cut.upright ? f.mapped_x(cut.at, f.reference_centre_y) : f.mapped_y(cut.at);
}

Decomposition::OwnerOf Decomposition::owner_of() const {
  OwnerOf owner{Field<Cut>("cuts", cuts_.size())};
  auto host = Kokkos::create_mirror_view(Kokkos::HostSpace(), owner.cuts);
  for (std::size_t k = 0; k < cuts_.size(); ++k) host(k) = cuts_[k];
  Kokkos::deep_copy(owner.cuts, host);
  return owner;
}

}  // namespace clathra
