#pragma once
/// Numbers of discs that other ranks own, found by id: each rank keeps those of one block of ids.
///
/// A list of all ids on every rank would be simpler, and the first thing that does not fit when the specimen grows.
#include <vector>

#include "domain/parallel/ranks.hpp"

namespace clathra {

class Directory {
 public:
  /// @param total  ids are 0 .. total-1, each on one rank
  /// @param ids  of this rank's discs;  @param columns  their numbers, column by column
  /// @throws std::invalid_argument on every rank where an id is missing, out of range or given twice
  Directory(Ranks const& ranks, std::int64_t total, std::vector<int> const& ids, std::vector<std::vector<double>> const& columns);

  /// The numbers of discs, whoever owns them: those of ids[k] begin at k * columns. Collective.
  std::vector<double> find(std::vector<int> const& ids) const;
  /// sum(column) in the order of the ids, so that it does not depend on who owns what. Collective.
  template <class Term>
  double sum_by_id(Term const& term) const {
    return ranks_.sequential_fold(0, [&](double sum) {
      for (std::size_t at = 0; at < values_.size(); at += columns_) sum += term(&values_[at]);
      return sum;
    });
  }

 private:
  std::size_t keeper(int id) const { return static_cast<std::size_t>(id / block_); }

  Ranks ranks_;
  std::int64_t block_;  // ids that a rank keeps
  std::size_t columns_;
  std::vector<double> values_;  // of the block, id by id
};

}  // namespace clathra
