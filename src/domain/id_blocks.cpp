#include "domain/id_blocks.hpp"

#include <algorithm>
#include <numeric>

namespace clathra {

namespace {

constexpr std::vector<double> Specimen::*columns[] = {&Specimen::x,  &Specimen::y,     &Specimen::angle, &Specimen::vx,
                                                      &Specimen::vy, &Specimen::omega, &Specimen::radius};

}  // namespace

Specimen by_id_blocks(Ranks const& ranks, Specimen const& share, std::int64_t discs) {
  Specimen block = share;
  for (auto const column : columns) (block.*column).clear();
  block.id.clear();
  block.contacts.clear();
  std::int64_t const size = std::max<std::int64_t>(1, (discs + ranks.count() - 1) / ranks.count());
  std::vector<std::vector<double>> to_discs(static_cast<std::size_t>(ranks.count())), to_contacts = to_discs;
  for (std::size_t i = 0; i < share.size(); ++i) {
    auto& part = to_discs[static_cast<std::size_t>(share.id[i] / size)];
    part.push_back(share.id[i]);
    for (auto const column : columns) part.push_back((share.*column)[i]);
  }
  for (SpecimenContact const& c : share.contacts) {
    append_numbers(to_contacts[static_cast<std::size_t>(c.id_a / size)], c);
  }
  constexpr std::size_t width = 1 + std::size(columns);
  std::vector<double> numbers;
  for (auto const& part : ranks.exchange(to_discs)) numbers.insert(numbers.end(), part.begin(), part.end());
  std::vector<std::size_t> order(numbers.size() / width);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return numbers[a * width] < numbers[b * width]; });
  for (std::size_t const k : order) {
    block.id.push_back(static_cast<int>(numbers[k * width]));
    for (std::size_t c = 0; c < std::size(columns); ++c) (block.*columns[c]).push_back(numbers[k * width + 1 + c]);
  }
  for (auto const& part : ranks.exchange(to_contacts)) append_contacts(block.contacts, part);
  std::sort(block.contacts.begin(), block.contacts.end(), by_ids);
  return block;
}

}  // namespace clathra
