#include "io/results/specimen_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "domain/measurement/disc_grading.hpp"
#include "io/errors/problems.hpp"
#include "io/errors/rank_errors.hpp"
#include "io/results/specimen_label.hpp"
#include "io/scene/scene_value.hpp"
#include "io/scene/schema.hpp"
#include "io/scene/size_warnings.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

/// At this many d50 from the origin doubles are 2e-9 d50 apart: 1e-5 of the overlaps of grains at kn = 5000 stresses.
constexpr double farthest_place = 1e7;
/// The d50 of a file is that of its curve. Of 300 to 20,000 discs of our generators in up to 5 layers it differs by up to 0.7 %
/// with the default curve, 2 % with curves of d_max / d_min up to 10, and 10 % at 20; where a curve is flat (two sizes) by any
/// factor. The share of the sand that is finer differs by 5 % at most then.
constexpr double d50_tolerance = 0.05, d50_share = 0.05;
/// 753 files of our own agree to 2e-14; one from single precision to 1e-6.
constexpr double void_ratio_tolerance = 1e-3;
constexpr double no_sand = 1e3;           // void ratio of discs that hardly touch: places and radii are in different units
constexpr double deepest_at_wall = 0.05;  // a disc into a wall [d50] at rest: a tenth of a radius; under a test it is pressed in
constexpr double widest_space = 3;        // between a wall and the sand [d50]; our own touch it
constexpr double most_deep_pairs = 0.1;   // of the pairs that touch; up to 0.04 in tests with grains as stiff as advised
constexpr double stress_factor = 2;       // our own rest under 0.89 to 1 of what they say

constexpr double fastest_sound = 1e4;  // in any grain [m/s]
constexpr double least_stress = 1e3;   // [Pa] of moving grains, density x speed^2: less is rest where no stress is stated
// Stiffer than any contact [N/m per m], and farther than bonds reach [d50]: beyond them numbers of contacts are damage.
constexpr double stiffest = 1e12, farthest_bond = 1e3;

[[noreturn]] void refuse(fs::path const& path, std::string const& what) { throw FileProblem(ExitCode::bad_input, path, what); }

std::string mm(double length) { return fmt::format("{:.6g} mm", length * 1e3); }

void require_metres(fs::path const& path, SpecimenOutline const& outline) {
  if (outline.sizes.d50 > largest_d50)
    refuse(path, fmt::format("half of its sand is of particles larger than {:.4g} m: these look like mm, lengths must be in m",
                             outline.sizes.d50));
  if (outline.sizes.d50 < smallest_d50)
    refuse(path, fmt::format("half of its sand is of particles smaller than {:.4g} m: lengths must be in m", outline.sizes.d50));
  if (outline.farthest > farthest_place * outline.sizes.d50)
    refuse(path,
           fmt::format("it reaches to {:.4g} m from the origin, {:.3g} times the d50 of its particles; numbers there are {:.2g} "
                       "d50 apart, too coarse for overlaps of grains (at most {:g} times): make it anew nearer to the origin",
                       outline.farthest, outline.farthest / outline.sizes.d50,
                       outline.farthest * std::numeric_limits<double>::epsilon() / outline.sizes.d50, farthest_place));
}

void require_sizes_of_one_sand(fs::path const& path, std::vector<double> const& radii, Ranks const& ranks) {
  double smallest = 1e300, largest = 0;
  for (double const r : radii) smallest = std::min(smallest, 2 * r), largest = std::max(largest, 2 * r);
  if (std::string const problem = crowding(ranks.min(smallest), ranks.max(largest), 0); !problem.empty()) refuse(path, problem);
}

void require_discs_inside(fs::path const& path, SpecimenOutline const& outline) {
  std::size_t worst = 0;
  for (std::size_t wall = 1; wall < outline.at_wall.size(); ++wall)
    if (outline.at_wall[wall].depth < outline.at_wall[worst].depth) worst = wall;
  DiscAtWall const& at = outline.at_wall[worst];
  if (!(at.depth < 0)) return;
  std::string const others = outline.outside > 1 ? fmt::format(", {} particles are outside", outline.outside) : "";
  refuse(path,
         fmt::format("particle {} has its centre {} outside of the {} wall{}", at.id, mm(-at.depth), wall_names[worst], others));
}

void require_discs_apart(fs::path const& path, SpecimenOverlaps const& overlaps) {
  if (overlaps.through == 0) return;
  OverlappingPair const& pair = overlaps.deepest;
  std::string const others = overlaps.through > 1 ? fmt::format(", and {} more pairs", overlaps.through - 1) : "";
  refuse(path, fmt::format("particle {} at ({}, {}) and particle {} overlap by {:.3g} times the smaller radius{}: at most once",
                           pair.id_a, mm(pair.x), mm(pair.y), pair.id_b, pair.share, others));
}

/// "; the top wall is 3.4 mm (20 d50) from the nearest disc" for each wall that no sand is at.
std::string spaces(SpecimenOutline const& outline) {
  std::string text;
  for (std::size_t wall = 0; wall < outline.at_wall.size(); ++wall)
    if (double const space = outline.at_wall[wall].space; space > widest_space * outline.sizes.d50)
      text += fmt::format("{}the {} wall is {} ({:.3g} d50) from the nearest particle", text.empty() ? "" : "; ",
                          wall_names[wall], mm(space), space / outline.sizes.d50);
  return text;
}

void require_motion_that_can_be(fs::path const& path, SpecimenOutline const& outline) {
  FastestDisc const& fastest = outline.fastest;
  if (!(fastest.speed <= fastest_sound))
    refuse(path,
           fmt::format("particle {} moves or spins at {:.3g} m/s, faster than sound in any grain: vx, vy are in m/s, omega in "
                       "rad/s, and 0 where they are left out",
                       fastest.id, fastest.speed));
}

/// Forces no contact can bear, bonds no hydrate can span.
void require_contacts_that_can_be(fs::path const& path, Specimen const& part, double d50) {
  auto const most_of = [&](ContactNumber const& number) {
    if (number.of == &SpecimenContact::formation_overlap) return farthest_bond * d50;
    bool const moment = number.of == &SpecimenContact::moment || number.of == &SpecimenContact::bond_moment;
    return stiffest * d50 * (moment ? d50 : 1);
  };
  for (SpecimenContact const& contact : part.contacts)
    for (ContactNumber const& number : contact_numbers) {
      double const value = contact.*number.of, most = most_of(number);
      bool const unbonded = number.of == &SpecimenContact::formation_overlap && !contact.bonded();
      if (unbonded || std::abs(value) <= most) continue;
      refuse(path, fmt::format("{} of contact {} - {} is {:.3g}; with a d50 of {} it can be {:.3g} at most", number.name,
                               contact.id_a, contact.id_b, value, mm(d50), most));
    }
}

void require_d50(fs::path const& path, Specimen& part, double found, Ranks const& ranks) {
  if (std::isnan(part.d50)) part.d50 = found;
  if (std::abs(part.d50 / found - 1) <= d50_tolerance) return;
  double const low = diameter_finer(part.radius, 0.5 - d50_share, ranks),
               high = diameter_finer(part.radius, 0.5 + d50_share, ranks);
  if (part.d50 >= low && part.d50 <= high) return;
  refuse(path, fmt::format("its attribute d50 is {}, that of its particles is {}: correct it, or leave it out", mm(part.d50),
                           mm(found)));
}

void require_void_ratio(fs::path const& path, Specimen& part, SpecimenOutline const& outline) {
  if (!(outline.void_ratio <= no_sand))
    refuse(path,
           fmt::format("its particles (d50 {}) fill 1/{:.3g} of the box between its walls ({} x {}): places, walls and radii "
                       "must all be in m",
                       mm(outline.sizes.d50), 1 + outline.void_ratio, mm(part.width()), mm(part.height())));
  if (std::isnan(part.void_ratio)) part.void_ratio = outline.void_ratio;
  if (std::abs(part.void_ratio - outline.void_ratio) <= void_ratio_tolerance) return;
  std::string const why = spaces(outline);
  refuse(path,
         fmt::format("its attribute void_ratio is {:.5g}, that of its particles between its walls is {:.5g}{}{}: correct what is "
                     "wrong, or leave it out",
                     part.void_ratio, outline.void_ratio, why.empty() ? "" : "; ", why));
}

/// The normal stiffness of the grains that a specimen came to rest with, if it says so [N/m per m].
std::optional<double> stiffness_of(Specimen const& specimen) {
  SceneTexts const label = label_of(specimen);
  auto const kept = label.find("grains.normal_stiffness");
  if (kept == label.end()) return {};
  try {
    Scene then;
    set_from_text(*find_key("grains.normal_stiffness"), then, kept->second);
    return then.grains.normal_stiffness;
  } catch (std::invalid_argument const&) {
    return {};
  }
}

void require_density_of_grains(fs::path const& path, double density) {
  Key const& key = *find_key("grains.density");
  if (density >= key.least && density <= key.most) return;
  refuse(path, fmt::format("its attribute density is {:g}; grains have {:g} to {:g} kg/m^3", density, key.least, key.most));
}

}  // namespace

SpecimenFacts require_sound(fs::path const& path, Specimen& part, Ranks const& ranks) {
  SpecimenFacts facts;
  facts.outline = outline_of(part, ranks);
  require_density_of_grains(path, part.density);
  require_metres(path, facts.outline);
  require_sizes_of_one_sand(path, part.radius, ranks);
  if (!part.periodic) require_discs_inside(path, facts.outline);
  require_motion_that_can_be(path, facts.outline);
  on_each(ranks, [&] { require_contacts_that_can_be(path, part, facts.outline.sizes.d50); });
  facts.overlaps = overlaps_of(part, ranks);
  require_discs_apart(path, facts.overlaps);
  require_d50(path, part, facts.outline.sizes.d50, ranks);
  require_void_ratio(path, part, facts.outline);
  return facts;
}

std::vector<std::string> oddities(fs::path const& path, Specimen const& part, SpecimenFacts const& facts) {
  std::vector<std::string> warnings;
  auto const warn = [&](std::string const& text) { warnings.push_back(path.string() + ": " + text); };
  if (std::string const text = spaces(facts.outline); !part.periodic && !text.empty())
    warn(text + ": the box is larger than its sand");
  for (std::size_t wall = 0; wall < facts.outline.at_wall.size(); ++wall)
    if (double const into = -facts.outline.at_wall[wall].space / facts.outline.sizes.d50;
        !part.periodic && part.axial_strain == 0 && into > deepest_at_wall)
      warn(fmt::format("a particle reaches {:.3g} d50 into the {} wall: the box is smaller than its sand", into,
                       wall_names[wall]));
  FastestDisc const& fastest = facts.outline.fastest;
  if (double const stress = part.density * fastest.speed * fastest.speed; stress > std::max(part.stress, least_stress))
    warn(fmt::format("particle {} moves or spins at {:.3g} m/s, worth {:.4g} kPa: it is not at rest", fastest.id, fastest.speed,
                     stress * 1e-3));
  Key const& asked = *find_key("specimen.void_ratio");
  if (double const e = facts.outline.void_ratio; e < asked.least || e > asked.most)
    warn(fmt::format("its void ratio is {:.4g}; sand at rest has {:g} to {:g}", e, asked.least, asked.most));
  SpecimenOverlaps const& overlaps = facts.overlaps;
  double const share = static_cast<double>(overlaps.deep) / static_cast<double>(std::max<std::int64_t>(1, overlaps.touching));
  if (share > most_deep_pairs)
    warn(fmt::format(
        "{:.3g} % of the pairs that touch overlap by more than a tenth of the smaller radius, the deepest, particles {} and "
        "{}, by {:.3g} %: the particles are too large for their places, or too soft for the stress",
        100 * share, overlaps.deepest.id_a, overlaps.deepest.id_b, 100 * overlaps.deepest.share));
  for (std::string const& text : size_warnings(facts.outline.sizes)) warn(text);
  return warnings;
}

std::vector<std::string> stress_oddities(fs::path const& path, Specimen const& part, SpecimenFacts const& facts,
                                         std::optional<double> kn_of_scene) {
  if (!(part.stress > 0) || part.critical_thickness > 0 || part.axial_strain != 0) return {};
  std::optional<double> const known = stiffness_of(part);
  if (!known && !kn_of_scene) return {};
  double const kn = known ? *known : *kn_of_scene, found = kn * facts.overlaps.stress;
  if (found <= stress_factor * part.stress && found >= part.stress / stress_factor) return {};
  return {fmt::format(
      "{}: says that it rests under {:.4g} kPa; by the overlaps of its particles and a kn of {:.4g} MPa it carries {:.3g} "
      "kPa",
      path.string(), part.stress * 1e-3, kn * 1e-6, found * 1e-3)};
}

void require_walls(fs::path const& path, Specimen const& part) {
  if (part.periodic)
    refuse(path,
           "is a periodic cell: a test loads a specimen by its walls (attribute periodic = 0, particles between the walls)");
}

}  // namespace clathra
