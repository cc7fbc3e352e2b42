#include "domain/ranks.hpp"

#include <cstdlib>

namespace clathra {

std::int64_t Ranks::sum_before(std::int64_t value) const {
  std::vector<std::int64_t> values(static_cast<std::size_t>(count()), 0);
  values[static_cast<std::size_t>(rank())] = value;
  sum(values.data(), count());
  std::int64_t before = 0;
  for (int r = 0; r < rank(); ++r) before += values[static_cast<std::size_t>(r)];
  return before;
}

std::vector<std::vector<double>> Ranks::exchange(std::vector<std::vector<double>> const& to) const {
  return communicator_ ? communicator_->exchange(to) : to;
}

std::vector<double> Ranks::gather(std::vector<double> const& values) const {
  if (alone()) return values;
  std::vector<std::vector<double>> to(static_cast<std::size_t>(count()));
  to[0] = values;
  std::vector<double> all;
  for (std::vector<double> const& part : exchange(to)) all.insert(all.end(), part.begin(), part.end());
  return all;
}

std::string Ranks::from_root(std::string text) const {
  std::uint64_t size = text.size();
  broadcast(&size, sizeof size, 0);
  text.resize(size);
  broadcast(text.data(), text.size(), 0);
  return text;
}

void Ranks::on_root(std::function<void()> const& action) const {
  std::exception_ptr problem;
  if (root()) {
    try {
      action();
    } catch (...) {
      problem = std::current_exception();
    }
  }
  bool const failed = any(problem != nullptr);
  if (problem) std::rethrow_exception(problem);
  if (failed) throw RootFailed();
}

void Ranks::abort(int code) const {
  if (communicator_) communicator_->abort(code);
  std::_Exit(code);
}

SumOverRanks Ranks::summation() const {
  if (alone()) return {};
  return [communicator = communicator_](std::int64_t* values, int size) { communicator->sum(values, size); };
}

int launched_ranks() {
  for (char const* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"}) {
    if (char const* const text = std::getenv(name)) return std::max(1, std::atoi(text));
  }
  return 1;
}

}  // namespace clathra
