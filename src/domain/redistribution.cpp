#include "domain/redistribution.hpp"

#include <algorithm>
#include <numeric>

#include "domain/decomposition.hpp"
#include "domain/directory.hpp"

namespace clathra {

namespace {

constexpr std::vector<double> Specimen::*columns[] = {&Specimen::x,  &Specimen::y,     &Specimen::angle, &Specimen::vx,
                                                      &Specimen::vy, &Specimen::omega, &Specimen::radius};

/// @param disc_owner, contact_owner  the rank that gets each disc and contact of the share;  @return sorted by id
Specimen dealt_out(Ranks const& ranks, Specimen const& share, std::vector<int> const& disc_owner,
                   std::vector<int> const& contact_owner) {
  Specimen part = share;
  for (auto const column : columns) (part.*column).clear();
  part.id.clear();
  part.contacts.clear();
  std::vector<std::vector<double>> to_discs(static_cast<std::size_t>(ranks.count())), to_contacts = to_discs;
  for (std::size_t i = 0; i < share.size(); ++i) {
    auto& numbers = to_discs[static_cast<std::size_t>(disc_owner[i])];
    numbers.push_back(share.id[i]);
    for (auto const column : columns) numbers.push_back((share.*column)[i]);
  }
  for (std::size_t k = 0; k < share.contacts.size(); ++k)
    append_numbers(to_contacts[static_cast<std::size_t>(contact_owner[k])], share.contacts[k]);
  constexpr std::size_t width = 1 + std::size(columns);
  std::vector<double> numbers;
  for (auto const& from : ranks.exchange(to_discs)) numbers.insert(numbers.end(), from.begin(), from.end());
  std::vector<std::size_t> order(numbers.size() / width);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return numbers[a * width] < numbers[b * width]; });
  for (std::size_t const k : order) {
    part.id.push_back(static_cast<int>(numbers[k * width]));
    for (std::size_t c = 0; c < std::size(columns); ++c) (part.*columns[c]).push_back(numbers[k * width + 1 + c]);
  }
  for (auto const& from : ranks.exchange(to_contacts)) append_contacts(part.contacts, from);
  std::sort(part.contacts.begin(), part.contacts.end(), by_ids);
  return part;
}

}  // namespace

Specimen by_id_blocks(Ranks const& ranks, Specimen const& share, std::int64_t discs) {
  std::int64_t const size = std::max<std::int64_t>(1, (discs + ranks.count() - 1) / ranks.count());
  std::vector<int> disc_owner, contact_owner;
  for (int const id : share.id) disc_owner.push_back(static_cast<int>(id / size));
  for (SpecimenContact const& c : share.contacts) contact_owner.push_back(static_cast<int>(c.id_a / size));
  return dealt_out(ranks, share, disc_owner, contact_owner);
}

Specimen by_place(Ranks const& ranks, Specimen const& share, std::int64_t discs) {
  if (ranks.alone()) return share;
  Decomposition const cuts = Decomposition::bisect(ranks, share.x, share.y, 1);
  std::vector<int> disc_owner, contact_owner, first;
  for (std::size_t i = 0; i < share.size(); ++i) disc_owner.push_back(cuts.owner(share.x[i], share.y[i]));
  for (SpecimenContact const& c : share.contacts) first.push_back(std::min(c.id_a, c.id_b));
  Directory const owners(ranks, discs, share.id, {{disc_owner.begin(), disc_owner.end()}});
  for (double const owner : owners.find(first)) contact_owner.push_back(static_cast<int>(owner));
  return dealt_out(ranks, share, disc_owner, contact_owner);
}

}  // namespace clathra
