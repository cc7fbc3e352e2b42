#include "domain/parallel/disc_record.hpp"

#include <utility>

namespace clathra {

RecordColumns DiscColumns::names() const {
  RecordColumns names;
  for (Column const& column : discs) names.discs.push_back(column.name);
  for (Column const& column : history) names.history.push_back(column.name);
  return names;
}

DiscRecords records_of(DiscColumns columns) {
  // A record: id, the disc's columns, the length of its row, and then entry by entry the neighbour's id and the history.
  std::size_t const length_at = 1 + columns.discs.size(), entries_at = length_at + 1, entry_width = 1 + columns.history.size();
  DiscRecords records;
  std::vector<std::int32_t> const lengths = columns.row_length();
  records.begin.reserve(lengths.size() + 1);
  for (int const n : lengths)
    records.begin.push_back(records.begin.back() + entries_at + static_cast<std::size_t>(n) * entry_width);
  records.numbers.resize(records.begin.back());
  auto const set_discs = [&](std::size_t place, auto const& column) {
    for (std::size_t k = 0; k < records.size(); ++k) records.numbers[records.begin[k] + place] = column[k];
  };
  auto const set_entries = [&](std::size_t place, auto const& column) {
    auto next = column.begin();
    for (std::size_t k = 0; k < records.size(); ++k)
      for (std::size_t at = records.begin[k] + entries_at + place; at < records.begin[k + 1]; at += entry_width)
        records.numbers[at] = *next++;
  };
  auto const taken = [](auto& numbers) { return std::exchange(numbers, nullptr)(); };
  set_discs(0, taken(columns.id));
  set_discs(length_at, lengths);
  set_entries(0, taken(columns.neighbour));
  for (std::size_t c = 0; c < columns.discs.size(); ++c) set_discs(1 + c, taken(columns.discs[c].numbers));
  for (std::size_t c = 0; c < columns.history.size(); ++c) set_entries(1 + c, taken(columns.history[c].numbers));
  return records;
}

}  // namespace clathra
