#include "domain/scene/specimen_design.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <stdexcept>

#include "domain/scene/hydrate.hpp"
#include "kernels/countable.hpp"

namespace clathra {

SpecimenDesign design_sample(Scene const& scene) {
  SpecimenScene const& s = scene.specimen;
  SpecimenDesign design;
  design.grading = Grading::of(scene.grading);
  bool const box = s.width > 0 && s.height > 0;
  if (s.particles <= 0 && !box) throw std::invalid_argument("[specimen] needs 'particles' or a box ('width' and 'height')");
  if (s.particles > 0 && box && s.void_ratio > 0 && scene.grading.d50 > 0) {
    throw std::invalid_argument(
        "[specimen] particles, box and void_ratio together fix the grading's d50: leave one of the four out");
  }
  double const disc = design.grading.mean_disc_area();
  design.particles = s.particles;
  design.void_ratio = s.void_ratio > 0 ? s.void_ratio : 0.24;
  design.width = s.width;
  design.height = s.height;
  if (!box) {
    double const area = static_cast<double>(s.particles) * disc * (1 + design.void_ratio);
    if (s.width > 0)
      design.height = area / s.width;
    else if (s.height > 0)
      design.width = area / s.height;
    else {
      design.width = std::sqrt(area / s.aspect_ratio);
      design.height = area / design.width;
    }
  } else if (s.particles <= 0) {
    design.particles = std::llround(s.width * s.height / ((1 + design.void_ratio) * disc));
  } else if (s.void_ratio <= 0) {
    design.void_ratio = s.width * s.height / (static_cast<double>(s.particles) * disc) - 1;
    if (design.void_ratio <= 0.15)
      throw std::invalid_argument("[specimen] " + std::to_string(s.particles) +
                                  " particles of this grading do not fit the box: void ratio " +
                                  std::to_string(design.void_ratio));
  } else {
    design.grading =
        design.grading.scaled(std::sqrt(s.width * s.height / ((1 + s.void_ratio) * static_cast<double>(s.particles) * disc)));
  }
  return design;
}

int compaction_layers(Scene const& scene, SpecimenDesign const& design) {
  constexpr std::int64_t fewest_discs = 50;
  std::int64_t const by_height = static_cast<std::int64_t>(design.height / design.grading.largest());
  std::int64_t const most = std::min(design.particles / fewest_discs, by_height);
  return static_cast<int>(std::clamp<std::int64_t>(most, 1, scene.specimen.compaction_layers));
}

double reach_of_bonds(Scene const& scene, double d50) {
  if (!has_bonds(scene)) return 0;
  return scene.bond.critical_thickness_from == CriticalThicknessFrom::given
             ? scene.bond.critical_thickness
             : critical_thickness_ratio(scene.hydrate.saturation) * d50;
}

namespace {

constexpr double second_ring = 1.46, solid = 0.84;  // where the second ring begins; share of it that discs can fill

/// Discs of radius 1 that touch one of radius `ratio`.
double in_touch(double ratio) { return std::numbers::pi / std::asin(1 / (ratio + 1)); }

/// Discs of radius 1 around one of radius `ratio`.
double most_neighbours(double ratio, double reach) {
  double const inner = ratio + 1 + second_ring, outer = ratio + 1 + std::max(reach, second_ring);
  return in_touch(ratio) + solid * (outer * outer - inner * inner);
}

}  // namespace

double most_neighbours(Grading const& grading, double reach) {
  return most_neighbours(grading.largest() / grading.smallest(), 2 * reach / grading.smallest());
}

double reach_of_a_full_row(double ratio) {
  double const inner = ratio + 1 + second_ring, left = std::max(0.0, longest_row - in_touch(ratio));
  return std::sqrt(inner * inner + left / solid) - ratio - 1;
}

std::string crowding(double smallest, double largest, double reach) {
  double fits = 1, ratio = largest / smallest;
  if (most_neighbours(ratio, 2 * reach / smallest) <= longest_row) return {};
  double const given = ratio;
  for (int n = 0; n < 60; ++n) {
    double const middle = 0.5 * (fits + ratio);
    (most_neighbours(middle, 2 * reach * middle / largest) <= longest_row ? fits : ratio) = middle;
  }
  char text[240];
  std::snprintf(text, sizeof text,
                "the largest grain is %.3g times the smallest (%.4g mm), around it may lie more neighbours than the %d that a "
                "particle can have: of this curve the ratio may be %.3g at most",
                given, smallest * 1e3, longest_row, std::floor(10 * fits) / 10);
  return text;
}

std::string wide_skin(Grading const& grading, double skin) {
  if (skin == 0 || most_neighbours(grading, skin) <= longest_row) return {};
  double const fits = 0.5 * grading.smallest() * reach_of_a_full_row(grading.largest() / grading.smallest());
  double const digit = std::pow(10, std::floor(std::log10(fits)) - 2), most = digit * std::floor(fits / digit);
  char text[240];
  std::snprintf(
      text, sizeof text,
      "within %.4g mm of a grain there may be more neighbours than the %d that a particle can have; of this grading the skin "
      "may be %.3g mm at most, and is best left out",
      skin * 1e3, longest_row, most * 1e3);
  return text;
}

std::string far_void_ratio(Scene const& scene, SpecimenDesign const& design) {
  // Rests of 100 to 3,000 grains under 50 kPa, without friction and with that of sand: a part of the voids is at the walls.
  // Grains of one size come closer than Toyoura sand; other curves are taken to be as close.
  struct Limits {
    double dense, loose;  // of many grains
  };
  constexpr Limits of_toyoura{0.177, 0.32}, of_others{0.12, 0.32};
  constexpr double dense_at_walls = 0.74, loose_at_walls = 0.9, squeezed = 5;
  Limits const limits = scene.grading.file.empty() && scene.grading.table == "toyoura" ? of_toyoura : of_others;
  bool const at_test = scene.specimen.void_ratio_at == VoidRatioAt::test;
  double const walls = 1 / std::sqrt(static_cast<double>(std::max<std::int64_t>(design.particles, 1))),
               stress = at_test ? scene.test.confining_stress : scene.specimen.preparation_stress,
               densest = limits.dense + dense_at_walls * walls - squeezed * stress / scene.grains.normal_stiffness,
               loosest = limits.loose + loose_at_walls * walls;
  if (design.void_ratio >= densest && design.void_ratio <= loosest) return {};
  bool const is_dense = design.void_ratio < densest;
  char text[240];
  std::snprintf(
      text, sizeof text,
      "a void ratio of %.4g will hardly be reached: %lld particles of such a grading come to rest at about %.2g at the %s",
      design.void_ratio, static_cast<long long>(design.particles), is_dense ? densest : loosest,
      is_dense ? "densest, without friction" : "loosest");
  return text;
}

std::string narrowness(double width, double height, double largest, double fewest) {
  constexpr double rounding = 1e-9;
  double const side = std::min(width, height), across = side / largest;
  if (across >= fewest * (1 - rounding)) return {};
  char text[160];
  std::snprintf(text, sizeof text,
                "the specimen is %.4g mm %s, %.3g times its largest grain (%.4g mm): at least %g times are needed", side * 1e3,
                width < height ? "wide" : "high", across, largest * 1e3, fewest);
  return text;
}

}  // namespace clathra
