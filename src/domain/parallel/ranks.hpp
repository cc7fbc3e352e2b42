#pragma once
/// The ranks (processes) that share a specimen, and what they tell each other. ranks_mpi.cpp is the only file that knows MPI.
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kernels/sum_over_ranks.hpp"

namespace clathra {

/// A part of a buffer that goes to a rank or comes from it.
struct BufferRange {
  int rank = 0;
  std::size_t begin = 0, size = 0;  ///< in numbers
};

/// What the layer below must be able to do. All calls but abort() are collective: every rank makes them, in the same order.
class Communicator {
 public:
  virtual ~Communicator() = default;
  virtual int rank() const = 0;
  virtual int count() const = 0;
  virtual void sum(std::int64_t* values, int size) const = 0;
  virtual void max(double* values, int size) const = 0;
  virtual void broadcast(void* bytes, std::size_t size, int from) const = 0;
  virtual std::vector<std::vector<double>> exchange(std::vector<std::vector<double>> to) const = 0;
  virtual void exchange_known(double const* send, std::vector<BufferRange> const& to, double* receive,
                              std::vector<BufferRange> const& from) const = 0;
  [[noreturn]] virtual void abort(int code) const = 0;
};

/// The ranks of a run, from the point of view of one of them. By default this rank is alone, and every call is trivial.
class Ranks {
 public:
  Ranks() = default;
  explicit Ranks(std::shared_ptr<Communicator const> communicator) : communicator_(std::move(communicator)) {}

  bool alone() const { return !communicator_; }
  int rank() const { return communicator_ ? communicator_->rank() : 0; }
  int count() const { return communicator_ ? communicator_->count() : 1; }
  bool root() const { return rank() == 0; }

  /// Replaces values by their sums over the ranks.
  void sum(std::int64_t* values, int size) const {
    if (communicator_) communicator_->sum(values, size);
  }
  std::int64_t sum(std::int64_t value) const {
    sum(&value, 1);
    return value;
  }
  double max(double value) const {
    if (communicator_) communicator_->max(&value, 1);
    return value;
  }
  void max(double* values, int size) const {
    if (communicator_) communicator_->max(values, size);
  }
  double min(double value) const { return -max(-value); }
  bool any(bool value) const { return max(value ? 1.0 : 0.0) > 0; }
  void broadcast(void* bytes, std::size_t size, int from) const {
    if (communicator_) communicator_->broadcast(bytes, size, from);
  }
  /// The sum of the values of the ranks before this one.
  std::int64_t sum_before(std::int64_t value) const;
  /// to[r] goes to rank r; @return what came from each rank
  std::vector<std::vector<double>> exchange(std::vector<std::vector<double>> to) const;
  /// Numbers of agreed sizes between neighbours.
  void exchange_known(double const* send, std::vector<BufferRange> const& to, double* receive,
                      std::vector<BufferRange> const& from) const {
    if (communicator_) communicator_->exchange_known(send, to, receive, from);
  }
  /// All ranks' values on rank 0, in the order of the ranks; nothing elsewhere.
  std::vector<double> gather(std::vector<double> const& values) const;
  /// A number that passes through the hands of all ranks in their order: what one makes of it goes to the next. @return the last
  double sequential_fold(double value, std::function<double(double)> const& hand) const;
  /// This rank's part of all ranks' values in ascending order, the parts in the order of the ranks.
  std::vector<double> sorted_part(std::vector<double> const& values) const;
  /// The text of rank 0.
  std::string from_root(std::string text) const;
  /// Ends all ranks at once. For faults of one rank that the others cannot know of.
  [[noreturn]] void abort(int code) const;
  /// For exact_sums(); empty where there is one rank only.
  SumOverRanks summation() const;

 private:
  std::shared_ptr<Communicator const> communicator_;
};

/// Message passing from here to the end of the scope. One rank, alone and without any message passing, where the program was not
/// started by a launcher (mpirun, srun) or was built without MPI.
class RankSession {
 public:
  RankSession();
  ~RankSession();
  RankSession(RankSession const&) = delete;
  RankSession& operator=(RankSession const&) = delete;
  Ranks const& ranks() const { return ranks_; }

 private:
  Ranks ranks_;
};

/// What a launcher says of the processes that it started: their number, that of those on this machine, and which this one is; 1,
/// 1 and 0 without one. Asks the environment, starts nothing.
int launched_ranks();
int launched_ranks_here();
int launched_rank();
/// The ranks on a node, of a list as Slurm writes it: "2(x3),1" is 2, 2, 2, 1. 0 where it cannot be read.
int ranks_on_node(std::string_view list, int node);
/// "Open MPI 4.1.4", or "none".
std::string message_passing_name();

}  // namespace clathra
