#include "kernels/contacts.hpp"

namespace clathra {

void allocate_history(ContactRows& rows, std::size_t entries) {
  rows.entries = static_cast<int>(entries);
  for_each_history(rows, [&](HistoryField const& about, RealField& field) {
    field = RealField(about.name, entries, kept(rows.features.format, about.quantity), false);
    fill(field, about.empty);
  });
}

void change_features(ContactRows& rows, ContactFeatures features) {
  ContactRows changed = rows;
  changed.features = features;
  auto const change = [&](HistoryField const& about, bool needed, RealField& field) {
    NumberFormat const format = kept(features.format, about.quantity);
    if (needed && field.extent(0) > 0 && field.format() == format) return;  // what both have is kept
    RealField const before = field;
    field = needed ? RealField(about.name, rows.neighbour.extent(0), format, false) : RealField();
    if (needed && before.extent(0) > 0)
      set_from_host(field, on_host(before, before.extent(0)));
    else if (needed)
      fill(field, about.empty);
  };
  for_each_possible_history(features, change, changed);
  rows = changed;
}

std::size_t bytes(ContactRows const& rows) {
  std::size_t total = rows.active.span() * sizeof(std::uint64_t) +
                      (rows.slice_start.span() + rows.neighbour.span()) * sizeof(int) + rows.length.span() * sizeof(RowLength);
  for_each_history(rows, [&](HistoryField const&, RealField const& field) { total += field.bytes(); });
  return total + rows.width.bytes();
}

}  // namespace clathra
