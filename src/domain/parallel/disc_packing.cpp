#include "domain/parallel/disc_packing.hpp"

#include <algorithm>
#include <type_traits>

namespace clathra {

namespace {

using Offsets = Field<std::int64_t>;

struct RowLengths {
  Field<int> which, length;
  Field<RowLength> row_length;
  KOKKOS_FUNCTION void operator()(int k) const { length(k) = row_length(which(k)); }
};

/// A vector as a field on the host, without a copy.
template <class Vector>
auto on_host_view(Vector& numbers) {
  using Number = std::remove_pointer_t<decltype(numbers.data())>;
  return Kokkos::View<Number*, Kokkos::HostSpace, Kokkos::MemoryTraits<Kokkos::Unmanaged>>(numbers.data(), numbers.size());
}

/// Writes records but for the auxiliary fields, for which it leaves room.
template <class Numbers>
struct Pack {
  Field<int> which;
  ParticleSoA p;
  ContactRows rows;
  int auxiliary;
  Offsets begin;
  Numbers numbers;

  KOKKOS_FUNCTION void operator()(int k) const {
    int const i = which(k), length = rows.length(i);
    auto at = begin(k);
    for_each_field(p, [&](DiscField const&, auto const& field) { numbers(at++) = field(i); });
    at += auxiliary;
    numbers(at++) = length;
    for (int n = 0; n < length; ++n) {
      std::size_t const e = rows.entry(i, n);
      numbers(at++) = rows.neighbour(e);
      for_each_history(rows, [&](HistoryField const&, auto const& field) { numbers(at++) = field(e); });
    }
  }
};

template <class Numbers>
struct Unpack {
  Numbers numbers;
  Offsets begin;
  int first;  // where the new discs go
  ParticleSoA p;
  ContactRows rows;
  int auxiliary;

  KOKKOS_FUNCTION void operator()(int k) const {
    auto at = begin(k);
    for_each_field(
        p, [&, i = static_cast<std::size_t>(first + k)](DiscField const&, auto const& field) { set(field, i, numbers(at++)); });
    at += auxiliary;
    auto const length = static_cast<int>(numbers(at++));
    rows.length(k) = static_cast<RowLength>(length);
    for (int n = 0; n < length; ++n) {
      std::size_t const e = rows.entry(k, n);
      rows.neighbour(e) = static_cast<int>(numbers(at++));
      for_each_history(rows, [&](HistoryField const&, RealField const& field) { field.set(e, numbers(at++)); });
    }
  }
};

/// One auxiliary field of all discs, to or from its place `offset` behind the beginning of their records.
template <class AField, class Numbers>
struct PackCompanion {
  Field<int> which;
  AField field;
  Offsets begin;
  int offset;
  Numbers numbers;
  KOKKOS_FUNCTION void operator()(int k) const { numbers(begin(k) + offset) = field(which(k)); }
};
template <class AField, class Numbers>
struct UnpackCompanion {
  Numbers numbers;
  Offsets begin;
  int offset, first;
  AField field;
  KOKKOS_FUNCTION void operator()(int k) const { set(field, static_cast<std::size_t>(first + k), numbers(begin(k) + offset)); }
};

template <class T>
Field<T> on_device(char const* label, std::vector<T> const& values) {
  Field<T> const field = uninitialised<T>(label, values.size());
  auto host = Kokkos::create_mirror_view(Kokkos::HostSpace(), field);
  std::copy(values.begin(), values.end(), host.data());
  Kokkos::deep_copy(field, host);
  return field;
}

/// The entries of all rows, one row behind the other.
template <class AField, class Number>
struct NumbersOfEntries {
  ContactRows rows;
  Offsets begin;
  AField field;
  Field<Number> numbers;
  KOKKOS_FUNCTION void operator()(int i) const {
    for (int k = 0; k < rows.length(i); ++k) numbers(begin(i) + k) = static_cast<Number>(field(rows.entry(i, k)));
  }
};

template <class Number, class AField>
std::vector<Number> numbers_of_entries(ContactRows const& rows, AField const& field, int discs) {
  std::vector<std::int64_t> begin{0};
  for (RowLength const length : on_host(rows.length, static_cast<std::size_t>(discs))) begin.push_back(begin.back() + length);
  Field<Number> const numbers = uninitialised<Number>("column", static_cast<std::size_t>(begin.back()));
  Kokkos::parallel_for("column_of_entries", Kokkos::RangePolicy<ExecutionSpace>(0, discs),
                       NumbersOfEntries<AField, Number>{rows, on_device("column_offsets", begin), field, numbers});
  return on_host(numbers, numbers.extent(0));
}

/// [entries] the ids of the neighbours.
Field<int> ids_of_neighbours(ParticleSoA const& particles, ContactRows rows) {
  Field<int> const neighbour = uninitialised<int>("named", rows.neighbour.extent(0));
  Kokkos::deep_copy(neighbour, rows.neighbour);
  rows.neighbour = neighbour;
  name_neighbours(particles, rows);
  return neighbour;
}

/// How many numbers a record has for the state of its disc, the id among them.
int state_columns(Precision precision) {
  ParticleSoA none;
  none.precision = precision;
  int count = 0;
  for_each_field(none, [&](DiscField const&, auto const&) { ++count; });
  return count;
}

int history_columns(ContactFeatures const& features) {
  ContactRows none;
  none.features = features;
  int count = 0;
  for_each_history(none, [&](HistoryField const&, auto const&) { ++count; });
  return count;
}

std::vector<std::int64_t> signed_offsets(std::vector<std::size_t> const& begin) { return {begin.begin(), begin.end()}; }

}  // namespace

RecordColumns record_columns(AuxiliaryFields const& auxiliary, ContactFeatures const& features) {
  RecordColumns columns;
  ParticleSoA none;
  none.precision = features.format.precision;
  for_each_field(none, [&](DiscField const& about, auto const&) { columns.discs.emplace_back(about.name); });
  columns.discs.erase(columns.discs.begin());  // the id stands for itself
  for (AuxiliaryField const& field : auxiliary) columns.discs.emplace_back(field.name);
  ContactRows rows;
  rows.features = features;
  for_each_history(rows, [&](HistoryField const& about, auto const&) { columns.history.emplace_back(about.name); });
  return columns;
}

DiscRecords pack_discs(ParticleSoA const& particles, AuxiliaryFields const& auxiliary, ContactRows const& rows,
                       std::vector<int> const& which) {
  auto const others = static_cast<int>(auxiliary.size());
  int const state = state_columns(particles.precision), entry = 1 + history_columns(rows.features);
  auto const n = static_cast<int>(which.size());
  Field<int> const indices = on_device("packed", which), length = uninitialised<int>("packed_lengths", which.size());
  Kokkos::RangePolicy<ExecutionSpace> const each(0, n);
  Kokkos::parallel_for("row_lengths", each, RowLengths{indices, length, rows.length});
  DiscRecords records;
  records.begin.reserve(which.size() + 1);
  for (int const entries : on_host(length, length.extent(0))) {
    records.begin.push_back(records.begin.back() + static_cast<std::size_t>(state + others + 1 + entries * entry));
  }
  records.numbers.resize(records.begin.back());
  auto const home = on_host_view(records.numbers);
  auto const numbers = Kokkos::create_mirror_view(MemorySpace(), home);  // itself where kernels reach the host
  using Numbers = std::remove_const_t<decltype(numbers)>;
  Offsets const begin = on_device("record_offsets", signed_offsets(records.begin));
  Kokkos::parallel_for("pack_discs", each, Pack<Numbers>{indices, particles, rows, others, begin, numbers});
  int offset = state;
  for_each_auxiliary_field(auxiliary, [&]<class AField>(AField const& field) {
    Kokkos::parallel_for("pack_companion", each, PackCompanion<AField, Numbers>{indices, field, begin, offset++, numbers});
  });
  Kokkos::fence();
  Kokkos::deep_copy(home, numbers);
  return records;
}

DiscColumns disc_columns(ParticleSoA const& particles, AuxiliaryFields const& auxiliary, ContactRows const& rows) {
  int const owned = particles.owned;
  auto const size = static_cast<std::size_t>(owned);
  auto const column = [size](char const* name, auto const& field) {
    return DiscColumns::Column{name, [field, size] { return numbers_on_host(field, size); }};
  };
  DiscColumns columns;
  columns.id = [id = particles.id, size] { return on_host(id, size); };
  for_each_field(particles,
                 [&](DiscField const& about, auto const& field) { columns.discs.push_back(column(about.name, field)); });
  columns.discs.erase(columns.discs.begin());  // the id stands for itself
  for (AuxiliaryField const& one : auxiliary)
    std::visit([&](auto* field) { columns.discs.push_back(column(one.name, *field)); }, one.field);
  columns.row_length = [length = rows.length, size] {
    auto const lengths = on_host(length, size);
    return std::vector<std::int32_t>(lengths.begin(), lengths.end());
  };
  columns.neighbour = [particles, rows, owned] {
    return numbers_of_entries<std::int32_t>(rows, ids_of_neighbours(particles, rows), owned);
  };
  for_each_history(rows, [&](HistoryField const& about, RealField const& field) {
    columns.history.push_back({about.name, [rows, field, owned] { return numbers_of_entries<double>(rows, field, owned); }});
  });
  return columns;
}

ContactRows unpack_discs(std::vector<double> const& numbers, ContactFeatures const& features, ParticleSoA& particles,
                         AuxiliaryFields const& auxiliary) {
  ContactRows rows;
  rows.features = features;
  auto const others = static_cast<int>(auxiliary.size());
  int const state = state_columns(particles.precision), columns = state + others, histories = history_columns(features);
  std::vector<std::int64_t> begin;
  auto const slice_width = static_cast<std::size_t>(features.format.slice_width());
  std::vector<int> slice_start{0};
  int widest = 0;
  for (std::size_t at = 0; at < numbers.size();) {
    begin.push_back(static_cast<std::int64_t>(at));
    auto const length = static_cast<int>(numbers[at + static_cast<std::size_t>(columns)]);
    at += static_cast<std::size_t>(columns + 1 + length * (1 + histories));
    widest = std::max(widest, length);
    if (begin.size() % slice_width != 0 && at < numbers.size()) continue;
    require_countable((std::int64_t{slice_start.back()} + widest) * static_cast<std::int64_t>(slice_width), 0);
    slice_start.push_back(slice_start.back() + widest);
    widest = 0;
  }
  int const first = particles.owned, came = static_cast<int>(begin.size());
  reserve(particles, first + came);
  particles.owned = first + came;
  particles.ghosts = 0;
  for_each_auxiliary_field(auxiliary, [&](auto& field) { resize(field, particles.x.extent(0)); });
  fill_padding(particles);
  rows.slice_start = on_device("rows.slice_start", slice_start);
  rows.length = uninitialised<RowLength>("rows.length", begin.size());
  rows.neighbour = uninitialised<int>("rows.neighbour", static_cast<std::size_t>(slice_start.back()) * slice_width);
  allocate_history(rows, rows.neighbour.extent(0));
  auto const reached = Kokkos::create_mirror_view_and_copy(ExecutionSpace::memory_space(), on_host_view(numbers));
  using Numbers = std::remove_const_t<decltype(reached)>;
  Offsets const offsets = on_device("record_offsets", begin);
  Kokkos::RangePolicy<ExecutionSpace> const each(0, came);
  Kokkos::parallel_for("unpack_discs", each, Unpack<Numbers>{reached, offsets, first, particles, rows, others});
  int offset = state;
  for_each_auxiliary_field(auxiliary, [&]<class AField>(AField const& field) {
    Kokkos::parallel_for("unpack_companion", each, UnpackCompanion<AField, Numbers>{reached, offsets, offset++, first, field});
  });
  update_mirror(particles, first, came);
  Kokkos::fence();  // the numbers are the caller's
  return rows;
}

}  // namespace clathra
