#include "domain/parallel/migration.hpp"

namespace clathra {

namespace {

struct FindOwners {
  ParticleSoA p;
  Decomposition::OwnerOf owner_of;
  Field<int> owner;
  KOKKOS_FUNCTION void operator()(int i) const { owner(i) = owner_of(p.x(i), p.y(i)); }
};

struct NumberArrivals {
  Field<int> slot;
  int first, first_slot;
  KOKKOS_FUNCTION void operator()(int k) const { slot(first + k) = first_slot + k; }
};

std::vector<int> owners(Decomposition const& decomposition, ParticleSoA const& particles) {
  auto const n = static_cast<std::size_t>(particles.owned);
  Field<int> const owner = uninitialised<int>("owner", n);
  Kokkos::parallel_for("find_owners", Kokkos::RangePolicy<ExecutionSpace>(0, particles.owned),
                       FindOwners{particles, decomposition.owner_of(), owner});
  auto const host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), owner);
  return {host.data(), host.data() + n};
}

/// Drops the discs that left: their rows stay in `old`, where no slot names them any more.
void keep_only(std::vector<int> const& staying, ParticleSoA& particles, AuxiliaryFields const& auxiliary, Field<int>& slot) {
  Field<int> const order = uninitialised<int>("staying", staying.size());
  auto host = Kokkos::create_mirror_view(Kokkos::HostSpace(), order);
  for (std::size_t k = 0; k < staying.size(); ++k) host(k) = staying[k];
  Kokkos::deep_copy(order, host);
  permute(particles, order);
  slot = permuted(slot, order, staying.size());
  for_each_auxiliary_field(auxiliary, [&](auto& field) { field = permuted(field, order, particles.x.extent(0)); });
}

}  // namespace

void migrate(Ranks const& ranks, Decomposition const& decomposition, ParticleSoA& particles, AuxiliaryFields const& auxiliary,
             OldRows& old, Field<int>& slot) {
  std::vector<int> const owner = owners(decomposition, particles);
  std::vector<std::vector<int>> leaving(static_cast<std::size_t>(ranks.count()));
  std::vector<int> staying;
  for (int i = 0; i < particles.owned; ++i) {
    int const to = owner[static_cast<std::size_t>(i)];
    (to == ranks.rank() ? staying : leaving[static_cast<std::size_t>(to)]).push_back(i);
  }
  std::vector<std::vector<double>> to(leaving.size());
  bool const rows_known = old.slots_here > 0;
  ContactRows unknown;  // before the first search no disc has a row
  if (!rows_known) {
    unknown.features = old.here.features;
    unknown.length = Field<RowLength>("no_rows", static_cast<std::size_t>(particles.owned));
  }
  for (std::size_t r = 0; r < leaving.size(); ++r) {
    if (!leaving[r].empty()) to[r] = pack_discs(particles, auxiliary, rows_known ? old.here : unknown, leaving[r]).numbers;
  }
  if (static_cast<int>(staying.size()) < particles.owned) keep_only(staying, particles, auxiliary, slot);
  std::vector<double> came;
  for (std::vector<double> const& part : ranks.exchange(std::move(to))) came.insert(came.end(), part.begin(), part.end());
  int const first = particles.owned;
  old.arrived = unpack_discs(came, old.here.features, particles, auxiliary);
  Kokkos::resize(slot, static_cast<std::size_t>(particles.owned));
  Kokkos::parallel_for("number_arrivals", Kokkos::RangePolicy<ExecutionSpace>(0, particles.owned - first),
                       NumberArrivals{slot, first, old.slots_here});
}

}  // namespace clathra
