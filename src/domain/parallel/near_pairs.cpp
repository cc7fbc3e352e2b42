#include "domain/parallel/near_pairs.hpp"

#include <iterator>
#include <utility>

namespace clathra {

Specimen with_halo(Ranks const& ranks, Specimen const& share, double reach) {
  Specimen s;
  s.id = share.id;
  s.x = share.x;
  s.y = share.y;
  s.radius = share.radius;
  s.d50 = share.d50;
  if (ranks.alone()) return s;
  double box[4] = {1e300, -1e300, 1e300, -1e300}, widest = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    box[0] = std::min(box[0], s.x[i]);
    box[1] = std::max(box[1], s.x[i]);
    box[2] = std::min(box[2], s.y[i]);
    box[3] = std::max(box[3], s.y[i]);
    widest = std::max(widest, 2 * s.radius[i]);
  }
  double const far = ranks.max(widest) + std::max(reach, 0.0);
  std::vector<double> boxes(4 * static_cast<std::size_t>(ranks.count()), -1e300);
  for (std::size_t k = 0; k < 4; ++k) boxes[4 * static_cast<std::size_t>(ranks.rank()) + k] = k % 2 == 0 ? -box[k] : box[k];
  ranks.max(boxes.data(), static_cast<int>(boxes.size()));
  std::vector<std::vector<double>> to(static_cast<std::size_t>(ranks.count()));
  for (std::size_t r = 0; r < to.size(); ++r) {
    if (static_cast<int>(r) == ranks.rank()) continue;
    double const* const b = &boxes[4 * r];
    for (std::size_t i = 0; i < share.size(); ++i) {
      bool const near = s.x[i] > -b[0] - far && s.x[i] < b[1] + far && s.y[i] > -b[2] - far && s.y[i] < b[3] + far;
      if (near) to[r].insert(to[r].end(), {double(s.id[i]), s.x[i], s.y[i], s.radius[i]});
    }
  }
  for (auto const& part : ranks.exchange(std::move(to))) {
    for (std::size_t k = 0; k < part.size(); k += 4) {
      s.id.push_back(static_cast<int>(part[k]));
      s.x.push_back(part[k + 1]);
      s.y.push_back(part[k + 2]);
      s.radius.push_back(part[k + 3]);
    }
  }
  return s;
}

CellsOfDiscs::CellsOfDiscs(Specimen const& s, double largest, double reach) : largest_(largest) {
  double const size = 2 * largest + std::max(reach, 0.0);
  auto const index = [&](double at) { return static_cast<std::int64_t>(std::clamp(std::floor(at / size), -1e18, 1e18)); };
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (s.radius[i] > largest) continue;
    all_.push_back({index(s.y[i]), index(s.x[i]), i});
    if (!is_large(s, i)) next_radius_ = std::max(next_radius_, s.radius[i]);
  }
  std::sort(all_.begin(), all_.end(),
            [](Entry const& p, Entry const& q) { return std::tie(p.row, p.column) < std::tie(q.row, q.column); });
  std::copy_if(all_.begin(), all_.end(), std::back_inserter(large_), [&](Entry const& e) { return is_large(s, e.disc); });
}

std::vector<NearPair> near_pairs(Specimen const& s, std::size_t own, double reach) {
  std::vector<NearPair> pairs;
  for_each_near_pair(s, own, reach, [&](NearPair const& pair) { pairs.push_back(pair); });
  std::sort(pairs.begin(), pairs.end(), [&](NearPair const& p, NearPair const& q) {
    return std::tie(s.id[p.a], s.id[p.b]) < std::tie(s.id[q.a], s.id[q.b]);
  });
  return pairs;
}

}  // namespace clathra
