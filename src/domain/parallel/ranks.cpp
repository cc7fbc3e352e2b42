#include "domain/parallel/ranks.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <initializer_list>
#include <utility>

namespace clathra {

std::int64_t Ranks::sum_before(std::int64_t value) const {
  std::vector<std::int64_t> values(static_cast<std::size_t>(count()), 0);
  values[static_cast<std::size_t>(rank())] = value;
  sum(values.data(), count());
  std::int64_t before = 0;
  for (int r = 0; r < rank(); ++r) before += values[static_cast<std::size_t>(r)];
  return before;
}

std::vector<std::vector<double>> Ranks::exchange(std::vector<std::vector<double>> to) const {
  return communicator_ ? communicator_->exchange(std::move(to)) : std::move(to);
}

std::vector<double> Ranks::gather(std::vector<double> const& values) const {
  if (alone()) return values;
  std::vector<std::vector<double>> to(static_cast<std::size_t>(count()));
  to[0] = values;
  std::vector<double> all;
  for (std::vector<double> const& part : exchange(std::move(to))) all.insert(all.end(), part.begin(), part.end());
  return all;
}

double Ranks::sequential_fold(double value, std::function<double(double)> const& hand) const {
  for (int r = 0; r < count(); ++r) {
    if (r == rank()) value = hand(value);
    broadcast(&value, sizeof value, r);
  }
  return value;
}

std::vector<double> Ranks::sorted_part(std::vector<double> const& values) const {
  std::vector<double> part = values;
  if (!alone()) {
    // Equal numbers of values a rank, as far as a histogram tells them apart.
    constexpr int bins = 4096;
    double const least = values.empty() ? 1e300 : *std::min_element(values.begin(), values.end()),
                 most = values.empty() ? -1e300 : *std::max_element(values.begin(), values.end());
    double const low = min(least), width = std::max((max(most) - low) / bins, 1e-300);
    auto const bin_of = [&](double v) { return static_cast<std::size_t>(std::min((v - low) / width, bins - 1.0)); };
    std::vector<std::int64_t> tally(bins, 0);
    for (double const v : values) ++tally[bin_of(v)];
    sum(tally.data(), bins);
    std::int64_t total = 0, below = 0;
    for (std::int64_t const n : tally) total += n;
    std::vector<std::size_t> owner(bins);
    for (std::size_t b = 0; b < bins; ++b) {
      owner[b] =
          static_cast<std::size_t>(std::min<std::int64_t>(below * count() / std::max<std::int64_t>(total, 1), count() - 1));
      below += tally[b];
    }
    std::vector<std::vector<double>> to(static_cast<std::size_t>(count()));
    for (double const v : values) to[owner[bin_of(v)]].push_back(v);
    part.clear();
    for (auto const& from : exchange(std::move(to))) part.insert(part.end(), from.begin(), from.end());
  }
  std::sort(part.begin(), part.end());
  return part;
}

std::string Ranks::from_root(std::string text) const {
  std::uint64_t size = text.size();
  broadcast(&size, sizeof size, 0);
  text.resize(size);
  broadcast(text.data(), text.size(), 0);
  return text;
}

void Ranks::abort(int code) const {
  if (communicator_) communicator_->abort(code);
  std::_Exit(code);
}

SumOverRanks Ranks::summation() const {
  if (alone()) return {};
  return [communicator = communicator_](std::int64_t* values, int size) { communicator->sum(values, size); };
}

namespace {

/// The first of these variables that is set, as a number.
int from_environment(std::initializer_list<char const*> names, int without) {
  for (char const* const name : names) {
    if (char const* const text = std::getenv(name)) return std::atoi(text);
  }
  return without;
}

}  // namespace

int launched_ranks() { return std::max(1, from_environment({"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"}, 1)); }
int ranks_on_node(std::string_view list, int node) {
  for (int begin = 0; !list.empty();) {
    int ranks = 0, nodes = 1;
    char const* const end = list.data() + list.size();
    auto at = std::from_chars(list.data(), end, ranks);
    if (at.ec != std::errc()) return 0;
    if (end - at.ptr > 2 && at.ptr[0] == '(' && at.ptr[1] == 'x') at = std::from_chars(at.ptr + 2, end, nodes);
    begin += nodes;
    if (node < begin) return ranks;
    std::size_t const comma = list.find(',');
    list.remove_prefix(comma == list.npos ? list.size() : comma + 1);
  }
  return 0;
}

int launched_ranks_here() {
  int here = from_environment({"OMPI_COMM_WORLD_LOCAL_SIZE", "MPI_LOCALNRANKS"}, 0);
  if (char const* const tasks = std::getenv("SLURM_STEP_TASKS_PER_NODE"); here == 0 && tasks)
    here = ranks_on_node(tasks, from_environment({"SLURM_NODEID"}, 0));
  return here > 0 ? here : launched_ranks();
}
int launched_rank() { return from_environment({"OMPI_COMM_WORLD_RANK", "PMI_RANK", "SLURM_PROCID"}, 0); }

}  // namespace clathra
