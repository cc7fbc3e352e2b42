#include "domain/parallel/halo.hpp"

#include <utility>

namespace clathra {

namespace {

/// Lists the discs that lie within reach of a rectangle.
struct ListNear {
  ParticleSoA p;
  Rectangle r;
  Real reach;
  Field<int> near;
  KOKKOS_FUNCTION void operator()(int i, int& slot, bool const final) const {
    Coord const x = p.x(i), y = p.y(i);
    if (x < r.left - reach || x >= r.right + reach || y < r.bottom - reach || y >= r.top + reach) return;
    if (final) near(slot) = i;
    ++slot;
  }
};

template <class AField>
struct PackColumn {
  AField from;
  Field<double> numbers;
  Field<int> source;
  int column, columns;
  KOKKOS_FUNCTION void operator()(int k) const { numbers(k * columns + column) = from(source(k)); }
};

template <class AField>
struct UnpackColumn {
  Field<double> numbers;
  AField to;
  int first, column, columns;
  KOKKOS_FUNCTION void operator()(int k) const { set(to, static_cast<std::size_t>(first + k), numbers(k * columns + column)); }
};

std::vector<BufferRange> times(std::vector<BufferRange> stretches, std::size_t columns) {
  for (BufferRange& s : stretches) {
    s.begin *= columns;
    s.size *= columns;
  }
  return stretches;
}

std::size_t total(std::vector<BufferRange> const& stretches) {
  return stretches.empty() ? 0 : stretches.back().begin + stretches.back().size;
}

/// The stretches of a buffer that holds sizes[r] numbers for each rank r.
std::vector<BufferRange> stretches_of(std::vector<std::size_t> const& sizes) {
  std::vector<BufferRange> stretches;
  std::size_t begin = 0;
  for (std::size_t r = 0; r < sizes.size(); ++r) {
    if (sizes[r] > 0) stretches.push_back({static_cast<int>(r), begin, sizes[r]});
    begin += sizes[r];
  }
  return stretches;
}

}  // namespace

void Halo::rebuild(Ranks const& ranks, Decomposition const& decomposition, ParticleSoA& particles, Real reach) {
  auto const count = static_cast<std::size_t>(ranks.count());
  std::vector<Field<int>> near(count);
  std::vector<std::size_t> sizes(count, 0);
  std::vector<std::vector<double>> to(count);
  particles.ghosts = 0;
  for (int r = 0; r < ranks.count(); ++r) {
    if (r == ranks.rank()) continue;
    auto const at = static_cast<std::size_t>(r);
    near[at] = uninitialised<int>("near", static_cast<std::size_t>(particles.owned));
    int found = 0;
    Kokkos::parallel_scan("list_near", Kokkos::RangePolicy<ExecutionSpace>(0, particles.owned),
                          ListNear{particles, decomposition.rectangle(r), reach, near[at]}, found);
    sizes[at] = static_cast<std::size_t>(found);
    to[at] = {static_cast<double>(found)};
  }
  sent_ = stretches_of(sizes);
  source_ = uninitialised<int>("halo.source", total(sent_));
  for (BufferRange const& s : sent_) {
    Kokkos::deep_copy(Kokkos::subview(source_, std::pair(s.begin, s.begin + s.size)),
                      Kokkos::subview(near[static_cast<std::size_t>(s.rank)], std::pair<std::size_t, std::size_t>(0, s.size)));
  }
  auto const from = ranks.exchange(std::move(to));
  for (std::size_t r = 0; r < count; ++r) sizes[r] = from[r].empty() ? 0 : static_cast<std::size_t>(from[r][0]);
  received_ = stretches_of(sizes);
  auto const ghosts = static_cast<int>(total(received_));
  reserve(particles, particles.owned + ghosts);
  particles.ghosts = ghosts;
  fill_padding(particles);
  std::vector<AnyField> all;
  for_each_field(particles, [&](DiscField const&, auto const& field) { all.push_back(field); });
  exchange_known(ranks, particles, all);
  update_mirror(particles, particles.owned, particles.ghosts);
}

void Halo::refresh(Ranks const& ranks, ParticleSoA const& particles) const {
  std::vector<AnyField> moving;
  for_each_field(particles, [&](DiscField const& about, auto const& field) {
    if (about.moves) moving.push_back(field);
  });
  exchange_known(ranks, particles, moving);
  update_mirror(particles, particles.owned, particles.ghosts);
}

void Halo::refresh(Ranks const& ranks, ParticleSoA const& particles, AnyField const& field) const {
  exchange_known(ranks, particles, {field});
}

/// Doubles hold every value of every kind of field.
void Halo::exchange_known(Ranks const& ranks, ParticleSoA const& particles, std::vector<AnyField> const& columns) const {
  auto const width = static_cast<int>(columns.size());
  Field<double> const out = uninitialised<double>("halo.out", source_.extent(0) * columns.size()),
                      in = uninitialised<double>("halo.in", static_cast<std::size_t>(particles.ghosts) * columns.size());
  Kokkos::RangePolicy<ExecutionSpace> const each_sent(0, static_cast<int>(source_.extent(0))), each_ghost(0, particles.ghosts);
  int at = 0;
  auto const pack = [&]<class AField>(AField const& field) {
    Kokkos::parallel_for("pack_halo", each_sent, PackColumn<AField>{field, out, source_, at++, width});
  };
  for (AnyField const& column : columns) std::visit(pack, column);
  auto const host_out = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), out);
  auto host_in = Kokkos::create_mirror_view(Kokkos::HostSpace(), in);
  Kokkos::fence();
  Kokkos::Profiling::pushRegion("halo_trade");
  ranks.exchange_known(host_out.data(), times(sent_, columns.size()), host_in.data(), times(received_, columns.size()));
  Kokkos::Profiling::popRegion();
  Kokkos::deep_copy(in, host_in);
  at = 0;
  auto const unpack = [&]<class AField>(AField const& field) {
    Kokkos::parallel_for("unpack_halo", each_ghost, UnpackColumn<AField>{in, field, particles.owned, at++, width});
  };
  for (AnyField const& column : columns) std::visit(unpack, column);
}

std::size_t Halo::bytes() const {
  std::size_t moving = 0;
  for_each_field(ParticleSoA(), [&](DiscField const& about, auto const&) { moving += about.moves ? 1 : 0; });
  return source_.span() * sizeof(int) + (source_.extent(0) + total(received_)) * moving * sizeof(double);
}

}  // namespace clathra
