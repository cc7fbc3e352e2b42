#include "domain/parallel/directory.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

namespace clathra {

Directory::Directory(Ranks const& ranks, std::int64_t total, std::vector<int> const& ids,
                     std::vector<std::vector<double>> const& columns)
    : ranks_(ranks), block_(std::max<std::int64_t>(1, (total + ranks.count() - 1) / ranks.count())), columns_(columns.size()) {
  std::vector<std::vector<double>> to(static_cast<std::size_t>(ranks.count()));
  bool wrong = false;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (ids[i] < 0 || ids[i] >= total) {
      wrong = true;
      continue;
    }
    std::vector<double>& record = to[keeper(ids[i])];
    record.push_back(ids[i]);
    for (auto const& column : columns) record.push_back(column[i]);
  }
  std::int64_t const begin = std::min(total, block_ * ranks.rank()), end = std::min(total, begin + block_);
  constexpr double missing = std::numeric_limits<double>::infinity();
  values_.assign(static_cast<std::size_t>(end - begin) * columns_, missing);
  std::vector<bool> seen(static_cast<std::size_t>(end - begin), false);
  for (auto const& part : ranks.exchange(std::move(to))) {
    for (std::size_t at = 0; at < part.size(); at += 1 + columns_) {
      auto const place = static_cast<std::size_t>(static_cast<std::int64_t>(part[at]) - begin);
      wrong = wrong || seen[place];
      seen[place] = true;
      std::copy_n(part.begin() + static_cast<std::ptrdiff_t>(at + 1), columns_,
                  values_.begin() + static_cast<std::ptrdiff_t>(place * columns_));
    }
  }
  wrong = wrong || std::find(seen.begin(), seen.end(), false) != seen.end();
  if (ranks.any(wrong)) throw std::invalid_argument("the ids of a specimen's particles must be 0 .. N-1, each once");
}

std::vector<double> Directory::find(std::vector<int> const& ids) const {
  std::vector<std::vector<double>> asked(static_cast<std::size_t>(ranks_.count()));
  for (int const id : ids) asked[keeper(id)].push_back(id);
  std::vector<std::vector<double>> answers = ranks_.exchange(std::move(asked));
  std::int64_t const begin = block_ * ranks_.rank();
  for (auto& part : answers) {
    std::vector<double> numbers;
    numbers.reserve(part.size() * columns_);
    for (double const id : part) {
      auto const at = values_.begin() + (static_cast<std::int64_t>(id) - begin) * static_cast<std::int64_t>(columns_);
      numbers.insert(numbers.end(), at, at + static_cast<std::ptrdiff_t>(columns_));
    }
    part = std::move(numbers);
  }
  answers = ranks_.exchange(std::move(answers));
  std::vector<double> found;
  found.reserve(ids.size() * columns_);
  std::vector<std::size_t> next(answers.size(), 0);
  for (int const id : ids) {
    std::size_t const r = keeper(id);
    auto const at = answers[r].begin() + static_cast<std::ptrdiff_t>(next[r]);
    found.insert(found.end(), at, at + static_cast<std::ptrdiff_t>(columns_));
    next[r] += columns_;
  }
  return found;
}

}  // namespace clathra
