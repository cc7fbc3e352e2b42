#include "domain/parallel/migration.hpp"

#include <algorithm>
#include <numeric>

namespace clathra {

namespace {

/// Lists the discs that leave with their new owners, and in their order those that stay.
struct PartDiscs {
  ParticleSoA p;
  Decomposition::OwnerOf owner_of;
  int rank;
  Field<int> leaving;  ///< [2 discs] index and new owner of each
  Field<int> staying;
  KOKKOS_FUNCTION void operator()(int i, int& left, bool const final) const {
    int const to = owner_of(p.x(i), p.y(i));
    if (to == rank) {
      if (final) staying(i - left) = i;
      return;
    }
    if (final) {
      leaving(2 * left) = i;
      leaving(2 * left + 1) = to;
    }
    ++left;
  }
};

struct NumberArrivals {
  Field<int> old_row;
  int first, first_row;
  KOKKOS_FUNCTION void operator()(int k) const { old_row(first + k) = first_row + k; }
};

void keep_only(Field<int> const& staying, ParticleSoA& particles, AuxiliaryFields const& auxiliary, Field<int>& old_row,
               Scratch& scratch) {
  permute(particles, staying, scratch);
  old_row = permuted(old_row, staying, staying.extent(0), scratch);
  for_each_auxiliary_field(auxiliary, [&](auto& field) { field = permuted(field, staying, particles.x.extent(0), scratch); });
}

/// The records of the leaving discs, by their new owners.
/// @param leaving  index and new owner of each
std::vector<std::vector<double>> pack_leaving(std::vector<int> const& leaving, int ranks, ParticleSoA const& particles,
                                              AuxiliaryFields const& auxiliary, OldRows const& old) {
  std::vector<std::vector<double>> to(static_cast<std::size_t>(ranks));
  if (leaving.empty()) return to;
  std::vector<std::size_t> order(leaving.size() / 2);
  std::iota(order.begin(), order.end(), std::size_t(0));
  auto const owner = [&](std::size_t k) { return leaving[2 * k + 1]; };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return owner(a) < owner(b); });
  std::vector<int> which;
  for (std::size_t const k : order) which.push_back(leaving[2 * k]);
  ContactRows rows = old.here;
  if (old.rows_here == 0)
    rows.length = Field<RowLength>("no_rows", static_cast<std::size_t>(particles.owned));  // before the first search
  DiscRecords const records = pack_discs(particles, auxiliary, rows, which);
  auto const at = [&](std::size_t k) { return records.numbers.begin() + static_cast<std::ptrdiff_t>(records.begin[k]); };
  for (std::size_t k = 0, end = 0; k < order.size(); k = end) {
    int const rank = owner(order[k]);
    while (end < order.size() && owner(order[end]) == rank) ++end;
    to[static_cast<std::size_t>(rank)].assign(at(k), at(end));
  }
  return to;
}

}  // namespace

void migrate(Ranks const& ranks, Decomposition const& decomposition, ParticleSoA& particles, AuxiliaryFields const& auxiliary,
             OldRows& old, Field<int>& old_row, Scratch& scratch) {
  auto const discs = static_cast<std::size_t>(particles.owned);
  PartDiscs const parts{particles, decomposition.owner_of(), ranks.rank(), scratch.take<int>("leaving", 2 * discs),
                        scratch.take<int>("staying", discs)};
  int left = 0;
  Kokkos::parallel_scan("part_discs", Kokkos::RangePolicy<ExecutionSpace>(0, particles.owned), parts, left);
  auto const leaving = static_cast<std::size_t>(left);
  std::vector<std::vector<double>> to =
      pack_leaving(on_host(parts.leaving, 2 * leaving), ranks.count(), particles, auxiliary, old);
  if (left > 0)
    keep_only(Kokkos::subview(parts.staying, std::pair<std::size_t, std::size_t>(0, discs - leaving)), particles, auxiliary,
              old_row, scratch);
  std::vector<double> came;
  for (std::vector<double> const& part : ranks.exchange(std::move(to))) came.insert(came.end(), part.begin(), part.end());
  int const first = particles.owned;
  old.arrived = unpack_discs(came, old.here.features, particles, auxiliary);
  if (particles.owned == first) return;
  Field<int> const all = scratch.take<int>("old_row", static_cast<std::size_t>(particles.owned));
  copy_first(old_row, all, static_cast<std::size_t>(first));
  old_row = all;
  Kokkos::parallel_for("number_arrivals", Kokkos::RangePolicy<ExecutionSpace>(0, particles.owned - first),
                       NumberArrivals{old_row, first, old.rows_here});
}

}  // namespace clathra
