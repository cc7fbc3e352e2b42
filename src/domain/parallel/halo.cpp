#include "domain/parallel/halo.hpp"

#include <utility>

namespace clathra {

namespace {

/// Appends the discs that lie within reach of a rectangle to a list, as far as there is room.
struct ListNear {
  ParticleSoA p;
  Rectangle r;
  Real reach;
  Field<int> list;
  Field<std::int64_t> end;  ///< where the discs for each rank end
  int which;
  KOKKOS_FUNCTION void operator()(int i, std::int64_t& place, bool const final) const {
    std::int64_t const begin = which > 0 ? end(which - 1) : 0;
    if (i == p.owned) {
      if (final) end(which) = begin + place;
      return;
    }
    Coord const x = p.x(i), y = p.y(i);
    if (x < r.left - reach || x >= r.right + reach || y < r.bottom - reach || y >= r.top + reach) return;
    if (final && begin + place < static_cast<std::int64_t>(list.extent(0))) list(begin + place) = i;
    ++place;
  }
};

/// The state of a disc, or what changes of it in each step, as numbers: doubles hold every value of every kind of field.
struct StateColumns {
  ParticleSoA p;
  bool all;
  KOKKOS_INLINE_FUNCTION int count() const {
    int columns = 0;
    for_each_field(p, [&](DiscField const& about, auto const&) { columns += all || about.moves ? 1 : 0; });
    return columns;
  }
  KOKKOS_INLINE_FUNCTION void write(int disc, double* to) const {
    for_each_field(p, [&](DiscField const& about, auto const& field) {
      if (all || about.moves) *to++ = field(disc);
    });
  }
  KOKKOS_INLINE_FUNCTION void read(int disc, double const* from) const {
    for_each_field(p, [&](DiscField const& about, auto const& field) {
      if (all || about.moves) set(field, static_cast<std::size_t>(disc), *from++);
    });
  }
};
template <class AField>
struct OneColumn {
  AField field;
  KOKKOS_INLINE_FUNCTION int count() const { return 1; }
  KOKKOS_INLINE_FUNCTION void write(int disc, double* to) const { *to = field(disc); }
  KOKKOS_INLINE_FUNCTION void read(int disc, double const* from) const { set(field, static_cast<std::size_t>(disc), *from); }
};

template <class Columns>
struct PackHalo {
  Columns columns;
  Field<int> source;
  Field<double> numbers;
  int width;
  KOKKOS_FUNCTION void operator()(int k) const { columns.write(source(k), &numbers(k * width)); }
};
template <class Columns>
struct UnpackHalo {
  Columns columns;
  Field<double> numbers;
  int first, width;
  KOKKOS_FUNCTION void operator()(int k) const { columns.read(first + k, &numbers(k * width)); }
};

std::vector<BufferRange> times(std::vector<BufferRange> stretches, std::size_t columns) {
  for (BufferRange& s : stretches) {
    s.begin *= columns;
    s.size *= columns;
  }
  return stretches;
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

/// The discs that go to other ranks, listed by rank. Few ranks are near, and as a rule there is room for them: the host then
/// waits once.
void Halo::list_sent(Ranks const& ranks, Decomposition const& decomposition, ParticleSoA const& particles, Real reach) {
  Rectangle const own = decomposition.rectangle(ranks.rank());
  std::vector<int> near;
  for (int r = 0; r < ranks.count(); ++r) {
    Rectangle const other = decomposition.rectangle(r);
    bool const apart = other.left - reach > own.right || own.left > other.right + reach || other.bottom - reach > own.top ||
                       own.bottom > other.top + reach;
    if (r != ranks.rank() && !apart) near.push_back(r);
  }
  if (listed_.extent(0) < near.size()) listed_ = uninitialised<std::int64_t>("halo.listed", near.size());
  std::vector<std::size_t> sizes(static_cast<std::size_t>(ranks.count()), 0);
  for (std::size_t wanted = source_.extent(0);;) {
    if (source_.extent(0) < wanted) source_ = uninitialised<int>("halo.source", wanted + wanted / 8);
    for (std::size_t n = 0; n < near.size(); ++n)
      Kokkos::parallel_scan("list_near", Kokkos::RangePolicy<ExecutionSpace>(0, particles.owned + 1),
                            ListNear{particles, decomposition.rectangle(near[n]), reach, source_, listed_, static_cast<int>(n)});
    auto const end = host_copy(listed_);
    std::int64_t begin = 0;
    for (std::size_t n = 0; n < near.size(); begin = end(n++))
      sizes[static_cast<std::size_t>(near[n])] = static_cast<std::size_t>(end(n) - begin);
    wanted = static_cast<std::size_t>(begin);
    if (source_.extent(0) >= wanted) break;
  }
  sent_ = stretches_of(sizes);
}

void Halo::rebuild(Ranks const& ranks, Decomposition const& decomposition, ParticleSoA& particles, Real reach) {
  particles.ghosts = 0;
  list_sent(ranks, decomposition, particles, reach);
  auto const count = static_cast<std::size_t>(ranks.count());
  std::vector<std::vector<double>> to(count);
  for (BufferRange const& s : sent_) to[static_cast<std::size_t>(s.rank)] = {static_cast<double>(s.size)};
  auto const from = ranks.exchange(std::move(to));
  std::vector<std::size_t> sizes(count, 0);
  for (std::size_t r = 0; r < count; ++r) sizes[r] = from[r].empty() ? 0 : static_cast<std::size_t>(from[r][0]);
  received_ = stretches_of(sizes);
  auto const ghosts = static_cast<int>(total(received_));
  reserve(particles, particles.owned + ghosts);
  particles.ghosts = ghosts;
  fill_padding(particles);
  exchange(ranks, particles, StateColumns{particles, true});
  update_mirror(particles, particles.owned, particles.ghosts);
}

void Halo::refresh(Ranks const& ranks, ParticleSoA const& particles) const {
  exchange(ranks, particles, StateColumns{particles, false});
  update_mirror(particles, particles.owned, particles.ghosts);
}

void Halo::refresh(Ranks const& ranks, ParticleSoA const& particles, AnyField const& field) const {
  std::visit([&]<class AField>(AField const& values) { exchange(ranks, particles, OneColumn<AField>{values}); }, field);
}

template <class Columns>
void Halo::exchange(Ranks const& ranks, ParticleSoA const& particles, Columns const& columns) const {
  int const width = columns.count();
  auto const numbers = static_cast<std::size_t>(width);
  std::size_t const sent = total(sent_), received = total(received_);
  out_.reserve(sent * numbers);
  in_.reserve(received * numbers);
  Kokkos::parallel_for("pack_halo", Kokkos::RangePolicy<ExecutionSpace>(0, static_cast<int>(sent)),
                       PackHalo<Columns>{columns, source_, out_.numbers(), width});
  out_.finish(sent * numbers);
  Kokkos::Profiling::pushRegion("halo_trade");
  ranks.exchange_known(out_.message(), times(sent_, numbers), in_.message(), times(received_, numbers));
  Kokkos::Profiling::popRegion();
  in_.take(received * numbers);
  Kokkos::parallel_for("unpack_halo", Kokkos::RangePolicy<ExecutionSpace>(0, particles.ghosts),
                       UnpackHalo<Columns>{columns, in_.numbers(), particles.owned, width});
}

}  // namespace clathra
