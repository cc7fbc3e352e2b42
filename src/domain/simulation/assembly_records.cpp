#include "domain/simulation/assembly_records.hpp"

#include <functional>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "domain/parallel/id_index.hpp"
#include "domain/simulation/neighbour_search.hpp"

namespace clathra {

namespace {

/// What is derived from the state but must not be derived anew: forces, and where the last search found the discs.
AuxiliaryFields derived_fields(Assembly& a) {
  AuxiliaryFields all;
  for_each_derived_field(a.particles, [&](DiscField const& about, auto& field) { all.push_back({about.name, &field}); });
  return all;
}

/// The records of the discs that belong to this rank, from wherever they were read.
std::vector<double> records_of_own_discs(Assembly& a, DiscRecords discs) {
  Ranks const& ranks = a.ranks();
  if (ranks.alone()) return std::move(discs.numbers);
  // Behind the id come x and y.
  std::vector<double> x, y;
  for (std::size_t k = 0; k < discs.size(); ++k) {
    x.push_back(discs.numbers[discs.begin[k] + 1]);
    y.push_back(discs.numbers[discs.begin[k] + 2]);
  }
  a.ghosts.set_decomposition(Decomposition::bisect(ranks, x, y, 1));
  std::vector<std::size_t> owner, room(static_cast<std::size_t>(ranks.count()));
  for (std::size_t k = 0; k < discs.size(); ++k) {
    owner.push_back(static_cast<std::size_t>(a.ghosts.decomposition().owner(x[k], y[k])));
    room[owner[k]] += discs.begin[k + 1] - discs.begin[k];
  }
  std::vector<std::vector<double>> to(room.size());
  for (std::size_t r = 0; r < room.size(); ++r) to[r].reserve(room[r]);
  for (std::size_t k = 0; k < discs.size(); ++k) {
    auto& part = to[owner[k]];
    part.insert(part.end(), discs.numbers.begin() + static_cast<std::ptrdiff_t>(discs.begin[k]),
                discs.numbers.begin() + static_cast<std::ptrdiff_t>(discs.begin[k + 1]));
  }
  discs = {};
  std::vector<std::vector<double>> came = ranks.exchange(std::move(to));
  std::vector<double> home;
  home.reserve(
      std::transform_reduce(came.begin(), came.end(), std::size_t{0}, std::plus(), [](auto const& part) { return part.size(); }));
  for (auto& part : came) {
    home.insert(home.end(), part.begin(), part.end());
    part = {};
  }
  return home;
}

/// Replaces the neighbours' ids in the rows by the indices of discs and ghosts.
void find_listed_neighbours(Assembly& a) {
  auto const id = host_copy(a.particles.id);
  auto const length = host_copy(a.rows.length);
  auto const slice_start = host_copy(a.rows.slice_start);
  auto const listed = host_copy(a.rows.neighbour);
  std::vector<int> index(listed.extent(0), a.particles.padding());
  IdIndex const places(id, a.particles.all());
  bool lost = false;
  for (int i = 0; i < a.particles.owned; ++i) {
    for (int k = 0; k < length(i); ++k) {
      std::size_t const e = entry_in(slice_start, a.rows.features.format, i, k);
      index[e] = places.find(listed(e));
      lost = lost || index[e] < 0;
    }
  }
  if (a.ranks().any(lost)) throw std::runtime_error("a checkpoint's row names a neighbour that is not near");
  a.rows.neighbour = uninitialised<int>("rows.neighbour", index.size());
  auto host = Kokkos::create_mirror_view(Kokkos::HostSpace(), a.rows.neighbour);
  std::copy(index.begin(), index.end(), host.data());
  Kokkos::deep_copy(a.rows.neighbour, host);
}

}  // namespace

void pack_assembly(Assembly& a, AuxiliaryFields const& beside, SimulationState& s) {
  s.numbers["marked_start"] = a.start_x.extent(0) > 0 ? 1 : 0;
  std::vector<BoundaryHistory> histories = boundary_histories(a);
  AuxiliaryFields const with_discs = with(with(auxiliary_fields(a, histories), beside), derived_fields(a));
  s.discs = disc_columns(a.particles, with_discs, a.rows);
  a.broken.collect();
  a.broken.write(s, a.ranks());
}

void unpack_assembly(Assembly& a, AuxiliaryFields const& beside, SimulationState& state) {
  a.set_sums();
  a.rows.features = a.laws.features_of_rows();
  a.particles = allocate_particles(0, a.laws.precision, a.facts.largest_radius);
  if (a.laws.contact.ledger) allocate_dissipation(a.dissipation, a.laws.losses(), 1);
  if (state.numbers.at("marked_start") != 0) a.mark_start();
  std::vector<BoundaryHistory> histories = boundary_histories(a);
  AuxiliaryFields const with_discs = with(with(auxiliary_fields(a, histories), beside), derived_fields(a));
  if (record_columns(with_discs, a.rows.features) != state.discs.names())
    throw std::runtime_error("a checkpoint's particles have other numbers than its laws ask for");
  a.rows = unpack_discs(records_of_own_discs(a, records_of(std::move(state.discs))), a.rows.features, a.particles, with_discs);
  // Discs have moved since the rows were listed: neighbours may be farther than the search reached, by both their skins.
  Real const reach = a.upkeep.reach();
  a.ghosts.rebuild(a.particles, a.now.box(), reach + 2 * (reach - 2 * a.facts.largest_radius));
  find_listed_neighbours(a);
  prepare_rows(a.particles, a.rows, a.laws.contact.bond);
  a.make_room_for_breaks();
  for (std::size_t b = 0; b < a.boundaries.size(); ++b) {
    Field<std::int64_t> const number = a.scratch.take<std::int64_t>("near_boundary", 1);
    a.boundaries[b]->list_near(a.particles, a.now, number, a.scratch);
    a.boundaries[b]->make_contacts(static_cast<int>(host_copy(number)(0)), a.laws, histories[b], a.scratch);
  }
  a.broken.read(state, a.ranks());
}

}  // namespace clathra
