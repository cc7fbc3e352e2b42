#include "io/results/specimen_file.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "domain/parallel/redistribution.hpp"
#include "io/errors/rank_errors.hpp"
#include "io/formats/former_names.hpp"
#include "io/formats/hdf5_file.hpp"

namespace clathra {
namespace {

constexpr char format_name[] = "clathra specimen";
constexpr std::int64_t format_version = 2;  // 1 knew nothing of the strain and of what bonds are made of; it is read, too

constexpr double not_known = -1;  // an axial strain

/// Visits every scalar of a specimen: name, value, unit.
template <class Any, class Visit>
void for_each_scalar(Any& specimen, Visit&& visit) {
  visit("left", specimen.left, "m");
  visit("right", specimen.right, "m");
  visit("bottom", specimen.bottom, "m");
  visit("top", specimen.top, "m");
  visit("density", specimen.density, "kg/m^3");
  visit("d50", specimen.d50, "m");
  visit("stress", specimen.stress, "Pa");
  visit("void_ratio", specimen.void_ratio, "");
  visit("critical_thickness", specimen.critical_thickness, "m");
}

void write_content(Hdf5File& file, Specimen const& specimen, Ranks const& ranks) {
  auto const total = [&](std::size_t count) { return ranks.sum(static_cast<std::int64_t>(count)); };
  file.set_attribute("format", std::string(format_name));
  file.set_attribute("version", format_version);
  file.set_attribute("particles", total(specimen.size()));
  file.set_attribute("contacts", total(specimen.contacts.size()));
  file.set_attribute("periodic", std::int64_t{specimen.periodic});
  file.set_attribute("separate_bonds", std::int64_t{specimen.separate_bonds});
  file.set_attribute("axial_strain", specimen.axial_strain.value_or(not_known), "");
  for_each_scalar(specimen, [&](char const* name, double value, char const* unit) { file.set_attribute(name, value, unit); });
  file.write_text("provenance", specimen.provenance);
  file.write("particles/id", specimen.id, "");
  for (ParticleColumn const& column : particle_columns)
    file.write(std::string("particles/") + column.name, specimen.*column.of, column.unit);
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
  for_each_scalar(specimen, [&](char const* name, double value, char const*) {
    if (!std::isfinite(value)) damaged(path, fmt::format("{} is not a finite number", name));
  });
  if (!(specimen.right > specimen.left) || !(specimen.top > specimen.bottom)) damaged(path, "the walls enclose no area");
  if (!(specimen.density > 0)) damaged(path, "the density is not above 0");
  if (!(specimen.d50 > 0)) damaged(path, "d50 is not above 0");
}

/// @param discs  of the whole specimen, of which this is a part
void check_particles(std::filesystem::path const& path, Specimen const& part, std::int64_t discs) {
  for (int const id : part.id) {
    if (id < 0 || id >= discs) damaged(path, fmt::format("disc id {} is outside 0..{}", id, discs - 1));
  }
  for (ParticleColumn const& column : particle_columns)
    for (std::size_t i = 0; i < part.size(); ++i)
      if (!std::isfinite((part.*column.of)[i]))
        damaged(path, fmt::format("{} of disc {} is not a finite number", column.name, part.id[i]));
  for (std::size_t i = 0; i < part.size(); ++i)
    if (!(part.radius[i] > 0)) damaged(path, fmt::format("the radius of disc {} is not above 0", part.id[i]));
}

void check_ids_once(std::filesystem::path const& path, std::vector<int> ids) {
  std::sort(ids.begin(), ids.end());
  if (auto const twice = std::adjacent_find(ids.begin(), ids.end()); twice != ids.end())
    damaged(path, fmt::format("disc id {} comes twice", *twice));
}

void check_pairs_once(std::filesystem::path const& path, Specimen const& specimen) {
  std::vector<std::pair<int, int>> pairs;
  pairs.reserve(specimen.contacts.size());
  for (SpecimenContact const& contact : specimen.contacts) pairs.emplace_back(contact.id_a, contact.id_b);
  std::sort(pairs.begin(), pairs.end());
  if (auto const twice = std::adjacent_find(pairs.begin(), pairs.end()); twice != pairs.end())
    damaged(path, fmt::format("contact {} - {} comes twice", twice->first, twice->second));
}

void check_contacts(std::filesystem::path const& path, Specimen const& specimen, std::int64_t count) {
  for (SpecimenContact const& contact : specimen.contacts) {
    if (contact.id_a < 0 || contact.id_a >= contact.id_b || contact.id_b >= count)
      damaged(path, fmt::format("contact {} - {} is not between two discs in order of their ids", contact.id_a, contact.id_b));
    for (ContactNumber const& number : contact_numbers)
      if (!std::isfinite(contact.*number.of))
        damaged(path, fmt::format("{} of contact {} - {} is not a finite number", number.name, contact.id_a, contact.id_b));
  }
}

void read_discs(Hdf5File const& file, Specimen& part, RowRange const& rows) {
  part.id = file.read<std::int32_t>("particles/id", rows);
  for (ParticleColumn const& column : particle_columns)
    part.*column.of = file.read<double>(std::string("particles/") + column.name, rows);
}

void read_contacts(Hdf5File const& file, Specimen& part, RowRange const& rows) {
  std::vector<std::int32_t> const id_a = file.read<std::int32_t>("contacts/id_a", rows);
  std::vector<std::int32_t> const id_b = file.read<std::int32_t>("contacts/id_b", rows);
  part.contacts.resize(id_a.size());
  for (std::size_t i = 0; i < id_a.size(); ++i) part.contacts[i].id_a = id_a[i], part.contacts[i].id_b = id_b[i];
  for (ContactNumber const& number : contact_numbers) {
    std::string const name = std::string("contacts/") + number.name, before = "contacts/" + former_name(number.name);
    std::vector<double> const column = file.read<double>(file.has(name) ? name : before, rows);
    for (std::size_t i = 0; i < column.size(); ++i) part.contacts[i].*number.of = column[i];
  }
}

/// A file of version 1 tells only of a specimen that was just generated that nobody has sheared it.
std::optional<double> axial_strain_of(Hdf5File const& file, std::int64_t version, std::string const& provenance) {
  if (version == 1)
    return nlohmann::json::parse(provenance, nullptr, false).contains("generate") ? std::optional(0.0) : std::nullopt;
  double const strain = file.double_attribute("axial_strain");
  if (!std::isfinite(strain)) file.fail(ExitCode::bad_input, "axial_strain is not a finite number");
  return strain == not_known ? std::nullopt : std::optional(strain);
}

/// This rank's rows of a specimen file, checked as far as they can be without the others'.
Specimen read_rows_of(std::filesystem::path const& path, Ranks const& ranks, std::int64_t& discs) {
  Hdf5File const file = Hdf5File::open(path);
  if (file.text_attribute("format") != format_name) file.fail(ExitCode::bad_input, "is not a specimen file of Clathra");
  std::int64_t const version = file.integer_attribute("version");
  if (version < 1 || version > format_version)
    file.fail(ExitCode::bad_input, fmt::format("has version {}, this program reads 1 to {}", version, format_version));
  Specimen part;
  for_each_scalar(part, [&](char const* name, double& value, char const*) { value = file.double_attribute(name); });
  part.periodic = file.integer_attribute("periodic") != 0;
  part.separate_bonds = file.integer_attribute("separate_bonds") != 0;
  part.provenance = file.read_text("provenance");
  part.axial_strain = axial_strain_of(file, version, part.provenance);
  discs = file.integer_attribute("particles");
  std::int64_t const contacts = file.integer_attribute("contacts");
  if (discs < 0 || discs > 1'000'000'000 || contacts < 0 || contacts > 10'000'000'000)
    file.fail(ExitCode::bad_input, fmt::format("claims {} discs and {} contacts", discs, contacts));
  if (discs == 0) damaged(path, "there are no discs");
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

Specimen read_specimen(std::filesystem::path const& path, Ranks const& ranks) {
  Specimen part;
  std::int64_t discs = 0;
  on_each(ranks, [&] { part = read_rows_of(path, ranks, discs); });
  if (!ranks.alone()) part = by_id_blocks(ranks, std::move(part));
  on_each(ranks, [&] {
    check_ids_once(path, part.id);
    check_pairs_once(path, part);
  });
  return part;
}

std::uint64_t specimen_hash(Specimen const& specimen) {
  std::vector<double> numbers;
  for_each_scalar(specimen, [&](char const*, double value, char const*) { numbers.push_back(value); });
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
