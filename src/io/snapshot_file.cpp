#include "io/snapshot_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "io/event_columns.hpp"

namespace clathra {
namespace {

constexpr char format_name[] = "clathra snapshot";
constexpr std::int64_t format_version = 1;

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
  double const sum = ranks.relay(0, [&](double total) {
    for (T const v : values) total += std::abs(static_cast<double>(v));
    return total;
  });
  std::int64_t const count = ranks.sum(static_cast<std::int64_t>(values.size()));
  return count == 0 ? 0 : sum / static_cast<double>(count);
}

/// Writes the numbers of a snapshot, rounded or not.
struct NumberWriter {
  Hdf5File& file;
  SnapshotNumbers numbers;

  /// Vectors of equal length as a table, a column each; columns without a vector hold 0.
  /// @param resolution  a power of two in the unit of the column, or 0 to round nothing
  template <class Stored, class Value = Stored>
  void write(std::string const& name, std::vector<std::vector<Value> const*> const& parts, double resolution, char const* unit,
             std::size_t width) const {
    double const step = numbers == SnapshotNumbers::rounded ? resolution : 0;
    std::size_t const rows = parts.front()->size();
    std::vector<Stored> table(rows * width);
    for (std::size_t k = 0; k < parts.size(); ++k) {
      for (std::size_t i = 0; i < rows; ++i) {
        double const value = (*parts[k])[i];
        table[i * width + k] = static_cast<Stored>(step > 0 ? std::nearbyint(value / step) * step : value);
      }
    }
    file.write(name, table, unit, width);
    file.set_column_attribute(name, "resolution", step);
  }
  /// A column of the pairs: single precision holds all digits of a rounded number.
  void of_pairs(std::string const& name, std::vector<double> const& values, double resolution, char const* unit) const {
    if (numbers == SnapshotNumbers::rounded)
      write<float, double>(name, {&values}, resolution, unit, 1);
    else
      write<double>(name, {&values}, resolution, unit, 1);
  }
};

void write_discs(NumberWriter const& out, Snapshot const& s, Ranks const& ranks) {
  Hdf5File& file = out.file;
  double const length = power_of_two(s.d50);
  auto const speed = [&](std::vector<float> const& v) { return power_of_two(mean_size(ranks, v)) / 8; };
  file.write("particles/id", s.id, "");
  std::vector<std::int32_t> index(s.id.size());
  std::iota(index.begin(), index.end(), static_cast<std::int32_t>(s.first_disc));
  file.write("particles/index", index, "");
  out.write<double>("particles/position", {&s.x, &s.y}, length / 4096, "m", 2);
  out.write<float>("particles/displacement", {&s.ux, &s.uy}, length / 512, "m", 3);
  out.write<float>("particles/velocity", {&s.vx, &s.vy}, std::max(speed(s.vx), speed(s.vy)), "m/s", 3);
  out.write<float>("particles/angular_velocity", {&s.omega}, speed(s.omega), "rad/s", 1);
  out.write<float>("particles/angle", {&s.angle}, 1.0 / 1024, "rad", 1);
  out.write<float>("particles/radius", {&s.radius}, length / 8192, "m", 1);
  double const stress = power_of_two(mean_size(ranks, s.stress_yy)) / 16;
  out.write<float>("particles/stress", {&s.stress_xx, &s.stress_yy, &s.stress_xy}, stress, "Pa (xx, yy, xy)", 3);
  file.write("particles/coordination", s.coordination, "");
  file.write("particles/bonds_intact", s.bonds_intact, "");
  file.write("particles/bonds_initial", s.bonds_initial, "");
}

void write_pairs(NumberWriter const& out, Snapshot const& s, Ranks const& ranks) {
  Hdf5File& file = out.file;
  double const length = power_of_two(s.d50), force = power_of_two(mean_size(ranks, s.normal_force)) / 16;
  std::size_t const count = s.a.size();
  std::vector<std::uint32_t> pairs(2 * count);
  for (std::size_t k = 0; k < count; ++k) {
    pairs[2 * k] = static_cast<std::uint32_t>(s.a[k]);
    pairs[2 * k + 1] = static_cast<std::uint32_t>(s.b[k]);
  }
  file.write("contacts/pair", pairs, "index into particles", 2);
  file.write("contacts/state", s.state, "0 contact, 1 bonded, bond broken by: 2 tension, 3 compression, 4 shear, 5 rolling");
  out.of_pairs("contacts/normal_force", s.normal_force, force, "N/m");
  out.of_pairs("contacts/shear_force", s.shear_force, force, "N/m");
  out.of_pairs("contacts/moment", s.moment, power_of_two(mean_size(ranks, s.moment)) / 8, "N m/m");
  out.of_pairs("contacts/gap", s.gap, length / 8192, "m");
  out.of_pairs("contacts/width", s.width, length / 256, "m");
}

void write_events(Hdf5File& file, Snapshot const& s) {
  write_event_columns(file, s.events);
  std::vector<double> position;
  for (BreakEvent const& e : s.events) position.insert(position.end(), {e.x, e.y});
  file.write("events/position", position, "m", 2);
}

/// Splits a table into its columns.
template <class T>
void read_table(Hdf5File const& file, std::string const& name, std::size_t rows, std::vector<std::vector<T>*> const& parts,
                std::size_t width) {
  std::vector<T> const table = file.read<T>(name, rows, width);
  for (std::size_t k = 0; k < parts.size(); ++k) {
    parts[k]->resize(rows);
    for (std::size_t i = 0; i < rows; ++i) (*parts[k])[i] = table[i * width + k];
  }
}

void read_discs(Hdf5File const& file, Snapshot& s, std::size_t count) {
  s.id = file.read<std::int32_t>("particles/id", count);
  read_table<double>(file, "particles/position", count, {&s.x, &s.y}, 2);
  read_table<float>(file, "particles/displacement", count, {&s.ux, &s.uy}, 3);
  read_table<float>(file, "particles/velocity", count, {&s.vx, &s.vy}, 3);
  read_table<float>(file, "particles/angular_velocity", count, {&s.omega}, 1);
  read_table<float>(file, "particles/angle", count, {&s.angle}, 1);
  read_table<float>(file, "particles/radius", count, {&s.radius}, 1);
  read_table<float>(file, "particles/stress", count, {&s.stress_xx, &s.stress_yy, &s.stress_xy}, 3);
  s.coordination = file.read<std::uint8_t>("particles/coordination", count);
  s.bonds_intact = file.read<std::uint8_t>("particles/bonds_intact", count);
  s.bonds_initial = file.read<std::uint8_t>("particles/bonds_initial", count);
}

void read_pairs(Hdf5File const& file, Snapshot& s, std::size_t count) {
  std::vector<std::uint32_t> const pairs = file.read<std::uint32_t>("contacts/pair", count, 2);
  s.a.resize(count);
  s.b.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    for (std::uint32_t const disc : {pairs[2 * k], pairs[2 * k + 1]})
      if (disc >= s.id.size())
        file.fail(ExitCode::bad_input, fmt::format("contact {} names disc {}, there are {}", k, disc, s.id.size()));
    s.a[k] = static_cast<std::int32_t>(pairs[2 * k]);
    s.b[k] = static_cast<std::int32_t>(pairs[2 * k + 1]);
  }
  s.state = file.read<std::uint8_t>("contacts/state", count);
  for (std::uint8_t const state : s.state)
    if (state >= contact_state_count) file.fail(ExitCode::bad_input, fmt::format("contacts/state holds {}", state));
  read_table<double>(file, "contacts/normal_force", count, {&s.normal_force}, 1);
  read_table<double>(file, "contacts/shear_force", count, {&s.shear_force}, 1);
  read_table<double>(file, "contacts/moment", count, {&s.moment}, 1);
  read_table<double>(file, "contacts/gap", count, {&s.gap}, 1);
  read_table<double>(file, "contacts/width", count, {&s.width}, 1);
}

void read_events(Hdf5File const& file, Snapshot& s) {
  std::size_t const count = file.rows_of("events/step");
  s.events = read_event_columns(file, {count, 0, count});
  std::vector<double> const position = file.read<double>("events/position", count, 2);
  for (std::size_t k = 0; k < count; ++k) {
    s.events[k].x = position[2 * k];
    s.events[k].y = position[2 * k + 1];
  }
}

}  // namespace

void write_snapshot(std::filesystem::path const& path, Snapshot const& snapshot, Ranks const& ranks, SnapshotNumbers numbers) {
  auto const total = [&](std::size_t count) { return ranks.sum(static_cast<std::int64_t>(count)); };
  auto const write_content = [&](Hdf5File& file) {
    file.set_attribute("format", std::string(format_name));
    file.set_attribute("version", format_version);
    file.set_attribute("step", snapshot.step);
    file.set_attribute("particles", total(snapshot.id.size()));
    file.set_attribute("contacts", total(snapshot.a.size()));
    for_each_scalar(snapshot, [&](char const* name, double value, char const* unit) { file.set_attribute(name, value, unit); });
    write_discs({file, numbers}, snapshot, ranks);
    write_pairs({file, numbers}, snapshot, ranks);
    write_events(file, snapshot);
    std::vector<double> walls;
    if (ranks.root()) walls = {snapshot.left, snapshot.right, snapshot.bottom, snapshot.top};
    file.write("walls/position", walls, "m (left, right, bottom, top)");
  };
  replace_hdf5_file(path, write_content, ranks);
}

Snapshot read_snapshot(std::filesystem::path const& path) {
  Hdf5File const file = Hdf5File::open(path);
  if (file.text_attribute("format") != format_name) file.fail(ExitCode::bad_input, "is not a snapshot of Clathra");
  if (std::int64_t const version = file.integer_attribute("version"); version != format_version)
    file.fail(ExitCode::bad_input, fmt::format("has version {}, this program reads {}", version, format_version));
  std::int64_t const discs = file.integer_attribute("particles"), pairs = file.integer_attribute("contacts");
  if (discs < 1 || discs > 1'000'000'000 || pairs < 0 || pairs > 10'000'000'000)
    file.fail(ExitCode::bad_input, fmt::format("claims {} discs and {} contacts", discs, pairs));
  Snapshot s;
  s.step = file.integer_attribute("step");
  for_each_scalar(s, [&](char const* name, double& value, char const*) { value = file.double_attribute(name); });
  read_discs(file, s, static_cast<std::size_t>(discs));
  read_pairs(file, s, static_cast<std::size_t>(pairs));
  read_events(file, s);
  return s;
}

bool is_snapshot(std::filesystem::path const& path) { return Hdf5File::open(path).text_attribute("format") == format_name; }

std::vector<std::filesystem::path> snapshot_files(std::filesystem::path const& run_folder) {
  std::vector<std::filesystem::path> files;
  std::error_code none;
  for (auto const& entry : std::filesystem::directory_iterator(run_folder / "snap", none))
    if (entry.path().extension() == ".h5") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace clathra
