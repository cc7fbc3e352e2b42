#include "domain/halo.hpp"

#include <type_traits>
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

struct PackColumn {
  Field<Real> from, numbers;
  Field<int> source;
  int column, columns;
  KOKKOS_FUNCTION void operator()(int k) const { numbers(k * columns + column) = from(source(k)); }
};

struct UnpackColumn {
  Field<Real> numbers, to;
  int first, column, columns;
  KOKKOS_FUNCTION void operator()(int k) const { to(first + k) = numbers(k * columns + column); }
};

struct CopyIds {
  Field<int> id;
  Field<Real> as_number;
  bool to_ids;
  KOKKOS_FUNCTION void operator()(int i) const {
    if (to_ids)
      id(i) = static_cast<int>(as_number(i));
    else
      as_number(i) = id(i);
  }
};

std::vector<Stretch> times(std::vector<Stretch> stretches, std::size_t columns) {
  for (Stretch& s : stretches) {
    s.begin *= columns;
    s.size *= columns;
  }
  return stretches;
}

std::size_t total(std::vector<Stretch> const& stretches) {
  return stretches.empty() ? 0 : stretches.back().begin + stretches.back().size;
}

/// The stretches of a buffer that holds sizes[r] numbers for each rank r.
std::vector<Stretch> stretches_of(std::vector<std::size_t> const& sizes) {
  std::vector<Stretch> stretches;
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
  for (Stretch const& s : sent_) {
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
  Field<Real> const id = uninitialised<Real>("id_as_number", particles.x.extent(0));
  Kokkos::RangePolicy<ExecutionSpace> const all(0, particles.all());
  Kokkos::parallel_for("ids_to_numbers", all, CopyIds{particles.id, id, false});
  std::vector<Field<Real>> columns{id};
  for_each_field(particles, [&](char const*, auto const& field) {
    if constexpr (!std::is_same_v<typename std::decay_t<decltype(field)>::value_type, int>) columns.push_back(field);
  });
  trade(ranks, particles, columns);
  Kokkos::parallel_for("numbers_to_ids", all, CopyIds{particles.id, id, true});
}

void Halo::refresh(Ranks const& ranks, ParticleSoA const& particles) const {
  trade(ranks, particles, {particles.x, particles.y, particles.vx, particles.vy, particles.omega});
}

void Halo::refresh(Ranks const& ranks, ParticleSoA const& particles, Field<Real> const& field) const {
  trade(ranks, particles, {field});
}

void Halo::trade(Ranks const& ranks, ParticleSoA const& particles, std::vector<Field<Real>> const& columns) const {
  auto const width = static_cast<int>(columns.size());
  Field<Real> const out = uninitialised<Real>("halo.out", source_.extent(0) * columns.size()),
                    in = uninitialised<Real>("halo.in", static_cast<std::size_t>(particles.ghosts) * columns.size());
  Kokkos::RangePolicy<ExecutionSpace> const each_sent(0, static_cast<int>(source_.extent(0))), each_ghost(0, particles.ghosts);
  for (int c = 0; c < width; ++c)
    Kokkos::parallel_for("pack_halo", each_sent, PackColumn{columns[static_cast<std::size_t>(c)], out, source_, c, width});
  auto const host_out = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), out);
  auto host_in = Kokkos::create_mirror_view(in);
  Kokkos::fence();
  Kokkos::Profiling::pushRegion("halo_trade");
  ranks.trade(host_out.data(), times(sent_, columns.size()), host_in.data(), times(received_, columns.size()));
  Kokkos::Profiling::popRegion();
  Kokkos::deep_copy(in, host_in);
  for (int c = 0; c < width; ++c)
    Kokkos::parallel_for("unpack_halo", each_ghost,
                         UnpackColumn{in, columns[static_cast<std::size_t>(c)], particles.owned, c, width});
}

std::size_t Halo::bytes() const {
  return source_.span() * sizeof(int) + (source_.extent(0) + total(received_)) * 5 * sizeof(Real);
}

}  // namespace clathra
