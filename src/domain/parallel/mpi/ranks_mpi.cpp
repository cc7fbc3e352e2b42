/// Ranks over MPI.
#include <mpi.h>

#include <cstdlib>
#include <limits>
#include <stdexcept>

#include "domain/parallel/ranks.hpp"

namespace clathra {
namespace {

int as_count(std::size_t size) {
  if (size > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw std::runtime_error("more than 2^31 numbers for one rank: use more ranks");
  return static_cast<int>(size);
}

/// MPI's world. MPI ends the program itself where one of its calls fails.
class World : public Communicator {
 public:
  World() {
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &count_);
  }
  int rank() const override { return rank_; }
  int count() const override { return count_; }
  void sum(std::int64_t* values, int size) const override {
    MPI_Allreduce(MPI_IN_PLACE, values, size, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
  }
  void max(double* values, int size) const override {
    MPI_Allreduce(MPI_IN_PLACE, values, size, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  }
  void broadcast(void* bytes, std::size_t size, int from) const override {
    MPI_Bcast(bytes, as_count(size), MPI_BYTE, from, MPI_COMM_WORLD);
  }

  std::vector<std::vector<double>> exchange(std::vector<std::vector<double>> to) const override {
    auto const ranks = static_cast<std::size_t>(count_);
    std::vector<int> sent(ranks), received(ranks);
    for (std::size_t r = 0; r < ranks; ++r) sent[r] = as_count(to[r].size());
    MPI_Alltoall(sent.data(), 1, MPI_INT, received.data(), 1, MPI_INT, MPI_COMM_WORLD);
    std::vector<std::vector<double>> from(ranks);
    std::vector<MPI_Request> requests;
    for (int r = 0; r < count_; ++r) {
      auto const at = static_cast<std::size_t>(r);
      from[at].resize(static_cast<std::size_t>(received[at]));
      if (received[at] == 0 || r == rank_) continue;
      MPI_Irecv(from[at].data(), received[at], MPI_DOUBLE, r, 1, MPI_COMM_WORLD, &requests.emplace_back());
    }
    for (int r = 0; r < count_; ++r) {
      auto const at = static_cast<std::size_t>(r);
      if (sent[at] == 0 || r == rank_) continue;
      MPI_Isend(to[at].data(), sent[at], MPI_DOUBLE, r, 1, MPI_COMM_WORLD, &requests.emplace_back());
    }
    from[static_cast<std::size_t>(rank_)] = std::move(to[static_cast<std::size_t>(rank_)]);
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
    return from;
  }

  void exchange_known(double const* send, std::vector<BufferRange> const& to, double* receive,
                      std::vector<BufferRange> const& from) const override {
    std::vector<MPI_Request> requests;
    requests.reserve(to.size() + from.size());
    for (BufferRange const& s : from)
      MPI_Irecv(receive + s.begin, as_count(s.size), MPI_DOUBLE, s.rank, 2, MPI_COMM_WORLD, &requests.emplace_back());
    for (BufferRange const& s : to)
      MPI_Isend(send + s.begin, as_count(s.size), MPI_DOUBLE, s.rank, 2, MPI_COMM_WORLD, &requests.emplace_back());
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  }

  void abort(int code) const override {
    MPI_Abort(MPI_COMM_WORLD, code);
    std::_Exit(code);
  }

 private:
  int rank_ = 0, count_ = 1;
};

}  // namespace

RankSession::RankSession() {
  if (launched_ranks() < 2) return;
  // A collective-buffering component of Open MPI 4.1 corrupts files (upstream issue); the others do not.
  ::setenv("OMPI_MCA_fcoll", "^vulcan", 0);
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  auto const world = std::make_shared<World>();
  if (world->count() > 1) ranks_ = Ranks(world);
}

RankSession::~RankSession() {
  int initialised = 0;
  MPI_Initialized(&initialised);
  if (initialised) MPI_Finalize();
}

std::string message_passing_name() {
  char text[MPI_MAX_LIBRARY_VERSION_STRING];
  int length = 0;
  MPI_Get_library_version(text, &length);
  std::string const name(text, static_cast<std::size_t>(length));
  return name.substr(0, name.find(','));
}

}  // namespace clathra
