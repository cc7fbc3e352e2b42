#include "domain/parallel/redistribution.hpp"

#include <algorithm>
#include <utility>

#include "domain/parallel/decomposition.hpp"
#include "domain/parallel/directory.hpp"

namespace clathra {

namespace {

/// A buffer for each rank with room for its share of records of so many numbers, which `owner` deals out.
std::vector<std::vector<double>> buffers(Ranks const& ranks, std::vector<int> const& owner, std::size_t width) {
  std::vector<std::size_t> records(static_cast<std::size_t>(ranks.count()), 0);
  for (int const rank : owner) ++records[static_cast<std::size_t>(rank)];
  std::vector<std::vector<double>> to(records.size());
  for (std::size_t r = 0; r < to.size(); ++r) to[r].reserve(records[r] * width);
  return to;
}

void deal_out_discs(Ranks const& ranks, Specimen& part, std::vector<int> const& owner) {
  constexpr std::size_t width = 1 + std::size(particle_columns);
  std::vector<std::vector<double>> to = buffers(ranks, owner, width);
  for (std::size_t i = 0; i < part.size(); ++i) {
    auto& numbers = to[static_cast<std::size_t>(owner[i])];
    numbers.push_back(part.id[i]);
    for (ParticleColumn const& column : particle_columns) numbers.push_back((part.*column.of)[i]);
  }
  for (ParticleColumn const& column : particle_columns) part.*column.of = {};
  part.id = {};
  std::vector<std::vector<double>> const from = ranks.exchange(std::move(to));
  std::vector<double const*> records;
  for (auto const& numbers : from) {
    for (std::size_t at = 0; at < numbers.size(); at += width) records.push_back(&numbers[at]);
  }
  std::sort(records.begin(), records.end(), [](double const* a, double const* b) { return *a < *b; });
  for (double const* const record : records) part.id.push_back(static_cast<int>(*record));
  for (std::size_t c = 0; c < std::size(particle_columns); ++c) {
    (part.*particle_columns[c].of).reserve(records.size());
    for (double const* const record : records) (part.*particle_columns[c].of).push_back(record[1 + c]);
  }
}

void deal_out_contacts(Ranks const& ranks, Specimen& part, std::vector<int> const& owner) {
  std::vector<std::vector<double>> to = buffers(ranks, owner, numbers_of_contact);
  for (std::size_t k = 0; k < part.contacts.size(); ++k) append_numbers(to[static_cast<std::size_t>(owner[k])], part.contacts[k]);
  part.contacts = {};
  std::vector<std::vector<double>> const from = ranks.exchange(std::move(to));
  std::size_t count = 0;
  for (auto const& numbers : from) count += numbers.size() / numbers_of_contact;
  part.contacts.reserve(count);
  for (auto const& numbers : from) append_contacts(part.contacts, numbers);
  std::sort(part.contacts.begin(), part.contacts.end(), by_ids);
}

/// @param disc_owner, contact_owner  the rank that gets each disc and contact of the share;  @return sorted by id
Specimen dealt_out(Ranks const& ranks, Specimen part, std::vector<int> const& disc_owner, std::vector<int> const& contact_owner) {
  deal_out_discs(ranks, part, disc_owner);
  deal_out_contacts(ranks, part, contact_owner);
  return part;
}

}  // namespace

Specimen by_id_blocks(Ranks const& ranks, Specimen share) {
  std::int64_t const discs = ranks.sum(static_cast<std::int64_t>(share.size()));
  std::int64_t const size = std::max<std::int64_t>(1, (discs + ranks.count() - 1) / ranks.count());
  std::vector<int> disc_owner, contact_owner;
  for (int const id : share.id) disc_owner.push_back(static_cast<int>(id / size));
  for (SpecimenContact const& c : share.contacts) contact_owner.push_back(static_cast<int>(c.id_a / size));
  return dealt_out(ranks, std::move(share), disc_owner, contact_owner);
}

Specimen by_place(Ranks const& ranks, Specimen share) {
  if (ranks.alone()) return share;
  std::int64_t const discs = ranks.sum(static_cast<std::int64_t>(share.size()));
  Decomposition const cuts = Decomposition::bisect(ranks, share.x, share.y, 1);
  std::vector<int> disc_owner, contact_owner, first;
  for (std::size_t i = 0; i < share.size(); ++i) disc_owner.push_back(cuts.owner(share.x[i], share.y[i]));
  for (SpecimenContact const& c : share.contacts) first.push_back(std::min(c.id_a, c.id_b));
  Directory const owners(ranks, discs, share.id, {{disc_owner.begin(), disc_owner.end()}});
  for (double const owner : owners.find(first)) contact_owner.push_back(static_cast<int>(owner));
  return dealt_out(ranks, std::move(share), disc_owner, contact_owner);
}

}  // namespace clathra
