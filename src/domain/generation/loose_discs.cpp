#include "domain/generation/loose_discs.hpp"

#include <algorithm>
#include <utility>

#include "domain/generation/random.hpp"
#include "kernels/real.hpp"

namespace clathra {

namespace {

// What random numbers are drawn for; to these the number of the patch or of the group of sizes is added.
constexpr std::uint64_t of_order = 1'000'000'000, of_dealing = 2'000'000'000, of_places = 0;

double area(std::vector<double> const& radii) {
  double sum = 0;
  for (double const r : radii) sum += pi * r * r;
  return sum;
}

/// Adds placed discs, at rest, numbered from `first_id` on.
void add_discs(Specimen& specimen, std::int64_t first_id, std::vector<double> const& radii, Placement const& places) {
  for (std::size_t i = 0; i < radii.size(); ++i) {
    specimen.id.push_back(static_cast<int>(first_id) + static_cast<int>(i));
    specimen.x.push_back(places.x[i]);
    specimen.y.push_back(places.y[i]);
    specimen.radius.push_back(radii[i]);
    for (auto* field : {&specimen.angle, &specimen.vx, &specimen.vy, &specimen.omega}) field->push_back(0);
  }
}

}  // namespace

LooseDiscs::LooseDiscs(Grading const& grading, std::int64_t particles, int layers, std::uint64_t seed)
    : layers_(layers),
      patches_in_layer_((particles / layers + most_in_patch - 1) / most_in_patch),
      seed_(seed),
      sizes_(grading.diameters(static_cast<std::size_t>(particles))) {}

std::int64_t LooseDiscs::discs_before(std::int64_t patch) const {
  auto const discs = static_cast<std::int64_t>(sizes_.size());
  return patch * (discs / patches()) + std::min(patch, discs % patches());
}

std::vector<double> LooseDiscs::radii(std::int64_t patch) const {
  std::int64_t const count = discs_before(patch + 1) - discs_before(patch), of_all = patches(),
                     whole_groups = static_cast<std::int64_t>(sizes_.size()) / of_all;
  std::vector<double> radii(static_cast<std::size_t>(count));
  for (std::int64_t group = 0; group < count; ++group) {
    // The sizes that are left over go to the first patches.
    auto const turn = static_cast<std::int64_t>(uniform_random(seed_, of_dealing, static_cast<std::uint64_t>(group)) *
                                                static_cast<double>(of_all));
    std::int64_t const place = group < whole_groups ? (patch + turn) % of_all : patch;
    radii[static_cast<std::size_t>(group)] = 0.5 * sizes_[static_cast<std::size_t>(group * of_all + place)];
  }
  shuffle(radii, seed_, of_order + static_cast<std::uint64_t>(patch));
  return radii;
}

double LooseDiscs::solid_area(int layer) const {
  double sum = 0;
  for (std::int64_t patch = layer * patches_in_layer_; patch < (layer + 1) * patches_in_layer_; ++patch)
    sum += area(radii(patch));
  return sum;
}

/// Patches of even number in a layer may reach over their sides; the others make room for these. Nothing where a disc finds no
/// place.
std::optional<Placement> LooseDiscs::placed(std::int64_t patch, std::vector<double> const& radii, Specimen const& specimen,
                                            double from, double height) const {
  std::int64_t const in_layer = patch % patches_in_layer_;
  double const width = specimen.width() / static_cast<double>(patches_in_layer_);
  Region region{specimen.left + static_cast<double>(in_layer) * width, from, width, height};
  region.open_left = in_layer > 0;
  region.open_right = in_layer + 1 < patches_in_layer_;
  std::vector<PlacedDisc> around;
  auto const add_beside = [&](std::int64_t beside) {
    std::vector<double> const others = this->radii(beside);
    std::optional<Placement> const there = placed(beside, others, specimen, from, height);
    for (std::size_t i = 0; there && i < others.size(); ++i) around.push_back({there->x[i], there->y[i], others[i]});
    return there.has_value();
  };
  if (in_layer % 2 == 1) {
    if (!add_beside(patch - 1)) return {};
    if (region.open_right && !add_beside(patch + 1)) return {};
  }
  return place_by_random_addition(radii, region, seed_, of_places + static_cast<std::uint64_t>(patch), around);
}

void LooseDiscs::add_layer(Specimen& specimen, int layer, double from, Ranks const& ranks) const {
  std::int64_t const first = layer * patches_in_layer_;
  double height = solid_area(layer) / loose_solid_fraction / specimen.width();
  std::vector<std::pair<std::int64_t, Placement>> places;
  for (bool found = false; !found;) {
    places.clear();
    found = true;
    for (std::int64_t patch = first + ranks.rank(); found && patch < first + patches_in_layer_; patch += ranks.count()) {
      std::optional<Placement> there = placed(patch, radii(patch), specimen, from, height);
      found = there.has_value();
      if (found) places.emplace_back(patch, std::move(*there));
    }
    found = !ranks.any(!found);
    if (!found) height /= looser;
  }
  for (auto const& [patch, there] : places) add_discs(specimen, discs_before(patch), radii(patch), there);
  specimen.top = from + height;
}

}  // namespace clathra
