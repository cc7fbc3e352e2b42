#pragma once
/// Where discs are stored, by id.
#include <algorithm>
#include <utility>
#include <vector>

namespace clathra {

/// Indices of discs by id.
class IdIndex {
 public:
  template <class Ids>
  IdIndex(Ids const& id, int discs) {
    for (int i = 0; i < discs; ++i) sorted_.emplace_back(id(i), i);
    std::sort(sorted_.begin(), sorted_.end());
  }
  /// -1 where there is no such disc.
  int find(int id) const {
    auto const at = std::lower_bound(sorted_.begin(), sorted_.end(), std::pair{id, -1});
    return at != sorted_.end() && at->first == id ? at->second : -1;
  }
  auto const& sorted() const { return sorted_; }

 private:
  std::vector<std::pair<int, int>> sorted_;  // (id, index)
};

}  // namespace clathra
