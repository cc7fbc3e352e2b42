#include "io/results/specimen_file.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "domain/parallel/redistribution.hpp"
#include "domain/scene/units.hpp"
#include "io/errors/rank_errors.hpp"
#include "io/formats/hdf5_file.hpp"
#include "io/results/specimen_check.hpp"

namespace clathra {
namespace {

constexpr char specimen_format[] = "clathra specimen";
constexpr std::int64_t specimen_version = 2;

constexpr double of_the_discs = std::numeric_limits<double>::quiet_NaN();

/// A number of a specimen, and what it is where a file does not state it.
struct SpecimenNumber {
  char const* name;
  double Specimen::*of;
  char const* unit;
  std::optional<double> left_out;  ///< nothing: a file must state it
  bool may_be_negative = false;
};
constexpr SpecimenNumber specimen_numbers[] = {{"left", &Specimen::left, "m", {}, true},
                                               {"right", &Specimen::right, "m", {}, true},
                                               {"bottom", &Specimen::bottom, "m", {}, true},
                                               {"top", &Specimen::top, "m", {}, true},
                                               {"density", &Specimen::density, "kg/m^3", {}},
                                               {"d50", &Specimen::d50, "m", of_the_discs},
                                               {"stress", &Specimen::stress, "Pa", 0},
                                               {"void_ratio", &Specimen::void_ratio, "", of_the_discs, true},
                                               {"critical_thickness", &Specimen::critical_thickness, "m", 0}};

/// Whether a file must hold a column of the discs; motion is 0 where it is left out.
bool is_needed(ParticleColumn const& column) {
  return column.of == &Specimen::x || column.of == &Specimen::y || column.of == &Specimen::radius;
}

std::string path_of(ParticleColumn const& column) { return std::string("particles/") + column.name; }

void write_content(Hdf5File& file, Specimen const& specimen, Ranks const& ranks) {
  auto const total = [&](std::size_t count) { return ranks.sum(static_cast<std::int64_t>(count)); };
  file.set_attribute("format", std::string(specimen_format));
  file.set_attribute("version", specimen_version);
  file.set_attribute("particles", total(specimen.size()));
  file.set_attribute("contacts", total(specimen.contacts.size()));
  file.set_attribute("periodic", std::int64_t{specimen.periodic});
  file.set_attribute("separate_bonds", std::int64_t{specimen.separate_bonds});
  file.set_attribute("axial_strain", specimen.axial_strain, "");
  for (SpecimenNumber const& number : specimen_numbers) file.set_attribute(number.name, specimen.*number.of, number.unit);
  file.write_text("provenance", specimen.provenance);
  file.write("particles/id", specimen.id, "");
  for (ParticleColumn const& column : particle_columns) file.write(path_of(column), specimen.*column.of, column.unit);
  std::size_t const count = specimen.contacts.size();
  std::vector<std::int32_t> ids(count);
  for (std::size_t i = 0; i < count; ++i) ids[i] = specimen.contacts[i].id_a;
  file.write("contacts/id_a", ids, "");
  for (std::size_t i = 0; i < count; ++i) ids[i] = specimen.contacts[i].id_b;
  file.write("contacts/id_b", ids, "");
  std::vector<double> column(count);
  for (ContactNumber const& number : contact_numbers) {
    for (std::size_t i = 0; i < count; ++i) column[i] = specimen.contacts[i].*number.of;
    file.write(std::string("contacts/") + number.name, column, number.unit);
  }
}

[[noreturn]] void damaged(std::filesystem::path const& path, std::string const& what) {
  throw FileProblem(ExitCode::bad_input, path, what);
}

void check_box(std::filesystem::path const& path, Specimen const& specimen) {
  if (!(specimen.right > specimen.left) || !(specimen.top > specimen.bottom)) damaged(path, "the walls enclose no area");
  if (!(specimen.density > 0)) damaged(path, "the density is not above 0");
  if (specimen.d50 <= 0) damaged(path, "d50 is not above 0");
}

/// @param discs  of the whole specimen, of which this is a part
void check_particles(std::filesystem::path const& path, Specimen const& part, std::int64_t discs) {
  for (int const id : part.id) {
    if (id < 0 || id >= discs) damaged(path, fmt::format("particle id {} is outside 0..{}", id, discs - 1));
  }
  for (ParticleColumn const& column : particle_columns)
    for (std::size_t i = 0; i < part.size(); ++i)
      if (!std::isfinite((part.*column.of)[i]))
        damaged(path, fmt::format("{} of particle {} is not a finite number", column.name, part.id[i]));
  for (std::size_t i = 0; i < part.size(); ++i)
    if (!(part.radius[i] > 0)) damaged(path, fmt::format("the radius of particle {} is not above 0", part.id[i]));
}

void check_ids_once(std::filesystem::path const& path, std::vector<int> ids) {
  std::sort(ids.begin(), ids.end());
  if (auto const twice = std::adjacent_find(ids.begin(), ids.end()); twice != ids.end())
    damaged(path, fmt::format("particle id {} comes twice", *twice));
}

void check_pairs_once(std::filesystem::path const& path, Specimen const& specimen) {
  std::vector<std::pair<int, int>> pairs;
  pairs.reserve(specimen.contacts.size());
  for (SpecimenContact const& contact : specimen.contacts) pairs.emplace_back(contact.id_a, contact.id_b);
  std::sort(pairs.begin(), pairs.end());
  if (auto const twice = std::adjacent_find(pairs.begin(), pairs.end()); twice != pairs.end())
    damaged(path, fmt::format("contact {} - {} comes twice", twice->first, twice->second));
}

/// Bonds span h_max at most, up to the rounding of single precision.
void check_bond(std::filesystem::path const& path, SpecimenContact const& contact, double critical_thickness) {
  std::string const bond = fmt::format("the bond {} - {}", contact.id_a, contact.id_b);
  if (!(critical_thickness > 0)) damaged(path, bond + " has no h_max: critical_thickness is left out or 0");
  if (-contact.formation_overlap > critical_thickness * (1 + 1e-5))
    damaged(path, fmt::format("{} formed across {:.4g} um, h_max (critical_thickness) is {:.4g} um", bond,
                              -contact.formation_overlap * 1e6, critical_thickness * 1e6));
}

void check_contacts(std::filesystem::path const& path, Specimen const& specimen, std::int64_t count) {
  for (SpecimenContact const& contact : specimen.contacts) {
    if (contact.id_a >= count || contact.id_b >= count)
      damaged(path, fmt::format("contact {} - {} names a particle that is not there: ids go to {}", contact.id_a, contact.id_b,
                                count - 1));
    if (contact.id_a < 0 || contact.id_a >= contact.id_b)
      damaged(path,
              fmt::format("contact {} - {} is not between two particles in order of their ids", contact.id_a, contact.id_b));
    for (ContactNumber const& number : contact_numbers)
      if (!std::isfinite(contact.*number.of))
        damaged(path, fmt::format("{} of contact {} - {} is not a finite number", number.name, contact.id_a, contact.id_b));
    if (contact.bonded()) check_bond(path, contact, specimen.critical_thickness);
  }
}

/// Whole numbers, which may be written as floats.
std::vector<int> read_ids(Hdf5File const& file, std::string const& name, RowRange const& rows) {
  std::vector<double> const numbers = file.read<double>(name, rows);
  std::vector<int> ids;
  ids.reserve(numbers.size());
  for (double const number : numbers) {
    if (!(std::abs(number) <= 2e9 && number == std::floor(number)))
      file.fail(ExitCode::bad_input, fmt::format("{} must hold whole numbers, got {}", name, number));
    ids.push_back(static_cast<int>(number));
  }
  return ids;
}

/// A file may state units, but those of docs/reference/specimen-file.md, whose further words stand in parentheses.
void require_unit(Hdf5File const& file, std::string const& name, std::optional<std::string> const& stated, std::string unit) {
  unit = unit.substr(0, unit.find(" ("));
  if (!stated || stated->empty() || unit.empty() || stated->substr(0, stated->find(" (")) == unit) return;
  file.fail(ExitCode::bad_input, fmt::format("{} is in {} by its unit; it must be in {}", name, quote_of(*stated), unit));
}

void require_units(Hdf5File const& file) {
  for (SpecimenNumber const& number : specimen_numbers)
    require_unit(file, number.name, file.unit_of_attribute(number.name), number.unit);
  for (ParticleColumn const& column : particle_columns)
    require_unit(file, path_of(column), file.unit_of_column(path_of(column)), column.unit);
  for (ContactNumber const& number : contact_numbers) {
    std::string const name = std::string("contacts/") + number.name;
    require_unit(file, name, file.unit_of_column(name), number.unit);
  }
}

void read_discs(Hdf5File const& file, Specimen& part, RowRange const& rows) {
  if (file.has("particles/id")) {
    part.id = read_ids(file, "particles/id", rows);
  } else {
    for (std::size_t i = rows.begin; i < rows.end; ++i) part.id.push_back(static_cast<int>(i));
  }
  for (ParticleColumn const& column : particle_columns)
    part.*column.of = is_needed(column) || file.has(path_of(column)) ? file.read<double>(path_of(column), rows)
                                                                     : std::vector<double>(rows.end - rows.begin, 0.0);
}

void read_contacts(Hdf5File const& file, Specimen& part, RowRange const& rows) {
  if (rows.size == 0) return;
  std::vector<int> const id_a = read_ids(file, "contacts/id_a", rows), id_b = read_ids(file, "contacts/id_b", rows);
  part.contacts.resize(id_a.size());
  for (std::size_t i = 0; i < id_a.size(); ++i) part.contacts[i].id_a = id_a[i], part.contacts[i].id_b = id_b[i];
  for (ContactNumber const& number : contact_numbers) {
    std::string const name = std::string("contacts/") + number.name;
    if (!file.has(name)) continue;
    std::vector<double> const column = file.read<double>(name, rows);
    for (std::size_t i = 0; i < column.size(); ++i) part.contacts[i].*number.of = column[i];
  }
}

/// Everything that a file must hold and does not, at once.
void require_complete(Hdf5File const& file) {
  std::string attributes, sets;
  auto const note = [](bool there, std::string const& name, std::string& missing) {
    if (!there) missing += (missing.empty() ? "" : ", ") + name;
  };
  for (char const* const name : {"format", "version"}) note(file.has_attribute(name), name, attributes);
  for (SpecimenNumber const& number : specimen_numbers)
    if (!number.left_out) note(file.has_attribute(number.name), number.name, attributes);
  for (ParticleColumn const& column : particle_columns)
    if (is_needed(column)) note(file.has(path_of(column)), path_of(column), sets);
  if (file.has("contacts") || (file.has_attribute("contacts") && file.integer_attribute("contacts") > 0))
    for (char const* const name : {"contacts/id_a", "contacts/id_b"}) note(file.has(name), name, sets);
  if (attributes.empty() && sets.empty()) return;
  if (!attributes.empty()) attributes = "the attributes " + attributes;
  if (!sets.empty()) sets = "the data sets " + sets;
  file.fail(ExitCode::bad_input,
            fmt::format("lacks what a specimen file must hold: {}{}{} (docs/reference/specimen-file.md lists all)", attributes,
                        attributes.empty() || sets.empty() ? "" : ", and ", sets));
}

double read_number(Hdf5File const& file, SpecimenNumber const& number) {
  if (number.left_out && !file.has_attribute(number.name)) return *number.left_out;
  double const value = file.double_attribute(number.name);
  if (!std::isfinite(value)) file.fail(ExitCode::bad_input, fmt::format("{} is not a finite number", number.name));
  if (value < 0 && !number.may_be_negative)
    file.fail(ExitCode::bad_input, fmt::format("{} must not be below 0, got {}", number.name, value));
  return value;
}

bool read_switch(Hdf5File const& file, char const* name) {
  std::int64_t const value = file.has_attribute(name) ? file.integer_attribute(name) : 0;
  if (value != 0 && value != 1) file.fail(ExitCode::bad_input, fmt::format("{} must be 0 or 1, got {}", name, value));
  return value == 1;
}

/// A count that the file states, else the rows of a column.
std::int64_t read_count(Hdf5File const& file, char const* attribute, std::string const& column) {
  if (file.has_attribute(attribute)) return file.integer_attribute(attribute);
  return file.has(column) ? static_cast<std::int64_t>(file.rows_of(column)) : 0;
}

double axial_strain_of(Hdf5File const& file) {
  if (!file.has_attribute("axial_strain")) return 0;
  double const strain = file.double_attribute("axial_strain");
  if (!(std::abs(strain) < 1))
    file.fail(ExitCode::bad_input, fmt::format("axial_strain must lie between -1 and 1, got {} (0.1 is 10 %)", strain));
  return strain;
}

/// This rank's rows of a specimen file, checked as far as they can be without the others'.
Specimen read_rows_of(std::filesystem::path const& path, Ranks const& ranks, std::int64_t& discs) {
  Hdf5File const file = Hdf5File::open(path);
  if (file.has_attribute("format") && file.text_attribute("format") != specimen_format)
    file.fail(ExitCode::bad_input, "is not a specimen file of Clathra");
  require_complete(file);
  require_units(file);
  if (std::int64_t const version = file.integer_attribute("version"); version != specimen_version)
    file.fail(ExitCode::bad_input, fmt::format("has version {}, this program reads {}", version, specimen_version));
  Specimen part;
  for (SpecimenNumber const& number : specimen_numbers) part.*number.of = read_number(file, number);
  part.periodic = read_switch(file, "periodic");
  part.separate_bonds = read_switch(file, "separate_bonds");
  if (file.has("provenance")) part.provenance = file.read_text("provenance");
  part.axial_strain = axial_strain_of(file);
  discs = read_count(file, "particles", path_of(particle_columns[0]));
  std::int64_t const contacts = read_count(file, "contacts", "contacts/id_a");
  if (discs < 0 || discs > 1'000'000'000 || contacts < 0 || contacts > 10'000'000'000)
    file.fail(ExitCode::bad_input, fmt::format("claims {} particles and {} contacts", discs, contacts));
  if (discs == 0) damaged(path, "there are no particles");
  read_discs(file, part, rows_of_rank(discs, ranks));
  read_contacts(file, part, rows_of_rank(contacts, ranks));
  check_box(path, part);
  check_particles(path, part, discs);
  check_contacts(path, part, discs);
  return part;
}

}  // namespace

void write_specimen(std::filesystem::path const& path, Specimen share, Ranks const& ranks, Existing existing) {
  if (!ranks.alone()) share = by_id_blocks(ranks, std::move(share));
  replace_hdf5_file(
      path, [&](Hdf5File& file) { write_content(file, share, ranks); }, ranks, existing);
}

CheckedSpecimen read_checked_specimen(std::filesystem::path const& path, Ranks const& ranks) {
  Specimen part;
  std::int64_t discs = 0;
  on_each(ranks, [&] { part = read_rows_of(path, ranks, discs); });
  if (!ranks.alone()) part = by_id_blocks(ranks, std::move(part));
  on_each(ranks, [&] {
    check_ids_once(path, part.id);
    check_pairs_once(path, part);
  });
  SpecimenFacts const facts = require_sound(path, part, ranks);
  return {std::move(part), facts};
}

Specimen read_specimen(std::filesystem::path const& path, Ranks const& ranks) {
  return read_checked_specimen(path, ranks).specimen;
}

std::uint64_t specimen_hash(Specimen const& specimen) {
  std::vector<double> numbers;
  for (SpecimenNumber const& number : specimen_numbers) numbers.push_back(specimen.*number.of);
  std::size_t const count = specimen.size(), start = numbers.size();
  constexpr std::size_t columns = std::size(particle_columns);
  numbers.resize(start + columns * count);
  for (std::size_t c = 0; c < columns; ++c) {
    std::vector<double> const& column = specimen.*particle_columns[c].of;
    for (std::size_t i = 0; i < count; ++i) numbers[start + columns * static_cast<std::size_t>(specimen.id[i]) + c] = column[i];
  }
  std::vector<SpecimenContact> contacts = specimen.contacts;
  std::sort(contacts.begin(), contacts.end(), by_ids);
  for (SpecimenContact const& contact : contacts) append_numbers(numbers, contact);
  return XXH3_64bits(numbers.data(), numbers.size() * sizeof(double));
}

}  // namespace clathra
