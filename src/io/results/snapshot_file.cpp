#include "io/results/snapshot_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "io/results/event_columns.hpp"

namespace clathra {
namespace {

constexpr char snapshot_format[] = "clathra snapshot";
constexpr std::int64_t snapshot_version = 1;

/// Visits every scalar of a snapshot: name, value, unit.
template <class Any, class Visit>
void for_each_scalar(Any& s, Visit&& visit) {
  visit("time", s.time, "s");
  visit("eps1", s.eps1, "");
  visit("eps_v", s.eps_v, "");
  visit("left", s.left, "m");
  visit("right", s.right, "m");
  visit("bottom", s.bottom, "m");
  visit("top", s.top, "m");
  visit("sigma1", s.sigma1, "Pa");
  visit("sigma3", s.sigma3, "Pa");
  visit("density", s.density, "kg/m^3");
  visit("d50", s.d50, "m");
  visit("critical_thickness", s.critical_thickness, "m");
}

/// The largest power of two that is not above `value`; 0 for 0.
double power_of_two(double value) { return value > 0 ? std::exp2(std::floor(std::log2(value))) : 0; }

/// Mean of |value| over all ranks.
template <class T>
double mean_size(Ranks const& ranks, std::vector<T> const& values) {
  double const sum = ranks.sequential_fold(0, [&](double total) {
    for (T const v : values) total += std::abs(static_cast<double>(v));
    return total;
  });
  std::int64_t const count = ranks.sum(static_cast<std::int64_t>(values.size()));
  return count == 0 ? 0 : sum / static_cast<double>(count);
}

/// Writes the columns of a snapshot, rounded or not.
struct ColumnWriter {
  Hdf5File& file;
  SnapshotNumbers numbers;
  Snapshot const& s;
  Ranks const& ranks;

  /// A power of two in the unit of the column, or 0 to round nothing.
  template <class Column>
  double resolution(Column const& column) const {
    switch (numbers == SnapshotNumbers::full ? Rounding::none : column.rounding) {
      case Rounding::none:
        break;
      case Rounding::length:
        return power_of_two(s.d50) / column.fineness;
      case Rounding::fixed:
        return 1 / column.fineness;
      case Rounding::typical: {
        double coarsest = 0;
        for (auto const list : column.scale)
          if (list) coarsest = std::max(coarsest, power_of_two(mean_size(ranks, s.*list)));
        return coarsest / column.fineness;
      }
    }
    return 0;
  }

  template <class Stored, class Column>
  void write_as(std::string const& name, Column const& column) const {
    double const step = resolution(column);
    std::size_t const rows = (s.*column.parts.front()).size();
    std::vector<Stored> table(rows * column.width);
    for (std::size_t k = 0; k < column.parts.size(); ++k) {
      for (std::size_t i = 0; i < rows; ++i) {
        auto const value = (s.*column.parts[k])[i];
        table[i * column.width + k] =
            step > 0 ? static_cast<Stored>(std::nearbyint(double(value) / step) * step) : static_cast<Stored>(value);
      }
    }
    file.write(name, table, column.unit, column.width);
    if (column.rounding != Rounding::none) file.set_column_attribute(name, "resolution", step);
  }
  template <class Value, std::size_t Parts>
  void of_discs(SnapshotColumn<Value, Parts> const& column) const {
    write_as<Value>(std::string("particles/") + column.name, column);
  }
  /// Single precision holds all digits of a rounded number.
  template <class Value, std::size_t Parts>
  void of_pairs(SnapshotColumn<Value, Parts> const& column) const {
    std::string const name = std::string("contacts/") + column.name;
    if (numbers == SnapshotNumbers::rounded)
      write_as<float>(name, column);
    else
      write_as<Value>(name, column);
  }
};

void write_discs(ColumnWriter const& out) {
  out.file.write("particles/id", out.s.id, "");
  std::vector<std::int32_t> index(out.s.id.size());
  std::iota(index.begin(), index.end(), static_cast<std::int32_t>(out.s.first_disc));
  out.file.write("particles/index", index, "");
  for_each_disc_column([&](auto const& column) { out.of_discs(column); });
}

void write_pairs(ColumnWriter const& out) {
  std::size_t const count = out.s.a.size();
  std::vector<std::uint32_t> pairs(2 * count);
  for (std::size_t k = 0; k < count; ++k) {
    pairs[2 * k] = static_cast<std::uint32_t>(out.s.a[k]);
    pairs[2 * k + 1] = static_cast<std::uint32_t>(out.s.b[k]);
  }
  out.file.write("contacts/pair", pairs, "index into particles", 2);
  std::string key;
  for (BreakModeNames const& m : break_modes)
    key += fmt::format("{}{} {}", key.empty() ? "" : ", ", static_cast<int>(broken_in(m.mode)), m.name);
  out.file.write("contacts/state", out.s.state, ("0 contact, 1 bonded, bond broken by: " + key).c_str());
  for_each_pair_column([&](auto const& column) { out.of_pairs(column); });
}

void write_broken_bonds(Hdf5File& file, Snapshot const& s) {
  write_event_columns(file, s.events);
  std::vector<double> position;
  for (BreakEvent const& e : s.events.rows) position.insert(position.end(), {e.x, e.y});
  file.write("events/position", position, "m", 2);
}

/// Splits the table of a column into its parts.
template <class Value, std::size_t Parts>
void read_column(Hdf5File const& file, std::string const& folder, std::size_t rows, SnapshotColumn<Value, Parts> const& column,
                 Snapshot& s) {
  std::vector<Value> const table = file.read<Value>(folder + column.name, rows, column.width);
  for (std::size_t k = 0; k < Parts; ++k) {
    std::vector<Value>& part = s.*column.parts[k];
    part.resize(rows);
    for (std::size_t i = 0; i < rows; ++i) part[i] = table[i * column.width + k];
  }
}

void read_discs(Hdf5File const& file, Snapshot& s, std::size_t count) {
  s.id = file.read<std::int32_t>("particles/id", count);
  for_each_disc_column([&](auto const& column) { read_column(file, "particles/", count, column, s); });
}

void read_pairs(Hdf5File const& file, Snapshot& s, std::size_t count) {
  std::vector<std::uint32_t> const pairs = file.read<std::uint32_t>("contacts/pair", count, 2);
  s.a.resize(count);
  s.b.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    for (std::uint32_t const disc : {pairs[2 * k], pairs[2 * k + 1]})
      if (disc >= s.id.size())
        file.fail(ExitCode::bad_input, fmt::format("contact {} names particle {}, there are {}", k, disc, s.id.size()));
    s.a[k] = static_cast<std::int32_t>(pairs[2 * k]);
    s.b[k] = static_cast<std::int32_t>(pairs[2 * k + 1]);
  }
  s.state = file.read<std::uint8_t>("contacts/state", count);
  for (std::uint8_t const state : s.state)
    if (state >= contact_state_count) file.fail(ExitCode::bad_input, fmt::format("contacts/state holds {}", state));
  for_each_pair_column([&](auto const& column) { read_column(file, "contacts/", count, column, s); });
}

void read_broken_bonds(Hdf5File const& file, Snapshot& s) {
  std::size_t const count = file.rows_of("events/step");
  s.events = read_event_columns(file, {count, 0, count});
  std::vector<double> const position = file.read<double>("events/position", count, 2);
  for (std::size_t k = 0; k < count; ++k) {
    s.events.rows[k].x = position[2 * k];
    s.events.rows[k].y = position[2 * k + 1];
  }
}

}  // namespace

void write_snapshot(std::filesystem::path const& path, Snapshot const& snapshot, Ranks const& ranks, SnapshotNumbers numbers) {
  auto const total = [&](std::size_t count) { return ranks.sum(static_cast<std::int64_t>(count)); };
  auto const write_content = [&](Hdf5File& file) {
    file.set_attribute("format", std::string(snapshot_format));
    file.set_attribute("version", snapshot_version);
    file.set_attribute("stage", snapshot.stage);
    file.set_attribute("step", snapshot.step);
    file.set_attribute("particles", total(snapshot.id.size()));
    file.set_attribute("contacts", total(snapshot.a.size()));
    for_each_scalar(snapshot, [&](char const* name, double value, char const* unit) { file.set_attribute(name, value, unit); });
    ColumnWriter const out{file, numbers, snapshot, ranks};
    write_discs(out);
    write_pairs(out);
    write_broken_bonds(file, snapshot);
    std::vector<double> walls;
    if (ranks.root()) walls = {snapshot.left, snapshot.right, snapshot.bottom, snapshot.top};
    file.write("walls/position", walls, "m (left, right, bottom, top)");
  };
  replace_hdf5_file(path, write_content, ranks);
}

Snapshot read_snapshot(std::filesystem::path const& path) {
  Hdf5File const file = Hdf5File::open(path);
  if (file.text_attribute("format") != snapshot_format) file.fail(ExitCode::bad_input, "is not a snapshot of Clathra");
  if (std::int64_t const version = file.integer_attribute("version"); version != snapshot_version)
    file.fail(ExitCode::bad_input, fmt::format("has version {}, this program reads {}", version, snapshot_version));
  std::int64_t const discs = file.integer_attribute("particles"), pairs = file.integer_attribute("contacts");
  if (discs < 1 || discs > 1'000'000'000 || pairs < 0 || pairs > 10'000'000'000)
    file.fail(ExitCode::bad_input, fmt::format("claims {} particles and {} contacts", discs, pairs));
  Snapshot s;
  s.stage = file.text_attribute("stage");
  s.step = file.integer_attribute("step");
  for_each_scalar(s, [&](char const* name, double& value, char const*) { value = file.double_attribute(name); });
  read_discs(file, s, static_cast<std::size_t>(discs));
  read_pairs(file, s, static_cast<std::size_t>(pairs));
  read_broken_bonds(file, s);
  return s;
}

bool is_snapshot(std::filesystem::path const& path) {
  Hdf5File const file = Hdf5File::open(path);
  return file.has_attribute("format") && file.text_attribute("format") == snapshot_format;
}

std::vector<std::filesystem::path> snapshot_files(std::filesystem::path const& run_folder) {
  std::vector<std::filesystem::path> files;
  std::error_code none;
  for (auto const& entry : std::filesystem::directory_iterator(run_folder / "snap", none))
    if (entry.path().extension() == ".h5") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace clathra
