#include "domain/measurement/setting_search.hpp"

#include <algorithm>
#include <cmath>

namespace clathra {

SettingSearch::SettingSearch(double tolerance, std::vector<Trial> trials) : tolerance_(tolerance), trials_(std::move(trials)) {
  for (std::size_t i = 0; i < trials_.size(); ++i)
    if (trials_[i].on_ladder) ladder_.push_back(i);
  std::sort(ladder_.begin(), ladder_.end(), [this](auto a, auto b) { return trials_[a].rate > trials_[b].rate; });
  slowest_ = std::min(first_rungs, ladder_.size()) - 1;
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
  while (slowest_ >= first_rungs && 2 * trials_[slow()].values.size() < trials_[fast()].values.size()) leave_out_slowest();
}

std::optional<Wish> SettingSearch::next() {
  choice_.reset();
  while (slowest_ >= first_rungs && trials_[slow()].failed) leave_out_slowest();
  if (trials_of_limit_failed()) return {};
  if (seeds() == 0) return Wish{{ladder_.begin(), ladder_.begin() + static_cast<std::ptrdiff_t>(slowest_) + 1}, first_seeds};
  if (trials_[fast()].values.empty()) return {};
  for (std::size_t place = 0; place <= slowest_; ++place) {
    std::size_t const rung = ladder_[place];
    ErrorVerdict const verdict_here = verdict(rung);
    if (verdict_here == ErrorVerdict::within) return choose(rung);
    if (verdict_here == ErrorVerdict::outside) continue;
    if (std::optional<Wish> wish = more_seeds(rung)) return wish;
    // Where the slowest rate's own error hides the answer, a slower one shows it.
    std::optional<SettingError> const found = error(rung);
    constexpr double small = 0.1;  // of the tolerance
    if (found && std::fabs(found->error) <= tolerance_ && std::fabs(found->remainder) > small * tolerance_)
      if (std::optional<Wish> wish = slower_rung()) return wish;
  }
  return slower_rung();
}

std::optional<Wish> SettingSearch::more_seeds(std::size_t trial) const {
  if (!growing_) return {};
  std::optional<SettingError> const found = error(trial);
  if (!found && trials_[trial].values.size() < 2 && seeds() > 1) return Wish{{trial}, seeds()};  // it was tried with one
  std::optional<int> const needed = found ? seeds_needed(*found, tolerance_) : std::nullopt;
  if (!needed || *needed > most_seeds) return {};
  int const now = std::min(seeds(), found->seeds);
  return Wish{{fast(), slow(), trial}, std::min(most_seeds, std::clamp(*needed, now + 1, now + std::max(2, now / 2)))};
}

std::optional<Wish> SettingSearch::slower_rung() {
  if (!growing_ || slowest_ + 1 == ladder_.size()) return {};
  ++slowest_;
  return Wish{{slow()}, static_cast<int>(trials_[fast()].values.size())};
}

/// All that is run at a rate, cheapest first, or the wish to run what has not been.
std::optional<Wish> SettingSearch::numerics_at(double rate, std::vector<std::size_t>& candidates) const {
  Wish wish;
  for (std::size_t i = 0; i < trials_.size(); ++i) {
    if (trials_[i].rate != rate) continue;
    candidates.push_back(i);
    if (trials_[i].values.empty() && !trials_[i].failed) wish.trials.push_back(i);
  }
  std::stable_sort(candidates.begin(), candidates.end(), [this](auto a, auto b) { return trials_[a].cost < trials_[b].cost; });
  wish.seeds = seeds();
  return wish.trials.empty() ? std::nullopt : std::optional(wish);
}

std::optional<Wish> SettingSearch::choose(std::size_t rung) {
  choice_ = rung;
  std::vector<std::size_t> candidates;
  if (std::optional<Wish> wish = numerics_at(trials_[rung].rate, candidates)) return wish;
  for (std::size_t const trial : candidates) {
    ErrorVerdict const verdict_here = verdict(trial);
    if (verdict_here == ErrorVerdict::open)
      if (std::optional<Wish> wish = more_seeds(trial)) return wish;
    if (verdict_here == ErrorVerdict::within) {
      choice_ = trial;
      break;
    }
  }
  return confirm(*choice_);
}

std::optional<Wish> SettingSearch::confirm(std::size_t trial) {
  int const now = seeds();
  bool const again = looked_at_ && looked_at_->first == trial && looked_at_->second < now;
  if (again || !growing_ || now >= most_seeds) return {};
  looked_at_ = {trial, now};
  return Wish{{fast(), slow(), trial}, std::min(most_seeds, now + std::max(1, now / 4))};
}

std::optional<std::pair<std::size_t, int>> SettingSearch::undecided() const {
  if (seeds() == 0) return {};
  for (std::size_t place = 0; place <= slowest_; ++place) {
    std::size_t const rung = ladder_[place];
    std::optional<SettingError> const found = error(rung);
    if (!found || verdict(rung) != ErrorVerdict::open) continue;
    if (std::optional<int> const needed = seeds_needed(*found, tolerance_)) return std::pair(rung, *needed);
  }
  return {};
}

}  // namespace clathra
