#include "kernels/contacts.hpp"

#include <type_traits>

namespace clathra {

void allocate_history(ContactRows& rows, std::size_t entries) {
  for_each_history(rows, [&](HistoryField const& about, auto& field) {
    using T = typename std::decay_t<decltype(field)>::value_type;
    field = uninitialised<T>(about.name, entries);
    Kokkos::deep_copy(field, static_cast<T>(about.empty));
  });
}

void change_features(ContactRows& rows, ContactFeatures features) {
  ContactRows changed = rows;
  changed.features = features;
  auto const change = [&](HistoryField const& about, bool needed, auto& field) {
    using T = typename std::decay_t<decltype(field)>::value_type;
    if (needed && field.extent(0) > 0) return;  // what both have is kept
    field = needed ? uninitialised<T>(about.name, rows.neighbour.extent(0)) : std::decay_t<decltype(field)>();
    if (needed) Kokkos::deep_copy(field, static_cast<T>(about.empty));
  };
  for_each_possible_history(features, change, changed);
  rows = changed;
}

std::size_t bytes(ContactRows const& rows) {
  std::size_t total = rows.active.span() * sizeof(std::uint64_t) +
                      (rows.slice_start.span() + rows.length.span() + rows.neighbour.span()) * sizeof(int);
  auto const count = [&](HistoryField const&, auto const& field) {
    total += field.span() * sizeof(typename std::decay_t<decltype(field)>::value_type);
  };
  for_each_history(rows, count);
  count({"width"}, rows.width);
  return total;
}

}  // namespace clathra
