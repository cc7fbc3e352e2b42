#include "domain/parallel/disc_record.hpp"

#include <utility>

namespace clathra {

namespace {

/// Where the numbers stand in records: id, the disc's columns, the length of its row, and then entry by entry the neighbour's id
/// and the history.
struct RecordLayout {
  std::size_t length, entries, entry_width;
  explicit RecordLayout(RecordColumns const& names)
      : length(1 + names.discs.size()), entries(length + 1), entry_width(1 + names.history.size()) {}

  /// Visits the number at a place of every disc's record.
  template <class Records, class Visit>
  static void for_each_disc(Records& records, std::size_t place, Visit&& visit) {
    for (std::size_t k = 0; k < records.size(); ++k) visit(records.numbers[records.begin[k] + place]);
  }
  /// Visits the number at a place of every entry of every disc's row.
  template <class Records, class Visit>
  void for_each_entry(Records& records, std::size_t place, Visit&& visit) const {
    for (std::size_t k = 0; k < records.size(); ++k) {
      for (std::size_t at = records.begin[k] + entries + place; at < records.begin[k + 1]; at += entry_width)
        visit(records.numbers[at]);
    }
  }
};

}  // namespace

RecordColumns DiscColumns::names() const {
  RecordColumns names;
  for (Column const& column : discs) names.discs.push_back(column.name);
  for (Column const& column : history) names.history.push_back(column.name);
  return names;
}

DiscColumns columns_of(DiscRecords records, RecordColumns const& names) {
  DiscColumns columns;
  columns.records = std::make_shared<DiscRecords>(std::move(records));
  auto const of_discs = [all = columns.records]<class T>(std::size_t place, T) {
    return [all, place] {
      std::vector<T> numbers;
      RecordLayout::for_each_disc(*all, place, [&](double number) { numbers.push_back(static_cast<T>(number)); });
      return numbers;
    };
  };
  auto const of_entries = [all = columns.records, layout = RecordLayout(names)]<class T>(std::size_t place, T) {
    return [all, layout, place] {
      std::vector<T> numbers;
      layout.for_each_entry(*all, place, [&](double number) { numbers.push_back(static_cast<T>(number)); });
      return numbers;
    };
  };
  constexpr std::int32_t integer = 0;
  constexpr double real = 0;
  columns.id = of_discs(0, integer);
  columns.row_length = of_discs(RecordLayout(names).length, integer);
  columns.neighbour = of_entries(0, integer);
  for (std::size_t c = 0; c < names.discs.size(); ++c) columns.discs.push_back({names.discs[c], of_discs(1 + c, real)});
  for (std::size_t c = 0; c < names.history.size(); ++c) columns.history.push_back({names.history[c], of_entries(1 + c, real)});
  return columns;
}

DiscRecords records_of(DiscColumns&& columns) {
  if (columns.records) return std::move(*columns.records);
  RecordLayout const layout(columns.names());
  DiscRecords records;
  std::vector<std::int32_t> const lengths = columns.row_length();
  records.begin.reserve(lengths.size() + 1);
  for (int const n : lengths)
    records.begin.push_back(records.begin.back() + layout.entries + static_cast<std::size_t>(n) * layout.entry_width);
  records.numbers.resize(records.begin.back());
  // Takes the numbers of a column one by one.
  auto const next_of = [](auto const& column) { return [at = column.begin()](double& number) mutable { number = *at++; }; };
  auto const fill_discs = [&](std::size_t place, auto const& column) { layout.for_each_disc(records, place, next_of(column)); };
  auto const fill_entries = [&](std::size_t place, auto const& column) {
    layout.for_each_entry(records, place, next_of(column));
  };
  fill_discs(0, columns.id());
  fill_discs(layout.length, lengths);
  fill_entries(0, columns.neighbour());
  for (std::size_t c = 0; c < columns.discs.size(); ++c) fill_discs(1 + c, columns.discs[c].numbers());
  for (std::size_t c = 0; c < columns.history.size(); ++c) fill_entries(1 + c, columns.history[c].numbers());
  return records;
}

}  // namespace clathra
