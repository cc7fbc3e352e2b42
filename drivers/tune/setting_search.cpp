#include "tune/setting_search.hpp"

#include <algorithm>
#include <cmath>

namespace clathra {

SettingSearch::SettingSearch(double tolerance, std::vector<Trial> trials) : tolerance_(tolerance), trials_(std::move(trials)) {
  for (std::size_t i = 0; i < trials_.size(); ++i)
    if (trials_[i].on_ladder) ladder_.push_back(i);
  std::sort(ladder_.begin(), ladder_.end(), [this](auto a, auto b) { return trials_[a].rate > trials_[b].rate; });
  slowest_ = std::min(first_levels, ladder_.size()) - 1;
}

ErrorVerdict SettingSearch::verdict(std::size_t trial) const {
  if (trials_[trial].failed) return ErrorVerdict::outside;
  std::optional<SettingError> const found = error(trial);
  return found ? verdict_on(*found, tolerance_) : ErrorVerdict::open;
}

void SettingSearch::leave_out_slowest() {
  ladder_.resize(slowest_);
  --slowest_;
}

void SettingSearch::stop_growing() {
  growing_ = false;
  while (slowest_ >= first_levels && 2 * trials_[slow()].values.size() < trials_[fast()].values.size()) leave_out_slowest();
}

std::optional<RunRequest> SettingSearch::next() {
  choice_.reset();
  while (slowest_ >= first_levels && trials_[slow()].failed) leave_out_slowest();
  if (trials_of_limit_failed()) return {};
  if (seeds() == 0)
    return RunRequest{{ladder_.begin(), ladder_.begin() + static_cast<std::ptrdiff_t>(slowest_) + 1}, first_seeds};
  if (trials_[fast()].values.empty()) return {};
  for (std::size_t place = 0; place <= slowest_; ++place) {
    std::size_t const level = ladder_[place];
    ErrorVerdict const verdict_here = verdict(level);
    if (verdict_here == ErrorVerdict::within) return choose(level);
    if (verdict_here == ErrorVerdict::outside) continue;
    if (std::optional<RunRequest> request = more_seeds(level)) return request;
    // Where the slowest rate's own error hides the answer, a slower one shows it.
    std::optional<SettingError> const found = error(level);
    constexpr double small = 0.1;  // of the tolerance
    if (found && std::fabs(found->error) <= tolerance_ && std::fabs(found->remainder) > small * tolerance_)
      if (std::optional<RunRequest> request = slower_level()) return request;
  }
  return slower_level();
}

std::optional<RunRequest> SettingSearch::more_seeds(std::size_t trial) const {
  if (!growing_) return {};
  std::optional<SettingError> const found = error(trial);
  if (!found && trials_[trial].values.size() < 2 && seeds() > 1) return RunRequest{{trial}, seeds()};  // it was tried with one
  std::optional<int> const needed = found ? seeds_needed(*found, tolerance_) : std::nullopt;
  if (!needed || *needed > most_seeds) return {};
  int const now = std::min(seeds(), found->seeds);
  return RunRequest{{fast(), slow(), trial}, std::min(most_seeds, std::clamp(*needed, now + 1, now + std::max(2, now / 2)))};
}

std::optional<RunRequest> SettingSearch::slower_level() {
  if (!growing_ || slowest_ + 1 == ladder_.size()) return {};
  ++slowest_;
  return RunRequest{{slow()}, static_cast<int>(trials_[fast()].values.size())};
}

/// All that is run at a rate, cheapest first, or the wish to run what has not been.
std::optional<RunRequest> SettingSearch::numerics_at(double rate, std::vector<std::size_t>& candidates) const {
  RunRequest request;
  for (std::size_t i = 0; i < trials_.size(); ++i) {
    if (trials_[i].rate != rate) continue;
    candidates.push_back(i);
    if (trials_[i].values.empty() && !trials_[i].failed) request.trials.push_back(i);
  }
  std::stable_sort(candidates.begin(), candidates.end(), [this](auto a, auto b) { return trials_[a].cost < trials_[b].cost; });
  request.seeds = seeds();
  return request.trials.empty() ? std::nullopt : std::optional(request);
}

std::optional<RunRequest> SettingSearch::choose(std::size_t level) {
  choice_ = level;
  std::vector<std::size_t> candidates;
  if (std::optional<RunRequest> request = numerics_at(trials_[level].rate, candidates)) return request;
  for (std::size_t const trial : candidates) {
    ErrorVerdict const verdict_here = verdict(trial);
    if (verdict_here == ErrorVerdict::open)
      if (std::optional<RunRequest> request = more_seeds(trial)) return request;
    if (verdict_here == ErrorVerdict::within) {
      choice_ = trial;
      break;
    }
  }
  return confirm(*choice_);
}

std::optional<RunRequest> SettingSearch::confirm(std::size_t trial) {
  int const now = seeds();
  bool const again = last_analysis_ && last_analysis_->first == trial && last_analysis_->second < now;
  if (again || !growing_ || now >= most_seeds) return {};
  last_analysis_ = {trial, now};
  return RunRequest{{fast(), slow(), trial}, std::min(most_seeds, now + std::max(1, now / 4))};
}

std::optional<std::pair<std::size_t, int>> SettingSearch::undecided() const {
  if (seeds() == 0) return {};
  for (std::size_t place = 0; place <= slowest_; ++place) {
    std::size_t const level = ladder_[place];
    std::optional<SettingError> const found = error(level);
    if (!found || verdict(level) != ErrorVerdict::open) continue;
    if (std::optional<int> const needed = seeds_needed(*found, tolerance_)) return std::pair(level, *needed);
  }
  return {};
}

}  // namespace clathra
