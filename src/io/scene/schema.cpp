#include "io/scene/schema.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "domain/scene/grading.hpp"
#include "io/scene/presets.hpp"

namespace clathra {
namespace {

/// Scene::*Group.*Member as a function, so that one table can hold members of every section.
template <auto Group, auto Member>
auto& at(Scene& scene) {
  return (scene.*Group).*Member;
}

template <auto Group, auto Member>
constexpr ChoiceField choice_at() {
  return {[](Scene const& scene) { return static_cast<int>((scene.*Group).*Member); },
          [](Scene& scene, int place) {
            auto& value = (scene.*Group).*Member;
            value = static_cast<std::remove_reference_t<decltype(value)>>(place);
          }};
}

using Names = std::string_view;
constexpr std::array generators = {Names("under_compaction"), Names("compression")};
constexpr std::array void_ratio_stages = {Names("preparation"), Names("test")};
constexpr std::array tables = {Names("toyoura"), Names("uniform")};
constexpr std::array laws = {Names("none"), Names("thickness_dependent"), Names("constant_thickness")};
constexpr std::array couplings = {Names("replaces"), Names("parallel"), Names("replaces_keeping_force")};
constexpr std::array moment_scales = {Names("paper_si"), Names("rod_mm"), Names("similitude")};
constexpr std::array rod_thicknesses = {Names("printed"), Names("clamped"), Names("scaled")};
constexpr std::array sources = {Names("printed"), Names("thm")};
constexpr std::array precisions = {Names("double"), Names("mixed")};
constexpr std::array step_rules = {Names("spectrum"), Names("bound")};
constexpr std::array modes = {Names("eq3"), Names("given_thickness"), Names("areal_target")};

using enum Dimension;
using enum Kind;
constexpr double any_seed = 9223372036854775807.0;  // TOML integers have 63 bits

#define CLATHRA_FIELD(section, member) at<&Scene::section, &decltype(Scene::section)::member>
#define CLATHRA_CHOICE(section, member) choice_at<&Scene::section, &decltype(Scene::section)::member>()

// clang-format off
Key const table[] = {
  {"specimen.generator", choice, CLATHRA_CHOICE(specimen, generator), "how the specimen is made: compacted in layers, or all discs at once (large specimens)", ratio, 0, 0, {}, generators},
  {"specimen.particles", integer, CLATHRA_FIELD(specimen, particles), "number of discs; any three of particles, box, void ratio and grading fix the fourth", ratio, 16, 1e9, "it follows from the others"},
  {"specimen.void_ratio", quantity, CLATHRA_FIELD(specimen, void_ratio), "area of voids over area of discs, under specimen.preparation_stress or as specimen.void_ratio_at says", ratio, 0.05, 1, "0.24, or what particles, box and grading give"},
  {"specimen.void_ratio_at", choice, CLATHRA_CHOICE(specimen, void_ratio_at), "when the specimen has its void ratio: as it is made, under specimen.preparation_stress, or at the start of the test, consolidated under test.confining_stress (specimens are made until one has it then)", ratio, 0, 0, {}, void_ratio_stages},
  {"specimen.preparation_stress", quantity, CLATHRA_FIELD(specimen, preparation_stress), "isotropic stress under which the specimen is made and hydrate forms", pressure, 1e3, 1e9},
  {"specimen.width", quantity, CLATHRA_FIELD(specimen, width), "width of the specimen", length, 1e-6, 1e3, "it follows from the others"},
  {"specimen.height", quantity, CLATHRA_FIELD(specimen, height), "height of the specimen", length, 1e-6, 1e3, "it follows from the others"},
  {"specimen.aspect_ratio", quantity, CLATHRA_FIELD(specimen, aspect_ratio), "height over width where they are not both given", ratio, 0.1, 10},
  {"specimen.compaction_layers", integer, CLATHRA_FIELD(specimen, compaction_layers), "layers of the under-compaction; fewer where these would be too thin", ratio, 1, 100},
  {"specimen.file", path, CLATHRA_FIELD(specimen, file), "specimen file to read instead of making a specimen (docs/specimen-file.md)"},

  {"grains.density", quantity, CLATHRA_FIELD(grains, density), "density of the grains", density, 100, 30000},
  {"grains.normal_stiffness", quantity, CLATHRA_FIELD(grains, normal_stiffness), "normal stiffness of a contact, per metre thickness; measured at 55 % and 1 MPa: 1e8 for 3e8 takes 0.73 of the disc-steps, its peak of q is 10 % lower and E50 63 %", stiffness, 1e4, 1e13},
  {"grains.shear_stiffness", quantity, CLATHRA_FIELD(grains, shear_stiffness), "shear stiffness of a contact, per metre thickness", stiffness, 1e4, 1e13},
  {"grains.friction", quantity, CLATHRA_FIELD(grains, friction), "friction coefficient between grains", ratio, 0, 5},
  {"grains.rolling_width_factor", quantity, CLATHRA_FIELD(grains, rolling_width_factor), "beta: width of a grain contact over the common radius; 0 leaves out rolling resistance", ratio, 0, 4},

  {"grading.table", choice, CLATHRA_FIELD(grading, table), "grain sizes: Toyoura sand, or all discs of size d50", ratio, 0, 0, {}, tables},
  {"grading.file", path, CLATHRA_FIELD(grading, file), "CSV file of grain sizes: diameter, percent finer by mass (docs/grading.md)"},
  {"grading.d50", quantity, CLATHRA_FIELD(grading, d50), "median diameter to which the table is scaled", length, smallest_d50, largest_d50, "that of the table"},

  {"hydrate.saturation", quantity, CLATHRA_FIELD(hydrate, saturation), "part of the pores that hydrate fills; 0 is clean sand", ratio, 0, 1},
  {"hydrate.temperature", quantity, CLATHRA_FIELD(hydrate, temperature), "temperature", temperature, -100, 100},
  {"hydrate.pore_pressure", quantity, CLATHRA_FIELD(hydrate, pore_pressure), "water pressure in the pores; it acts on the hydrate, stresses are effective", pressure, 1e3, 1e9},
  {"hydrate.density", quantity, CLATHRA_FIELD(hydrate, density), "density of the hydrate", density, 100, 2000},
  {"hydrate.allow_unstable", boolean, CLATHRA_FIELD(hydrate, allow_unstable), "go on where hydrate would dissociate"},

  {"bond.preset", choice, CLATHRA_FIELD(bond, preset), "reading of what the seed paper leaves open, which stands in for the defaults of this section, of and of grains.rolling_width_factor; a key that is stated keeps its value", ratio, 0, 0, {}, readings().names},
  {"bond.law", choice, CLATHRA_CHOICE(bond, law), "bonds: none, of the thickness of their gap, or all of one thickness", ratio, 0, 0, {}, laws},
  {"bond.contact_coupling", choice, CLATHRA_CHOICE(bond, contact_coupling), "a bond replaces the grain contact, acts in parallel to it, or replaces it and keeps its force", ratio, 0, 0, {}, couplings},
  {"bond.grain_stiffness_factor", quantity, CLATHRA_FIELD(bond, grain_stiffness_factor), "stiffness of one grain, two of which are in series with a bond (Eq. 16), over that of a contact: 2 since two grains in series make a contact, 1 as printed", ratio, 0.01, 100},
  {"bond.moment_scale", choice, CLATHRA_CHOICE(bond, moment_scale), "length L_r that Eq. 9b lacks: 1 m, 1 mm, or moment_ratio times the bond width", ratio, 0, 0, {}, moment_scales},
  {"bond.moment_ratio", quantity, CLATHRA_FIELD(bond, moment_ratio), "L_r over the bond width with moment_scale \"similitude\"", ratio, 1e-4, 10},
  {"bond.thickness_mapping", choice, CLATHRA_CHOICE(bond, thickness_mapping), "thickness of the tested rod that stands for a bond (Eqs. 10, 11): that of its gap, as printed; at least the 0.6 mm of the thinnest one; or the gap scaled by 12 mm over d50", ratio, 0, 0, {}, rod_thicknesses},
  {"bond.friction_floor", boolean, CLATHRA_FIELD(bond, friction_floor), "a bonded contact is never weaker than an unbonded one: R_s >= mu F_n, R_r >= F_n B_c / 6"},
  {"bond.strength_from", choice, CLATHRA_CHOICE(bond, strength_from), "strength of hydrate: as printed in Eq. 15, or from temperature, pressure and density (Eq. 13)", ratio, 0, 0, {}, sources},
  {"bond.critical_thickness_from", choice, CLATHRA_CHOICE(bond, critical_thickness_from), "critical thickness from saturation (Eq. 3), as given, or such that the bonds fill the saturation", ratio, 0, 0, {}, modes},
  {"bond.critical_thickness", quantity, CLATHRA_FIELD(bond, critical_thickness), "largest gap that a bond spans, with mode \"given_thickness\"", length, 1e-9, 0.01, "bond.critical_thickness_from decides"},
  {"bond.constant_thickness", quantity, CLATHRA_FIELD(bond, constant_thickness), "thickness of all bonds with law \"constant_thickness\"", length, 1e-9, 0.01, "half the critical thickness"},
  {"bond.after_consolidation", boolean, CLATHRA_FIELD(bond, after_consolidation), "let hydrate form under the confining stress instead"},

  {"damping.local", quantity, CLATHRA_FIELD(damping, local), "local damping while the specimen is sheared, a part of the model; measured at 55 %: without it the peak of q is 12 to 13 % lower at every rate, with 0.7 1.3 +- 0.6 % higher at I = 2e-4", ratio, 0, 0.95},
  {"damping.viscous_ratio", quantity, CLATHRA_FIELD(damping, viscous_ratio), "viscous damping of contacts, as a part of the critical one; measured at 55 %: 0.2 in place of damping.local lowers the peak of q by 5 to 7 % at every rate", ratio, 0, 1},

  {"test.confining_stress", quantity, CLATHRA_FIELD(test, confining_stress), "effective lateral stress sigma_3", pressure, 1e3, 1e9},
  {"test.axial_strain", quantity, CLATHRA_FIELD(test, axial_strain), "natural axial strain to reach", ratio, 1e-6, 0.5},
  {"test.inertial_number", quantity, CLATHRA_FIELD(test, inertial_number), "rate of the test as I = strain rate * d50 * sqrt(density / pressure); measured against I = 1e-5, the peak of q of sand +5.6 +- 0.8 % at 1e-3, +2.5 +- 0.6 at 5e-4, +0.7 +- 0.5 at 2e-4, with 55 % of hydrate +2.5 +- 0.8, +1.3 +- 0.6, +0.6 +- 0.5", ratio, 1e-12, 1, "strain_rate is given instead"},
  {"test.strain_rate", quantity, CLATHRA_FIELD(test, strain_rate), "axial strain rate, instead of inertial_number", rate, 1e-12, 1e6, "test.inertial_number decides"},
  {"test.max_platen_wave_stress", quantity, CLATHRA_FIELD(test, max_platen_wave_stress), "largest W, the stress of the wave that a platen sends out over sigma_3: the rate of inertial_number is lowered where the height of the specimen asks for it; measured on 20,000 discs with 55 %: peak of q +1.4 +- 0.5 % at I = 2e-4, where W is 0.26, +1.0 +- 0.5 % with W of 0.2 and +0.3 +- 0.5 % with 0.13; a stated inertial_number is bounded by a stated max_platen_wave_stress only", ratio, 1e-6, 1000, "the rate is that of inertial_number", {}, true},
  {"test.wall_friction", quantity, CLATHRA_FIELD(test, wall_friction), "friction coefficient of the walls", ratio, 0, 5},
  {"test.consolidation_steps", integer, CLATHRA_FIELD(test, consolidation_steps), "most steps of consolidation; a specimen that has not come to rest by then is refused, with another number than this sheared with a warning", ratio, 0, 1e9},

  {"run.preset", choice, CLATHRA_FIELD(run, preset), "point of the trade of speed for accuracy, which stands in for the defaults of precision, time_step_safety, rotational_inertia_factor and mass_scaled_fraction here and of inertial_number and max_platen_wave_stress in [test]; a key that is stated keeps its value", ratio, 0, 0, {}, accuracies().names},
  {"run.seed", integer, CLATHRA_FIELD(run, seed), "seed of the random numbers", ratio, 0, any_seed},
  {"run.threads", integer, CLATHRA_FIELD(run, threads), "threads; results do not depend on them", ratio, 1, 4096, "OMP_NUM_THREADS, or all cores"},
  {"run.precision", choice, CLATHRA_CHOICE(run, precision), "numbers of consolidation and shear: forces, velocities and histories in 64 bits, or in 32 bits from exact differences of places, with sums and places in 64; measured at equal rate, the peak of q of \"mixed\" is -0.4 +- 0.9 % off in sand and -0.2 +- 0.4 % at 55 %; without this key grains with a normal_stiffness above 1e4 sigma_3 get \"double\"", ratio, 0, 0, {}, precisions},
  {"run.time_step_rule", choice, CLATHRA_CHOICE(run, time_step_rule), "time step: a share of the limit of stability, followed as that changes, or of an estimate when a stage begins, lowered where the limit asks for it", ratio, 0, 0, {}, step_rules},
  {"run.time_step_safety", quantity, CLATHRA_FIELD(run, time_step_safety), "time step over that limit or estimate, in consolidation and shear; specimens are made with the usual one; measured at I = 2e-4 and 55 %: half the step is -0.3 +- 1.6 % off in the peak of q", ratio, 0.001, 1, "0.95 of the limit, 0.7 of the estimate"},
  {"run.rotational_inertia_factor", quantity, CLATHRA_FIELD(run, rotational_inertia_factor), "moments of inertia over their own while the specimen is consolidated and sheared: rotation holds the time step down; measured at I = 2e-4: 3 for 1 saves a factor of 1.31 (sand) and 1.37 (55 %) in steps, the peak of q is -0.1 +- 0.6 % and 0.0 +- 0.6 % off", ratio, 1, 10},
  {"run.mass_scaled_fraction", quantity, CLATHRA_FIELD(run, mass_scaled_fraction), "share of the discs, the smallest, that get the mass of the smallest other one, likewise; measured at I = 2e-4 beside a rotational_inertia_factor of 3: 0.25 saves another factor of 1.08, the peak of q of both is -0.1 +- 1.3 % off at 55 %", ratio, 0, 0.5},
  {"run.verlet_skin", quantity, CLATHRA_FIELD(run, verlet_skin), "distance beyond touching at which neighbours are listed; up to five times that for discs that fly; moves no physics, only rounding: two bonded tests that differ by it scatter by 1 % in their peaks", length, 1e-9, 1, "chosen"},
  {"run.ignore_guards", boolean, CLATHRA_FIELD(run, ignore_guards), "go on where a guard refuses; noted in run.json"},

  {"output.folder", text, CLATHRA_FIELD(output, folder), "folder of the results"},
  {"output.records", integer, CLATHRA_FIELD(output, records), "rows of history.csv over the whole strain", ratio, 1, 1e6},
  {"output.snapshots", integer, CLATHRA_FIELD(output, snapshots), "snapshots for ParaView and the report over the whole strain, besides the one at its start; at rows of history.csv, so no more than output.records", ratio, 1, 1e5, "none at all", {}, true},
  {"output.snapshots_at", quantities, CLATHRA_FIELD(output, snapshots_at), "axial strains at which snapshots are taken besides, at the very step, as in [\"2.54 %\", \"3.38 %\"]", ratio, 1e-6, 0.5},
  {"output.energy", boolean, CLATHRA_FIELD(output, energy), "keep the energy ledger in history.csv"},
  {"output.events", boolean, CLATHRA_FIELD(output, events), "write every broken bond to events.csv"},
  {"output.event_details", boolean, CLATHRA_FIELD(output, event_details), "with the strain, orientation, thickness, width, utilisation, energy and rotation of each at its break; only with events"},
  {"output.lossless_snapshots", boolean, CLATHRA_FIELD(output, lossless_snapshots), "write snapshots without rounding: forces, moments and gaps with all their digits"},
  {"output.keep_checkpoint", boolean, CLATHRA_FIELD(output, keep_checkpoint), "keep the last checkpoint of a finished test: `run --resume --set test.axial_strain=...` extends it; about 600 bytes a disc"},
};
// clang-format on
#undef CLATHRA_FIELD
#undef CLATHRA_CHOICE

/// Damerau's distance: letters put in, left out, changed, or two neighbours swapped.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> cost(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) cost[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) cost[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i)
    for (std::size_t j = 1; j <= b.size(); ++j) {
      std::size_t const change = a[i - 1] == b[j - 1] ? 0 : 1;
      cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, cost[i - 1][j - 1] + change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
    }
  return cost[a.size()][b.size()];
}

/// How far two names may be apart to be taken for a slip of the keyboard.
bool is_near(std::size_t distance, std::string_view name) { return distance <= std::max<std::size_t>(1, name.size() / 3); }

constexpr std::size_t longest_name = 60;  // a longer one resembles no key

}  // namespace

std::span<Key const> schema() { return table; }

Key const* find_key(std::string_view name) {
  auto const found = std::find_if(std::begin(table), std::end(table), [&](Key const& key) { return key.name == name; });
  return found == std::end(table) ? nullptr : found;
}

std::string name_suggestion(std::string_view name, std::span<std::string_view const> names) {
  std::string_view best;
  std::size_t least = std::numeric_limits<std::size_t>::max();
  for (std::string_view const candidate : names)
    if (name.size() <= longest_name)
      if (std::size_t const distance = edit_distance(name, candidate); distance < least) {
        least = distance;
        best = candidate;
      }
  if (best.empty() || !is_near(least, name)) return {};
  return "; did you mean '" + std::string(best) + "'?";
}

std::string key_suggestion(std::string_view name) {
  auto const dot = name.find('.');
  std::string_view const section = name.substr(0, dot);
  std::string_view const leaf = dot == std::string_view::npos ? std::string_view{} : name.substr(dot + 1);
  std::vector<std::string_view> leaves, elsewhere, whole;
  for (Key const& key : schema()) {
    if (key.section() == section) leaves.push_back(key.leaf());
    if (key.leaf() == leaf || key.leaf() == name) elsewhere.push_back(key.name);
    whole.push_back(key.name);
  }
  if (!leaf.empty())
    if (std::string const hint = name_suggestion(leaf, leaves); !hint.empty()) return hint;
  if (!elsewhere.empty()) return "; did you mean '" + std::string(elsewhere.front()) + "'?";
  return name_suggestion(name, whole);
}

}  // namespace clathra
