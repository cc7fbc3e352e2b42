#include "io/scene/schema.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "domain/scene/grading.hpp"
#include "io/scene/presets.hpp"
#include "io/scene/stage_keys.hpp"

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
constexpr std::array test_kinds = {Names("biaxial"),       Names("extension"),        Names("isotropic"),
                                   Names("oedometer"),     Names("constant_volume"),  Names("constant_mean_stress"),
                                   Names("unload_reload"), Names("cyclic"),           Names("creep"),
                                   Names("heating"),       Names("depressurisation"), Names("list")};
constexpr std::array generators = {Names("under_compaction"), Names("compression")};
constexpr std::array void_ratio_stages = {Names("preparation"), Names("test")};
constexpr std::array tables = {Names("toyoura"), Names("uniform")};
constexpr std::array laws = {Names("none"), Names("thickness_dependent"), Names("constant_thickness")};
constexpr std::array couplings = {Names("replaces"), Names("parallel"), Names("replaces_keeping_force")};
constexpr std::array thickness_mappings = {Names("identity"), Names("clamped"), Names("scaled")};
constexpr std::array sources = {Names("printed"), Names("conditions")};
constexpr std::array precisions = {Names("double"), Names("mixed")};
constexpr std::array step_rules = {Names("adaptive"), Names("fixed")};
constexpr std::array losses = {Names("critical_thickness"), Names("recession"), Names("uniform")};
constexpr std::array critical_thicknesses = {Names("saturation"), Names("given"), Names("bond_area")};

using enum Dimension;
using enum Kind;
constexpr double any_seed = 9007199254740992;  // 2^53: what a JSON number holds exactly

#define CLATHRA_FIELD(section, member) at<&Scene::section, &decltype(Scene::section)::member>
#define CLATHRA_CHOICE(section, member) choice_at<&Scene::section, &decltype(Scene::section)::member>()

// clang-format off
Key const table[] = {
  {"specimen.generator", choice, CLATHRA_CHOICE(specimen, generator), "how the specimen is made: compacted layer by layer, or all particles at once (large specimens)", ratio, 0, 0, {}, generators},
  {"specimen.particles", integer, CLATHRA_FIELD(specimen, particles), "number of particles; any three of particles, box, void ratio and grading fix the fourth", ratio, 16, 1e9, "it follows from the others"},
  {"specimen.void_ratio", quantity, CLATHRA_FIELD(specimen, void_ratio), "area of voids over area of particles, in the state that void_ratio_at names", ratio, 0.05, 1, "0.24, or what particles, box and grading give"},
  {"specimen.void_ratio_at", choice, CLATHRA_CHOICE(specimen, void_ratio_at), "state that has this void ratio: as prepared under preparation_stress, or consolidated under test.confining_stress", ratio, 0, 0, {}, void_ratio_stages},
  {"specimen.preparation_stress", quantity, CLATHRA_FIELD(specimen, preparation_stress), "isotropic stress under which the specimen is prepared", pressure, 1e3, 1e9},
  {"specimen.width", quantity, CLATHRA_FIELD(specimen, width), "width of the specimen", length, 1e-6, 1e3, "it follows from the others"},
  {"specimen.height", quantity, CLATHRA_FIELD(specimen, height), "height of the specimen", length, 1e-6, 1e3, "it follows from the others"},
  {"specimen.aspect_ratio", quantity, CLATHRA_FIELD(specimen, aspect_ratio), "height over width where they are not both given", ratio, 0.1, 10},
  {"specimen.compaction_layers", integer, CLATHRA_FIELD(specimen, compaction_layers), "layers of the under-compaction; fewer where these would be too thin", ratio, 1, 100},
  {"specimen.file", path, CLATHRA_FIELD(specimen, file), "specimen file to read instead of making a specimen (docs/reference/specimen-file.md)"},

  {"grains.density", quantity, CLATHRA_FIELD(grains, density), "density of the grains", density, 100, 30000},
  {"grains.normal_stiffness", quantity, CLATHRA_FIELD(grains, normal_stiffness), "normal stiffness k_n of a contact, per metre thickness (softer is faster and less accurate: docs/explanation/accuracy.md)", stiffness, 1e4, 1e13},
  {"grains.shear_stiffness", quantity, CLATHRA_FIELD(grains, shear_stiffness), "shear stiffness k_s of a contact, per metre thickness", stiffness, 1e4, 1e13},
  {"grains.friction", quantity, CLATHRA_FIELD(grains, friction), "friction coefficient mu between grains", ratio, 0, 5, "none", {}, true},
  {"grains.rolling_width_factor", quantity, CLATHRA_FIELD(grains, rolling_width_factor), "beta, width of a grain contact over the common radius, for rolling resistance", ratio, 0, 4, "no rolling resistance", {}, true},

  {"grading.table", choice, CLATHRA_FIELD(grading, table), "grain sizes: Toyoura sand, or all particles of size d50", ratio, 0, 0, {}, tables},
  {"grading.file", path, CLATHRA_FIELD(grading, file), "CSV file of grain sizes: diameter, percent finer by mass (docs/reference/grading-file.md)"},
  {"grading.d50", quantity, CLATHRA_FIELD(grading, d50), "median diameter to which the table is scaled", length, smallest_d50, largest_d50, "that of the table"},

  {"hydrate.saturation", quantity, CLATHRA_FIELD(hydrate, saturation), "part of the pores that hydrate fills", ratio, 0, 1, "clean sand", {}, true},
  {"hydrate.temperature", quantity, CLATHRA_FIELD(hydrate, temperature), "temperature of hydrate and pore water", temperature, -100, 100},
  {"hydrate.pore_pressure", quantity, CLATHRA_FIELD(hydrate, pore_pressure), "water pressure in the pores; it acts on the hydrate, all stresses are effective", pressure, 1e3, 1e9},
  {"hydrate.density", quantity, CLATHRA_FIELD(hydrate, density), "density of the hydrate", density, 100, 2000},
  {"hydrate.salinity", quantity, CLATHRA_FIELD(hydrate, salinity), "salt in the pore water in g/kg, for the boundary of stability; sea water has 35", ratio, 0, 350},
  {"hydrate.loss", choice, CLATHRA_CHOICE(hydrate, loss), "what bonds lose with the saturation: gap that they span, the same length of their width each, or strength and stiffness alike (docs/howto/changing-hydrate.md)", ratio, 0, 0, {}, losses},
  {"hydrate.spread_of_loss", quantity, CLATHRA_FIELD(hydrate, spread_of_loss), "saturation above 20 % over which the rest of the bonds is lost, where Eq. 3 jumps; not of loss = \"uniform\"", ratio, 1e-4, 0.3},
  {"hydrate.loss_exponent", quantity, CLATHRA_FIELD(hydrate, loss_exponent), "n where loss is \"uniform\": strength and stiffness go with ((S - 20 %) / (S_0 - 20 %))^n", ratio, 0.1, 10},

  {"bond.preset", choice, CLATHRA_FIELD(bond, preset), "model of what Jiang et al. (2017) leave open; a key that is stated keeps its value (section Presets)", ratio, 0, 0, {}, bond_presets().names},
  {"bond.law", choice, CLATHRA_CHOICE(bond, law), "bonds: none, of the thickness of the gap each one spans, or all of one thickness", ratio, 0, 0, {}, laws},
  {"bond.contact_coupling", choice, CLATHRA_CHOICE(bond, contact_coupling), "a bond replaces the grain contact, acts in parallel to it, or replaces it and keeps its force", ratio, 0, 0, {}, couplings},
  {"bond.grain_stiffness_factor", quantity, CLATHRA_FIELD(bond, grain_stiffness_factor), "normal stiffness of one grain (Eq. 16) over that of a contact: 2 for two grains in series, 1 as printed", ratio, 0.01, 100},
  {"bond.rolling_lever", lever, CLATHRA_FIELD(bond, rolling_lever), "lever arm L_r of the rolling strength, which Eq. 9b lacks: a length (\"1 mm\") or a part of the bond width B (\"0.25 B\", \"B/4\")"},
  {"bond.thickness_mapping", choice, CLATHRA_CHOICE(bond, thickness_mapping), "rod thickness in Eqs. 10 and 11: the gap itself, the gap but at least 0.6 mm, or the gap times 12 mm over d50", ratio, 0, 0, {}, thickness_mappings},
  {"bond.friction_floor", boolean, CLATHRA_FIELD(bond, friction_floor), "a bonded contact is never weaker than an unbonded one: R_s >= mu F_n, R_r >= F_n B_c / 6"},
  {"bond.strength_from", choice, CLATHRA_CHOICE(bond, strength_from), "strength of hydrate: as printed in Eq. 15, or of temperature, pressure and density (Eq. 13)", ratio, 0, 0, {}, sources},
  {"bond.strength_modulus", quantity, CLATHRA_FIELD(bond, strength_modulus), "Weibull modulus of the strength, which differs from bond to bond with a mean of 1; the smaller, the further", ratio, 1, 1000, "all bonds of one width and thickness are alike", {}, true},
  {"bond.strength_seed", integer, CLATHRA_FIELD(bond, strength_seed), "seed of that; the same bonds are strong with each run.seed that makes the same specimen", ratio, 0, any_seed},
  {"bond.critical_thickness_from", choice, CLATHRA_CHOICE(bond, critical_thickness_from), "largest gap that a bond spans: from the saturation (Eq. 3), from critical_thickness, or such that the bonds fill the saturation", ratio, 0, 0, {}, critical_thicknesses},
  {"bond.critical_thickness", quantity, CLATHRA_FIELD(bond, critical_thickness), "largest gap that a bond spans, where critical_thickness_from is \"given\"", length, 1e-9, 0.01, "bond.critical_thickness_from decides"},
  {"bond.constant_thickness", quantity, CLATHRA_FIELD(bond, constant_thickness), "thickness of all bonds where law is \"constant_thickness\"", length, 1e-9, 0.01, "half the critical thickness"},
  {"bond.after_consolidation", boolean, CLATHRA_FIELD(bond, after_consolidation), "hydrate forms under test.confining_stress, not under specimen.preparation_stress"},

  {"damping.local", quantity, CLATHRA_FIELD(damping, local), "local damping while the specimen is sheared; part of the model (docs/explanation/accuracy.md)", ratio, 0, 0.95, "none", {}, true},
  {"damping.viscous_ratio", quantity, CLATHRA_FIELD(damping, viscous_ratio), "viscous damping of contacts over critical damping; part of the model (docs/explanation/accuracy.md)", ratio, 0, 1, "none", {}, true},

  {"test.kind", choice, CLATHRA_CHOICE(test, kind), "what follows the consolidation (docs/howto/stages.md); \"list\" are the sections [[stage]] of the scene", ratio, 0, 0, {}, test_kinds},
  {"test.confining_stress", quantity, CLATHRA_FIELD(test, confining_stress), "effective isotropic stress of the consolidation, and lateral stress sigma_3 of the test", pressure, 1e3, 1e9},
  {"test.axial_strain", quantity, CLATHRA_FIELD(test, axial_strain), "natural axial strain at which the test ends", ratio, 1e-6, 0.5},
  {"test.inertial_number", quantity, CLATHRA_FIELD(test, inertial_number), "rate of the test, I = strain rate * d50 * sqrt(density / confining stress) (slower is more accurate: docs/explanation/accuracy.md)", ratio, 1e-12, 1, "strain_rate is given instead"},
  {"test.strain_rate", quantity, CLATHRA_FIELD(test, strain_rate), "axial strain rate, in place of inertial_number", rate, 1e-12, 1e6, "test.inertial_number decides"},
  {"test.max_platen_wave_stress", quantity, CLATHRA_FIELD(test, max_platen_wave_stress), "bound of W, stress of the wave that a platen sends out over sigma_3; a taller specimen is sheared slower (docs/explanation/accuracy.md)", ratio, 1e-6, 1000, "the rate is that of inertial_number", {}, true},
  {"test.wall_friction", quantity, CLATHRA_FIELD(test, wall_friction), "friction coefficient of the walls", ratio, 0, 5, "smooth", {}, true},
  {"test.consolidation_steps", integer, CLATHRA_FIELD(test, consolidation_steps), "most steps of a consolidation, and of an increment of stress; a specimen not at rest by then is refused", ratio, 0, 1e9, "none", {}, true},
  {"test.largest_stress", quantity, CLATHRA_FIELD(test, largest_stress), "stress up to which kind \"isotropic\" or \"oedometer\" compresses, before it unloads", pressure, 1e3, 1e9, "four times test.confining_stress"},
  {"test.increments", integer, CLATHRA_FIELD(test, increments), "increments by equal factors in which these put the stress on, and take it off; least number of equal ones in which kind \"heating\" or \"depressurisation\" changes the hydrate", ratio, 1, 1e4},
  {"test.unload_at", quantities, CLATHRA_FIELD(test, unload_at), "axial strains at which kind \"unload_reload\" unloads to q = 0; half of test.axial_strain where it states none", ratio, 1e-6, 0.5},
  {"test.cyclic_deviator_stress", quantities, CLATHRA_FIELD(test, cyclic_deviator_stress), "two values of q between which kind \"cyclic\" goes back and forth; between the axial strains 0 and test.axial_strain where it states none", pressure, -1e9, 1e9},
  {"test.cycles", integer, CLATHRA_FIELD(test, cycles), "cycles of kind \"cyclic\"", ratio, 1, 1e6},
  {"test.fluid_modulus", quantity, CLATHRA_FIELD(test, fluid_modulus), "bulk modulus of the pore fluid in kind \"constant_volume\"; water has 2.2 GPa", pressure, 1e5, 1e12, "the fluid does not give way"},
  {"test.dead_load", quantity, CLATHRA_FIELD(test, dead_load), "deviator stress that kind \"creep\" puts on and holds, and that stands while kind \"heating\" or \"depressurisation\" changes the hydrate", pressure, 1e3, 1e9, "none"},
  {"test.final_temperature", quantity, CLATHRA_FIELD(test, final_temperature), "temperature to which kind \"heating\" warms", temperature, -100, 100},
  {"test.final_pore_pressure", quantity, CLATHRA_FIELD(test, final_pore_pressure), "pore pressure to which kind \"depressurisation\" goes, before it comes back", pressure, 1e3, 1e9},
  {"test.final_saturation", quantity, CLATHRA_FIELD(test, final_saturation), "saturation that is left by then; up to 20 % there are no bonds", ratio, 0, 1},

  {"run.preset", choice, CLATHRA_FIELD(run, preset), "trade-off between speed and accuracy; a key that is stated keeps its value (section Presets)", ratio, 0, 0, {}, run_presets().names},
  {"run.seed", integer, CLATHRA_FIELD(run, seed), "seed of the random numbers", ratio, 0, any_seed},
  {"run.threads", integer, CLATHRA_FIELD(run, threads), "threads; results do not depend on them", ratio, 1, 4096, "OMP_NUM_THREADS, or all cores"},
  {"run.precision", choice, CLATHRA_CHOICE(run, precision), "floating point precision while consolidating and shearing; \"mixed\" has sums and positions in 64 bits (docs/explanation/accuracy.md)", ratio, 0, 0, {}, precisions},
  {"run.time_step_rule", choice, CLATHRA_CHOICE(run, time_step_rule), "time step: a share of the limit of stability, updated as that changes, or of one estimate at the start of a stage", ratio, 0, 0, {}, step_rules},
  {"run.time_step_safety", quantity, CLATHRA_FIELD(run, time_step_safety), "time step over that limit or estimate, while consolidating and shearing", ratio, 0.001, 1, "0.95 of the limit, 0.7 of the estimate"},
  {"run.rotational_inertia_factor", quantity, CLATHRA_FIELD(run, rotational_inertia_factor), "moments of inertia over their true values while consolidating and shearing; 1 is unscaled (docs/explanation/accuracy.md)", ratio, 1, 10},
  {"run.mass_scaled_fraction", quantity, CLATHRA_FIELD(run, mass_scaled_fraction), "fraction of the particles, the smallest, that get the mass of the smallest other one (docs/explanation/accuracy.md)", ratio, 0, 0.5, "none", {}, true},
  {"run.verlet_skin", quantity, CLATHRA_FIELD(run, verlet_skin), "distance beyond touching up to which neighbours are listed; changes rounding only", length, 1e-9, 1, "chosen"},
  {"run.ignore_guards", boolean, CLATHRA_FIELD(run, ignore_guards), "run although a guard refuses; run.json says which"},

  {"output.folder", text, CLATHRA_FIELD(output, folder), "folder of the results"},
  {"output.records", integer, CLATHRA_FIELD(output, records), "rows of the shear in history.csv, over the whole strain", ratio, 1, 1e6},
  {"output.snapshots", integer, CLATHRA_FIELD(output, snapshots), "snapshots over the whole strain besides the one at its start, at most output.records", ratio, 1, 1e5, "none", {}, true},
  {"output.snapshots_at", quantities, CLATHRA_FIELD(output, snapshots_at), "axial strains of further snapshots, taken at the very step, as in [\"2.54 %\", \"3.38 %\"]", ratio, 1e-6, 0.5},
  {"output.energy", boolean, CLATHRA_FIELD(output, energy), "write the energy balance to history.csv"},
  {"output.events", boolean, CLATHRA_FIELD(output, events), "write every broken bond to events.csv"},
  {"output.event_details", boolean, CLATHRA_FIELD(output, event_details), "strain, orientation, thickness, width, utilisation, energy and rotation of each broken bond, too"},
  {"output.lossless_snapshots", boolean, CLATHRA_FIELD(output, lossless_snapshots), "write snapshots with all digits of forces, moments and gaps"},
  {"output.keep_checkpoint", boolean, CLATHRA_FIELD(output, keep_checkpoint), "keep the last checkpoint of a finished test, from which run --resume extends it (600 bytes a particle)"},
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

/// What papers and other programs call a key, with its section where that makes a difference.
struct Symbol {
  std::string_view name, key, note = {};
};
constexpr Names tangent = "the tangent of the angle", per_thickness = "of a contact, per metre thickness",
                of_hydrate = "the stiffness of hydrate follows from its temperature, pore pressure and density",
                or_strain_rate = "or 'strain_rate'";
constexpr Symbol symbols[] = {{"bond.E", "hydrate.pore_pressure", of_hydrate},
                              {"bond.young", "hydrate.pore_pressure", of_hydrate},
                              {"bond.youngs_modulus", "hydrate.pore_pressure", of_hydrate},
                              {"bond.stiffness", "hydrate.pore_pressure", of_hydrate},
                              {"hydrate.pressure", "hydrate.pore_pressure"},
                              {"hydrate.rho", "hydrate.density"},
                              {"specimen.pressure", "specimen.preparation_stress"},
                              {"specimen.size", "specimen.width", "and 'height'"},
                              {"kn", "grains.normal_stiffness"},
                              {"k_n", "grains.normal_stiffness"},
                              {"E", "grains.normal_stiffness", per_thickness},
                              {"young", "grains.normal_stiffness", per_thickness},
                              {"youngs_modulus", "grains.normal_stiffness", per_thickness},
                              {"ks", "grains.shear_stiffness"},
                              {"k_s", "grains.shear_stiffness"},
                              {"nu", "grains.shear_stiffness", per_thickness},
                              {"poisson", "grains.shear_stiffness", per_thickness},
                              {"poisson_ratio", "grains.shear_stiffness", per_thickness},
                              {"mu", "grains.friction"},
                              {"phi", "grains.friction", tangent},
                              {"friction_angle", "grains.friction", tangent},
                              {"beta", "grains.rolling_width_factor"},
                              {"rho", "grains.density"},
                              {"diameter", "grading.d50"},
                              {"size", "grading.d50"},
                              {"discs", "specimen.particles"},
                              {"box", "specimen.width", "and 'height'"},
                              {"porosity", "specimen.void_ratio"},
                              {"e", "specimen.void_ratio"},
                              {"e0", "specimen.void_ratio"},
                              {"pressure", "test.confining_stress"},
                              {"sigma3", "test.confining_stress"},
                              {"sigma_3", "test.confining_stress"},
                              {"speed", "test.inertial_number", or_strain_rate},
                              {"velocity", "test.inertial_number", or_strain_rate},
                              {"alpha", "damping.local"},
                              {"dt", "run.time_step_safety"},
                              {"time_step", "run.time_step_safety"},
                              {"timestep", "run.time_step_safety"},
                              {"skin", "run.verlet_skin"},
                              {"strain", "test.axial_strain"},
                              {"force", "run.ignore_guards"}};

constexpr std::size_t longest_name = 60;  // a longer one resembles no key

}  // namespace

std::span<Key const> schema() { return table; }

bool is_section(std::string_view name) {
  return std::any_of(std::begin(table), std::end(table), [&](Key const& key) { return key.section() == name; });
}

Key const* find_key(std::string_view name) {
  if (std::optional<StageSetting> const setting = stage_setting(name)) return setting->key;
  auto const found = std::find_if(std::begin(table), std::end(table), [&](Key const& key) { return key.name == name; });
  return found == std::end(table) ? nullptr : found;
}

namespace {

/// The nearest of the names, or nothing.
std::string_view nearest(std::string_view name, std::span<std::string_view const> names) {
  std::string_view best;
  std::size_t least = std::numeric_limits<std::size_t>::max();
  for (std::string_view const candidate : names)
    if (name.size() <= longest_name)
      if (std::size_t const distance = edit_distance(name, candidate); distance < least) least = distance, best = candidate;
  return best.empty() || !is_near(least, name) ? std::string_view() : best;
}

/// Whether the words of the shorter of two names, with _ between them, are all in the longer one.
bool shares_words(std::string_view a, std::string_view b) {
  constexpr std::size_t least = 4;  // "at" stands in many
  std::string_view const shorter = a.size() < b.size() ? a : b, longer = a.size() < b.size() ? b : a;
  auto const with_bounds = [](std::string_view text) { return "_" + std::string(text) + "_"; };
  return shorter.size() >= least && with_bounds(longer).find(with_bounds(shorter)) != std::string::npos;
}

/// Keys that may have been meant, and what is said of the first.
struct Meant {
  std::vector<Key const*> keys;
  std::string_view note = {};
};

/// Keys of a section, or of all where it is empty, whose leaf is near a name, or has its words.
std::vector<Key const*> like_leaf(std::string_view leaf, std::string_view section) {
  constexpr std::size_t most = 3;
  std::vector<std::string_view> leaves;
  std::vector<Key const*> of_words, found;
  for (Key const& key : schema()) {
    if (!section.empty() && key.section() != section) continue;
    leaves.push_back(key.leaf());
    if (of_words.size() < most && shares_words(key.leaf(), leaf)) of_words.push_back(&key);
  }
  std::string_view const near = nearest(leaf, leaves);
  for (Key const& key : schema())
    if (found.empty() && key.leaf() == near && (section.empty() || key.section() == section)) found.push_back(&key);
  return found.empty() ? of_words : found;
}

/// What was meant by "section.leaf" or "leaf": its section is looked through first, if there is such a one.
Meant meant_by(std::string_view name) {
  auto const dot = name.find('.');
  std::string_view const section = name.substr(0, dot), leaf = dot == std::string_view::npos ? name : name.substr(dot + 1);
  for (std::string_view const symbol_name : {name, leaf})
    for (Symbol const& symbol : symbols)
      if (symbol.name == symbol_name) return {{find_key(symbol.key)}, symbol.note};
  if (dot != std::string_view::npos && is_section(section)) {
    if (Meant const here{like_leaf(leaf, section)}; !here.keys.empty()) return here;
  } else {
    std::vector<std::string_view> whole;
    for (Key const& key : schema()) whole.push_back(key.name);
    if (std::string_view const near = nearest(name, whole); !near.empty()) return {{find_key(near)}};
  }
  return {like_leaf(leaf, {})};
}

/// @param name_of  of a key, in quotes
template <class NameOf>
std::string suggestion(Meant const& meant, NameOf const& name_of) {
  std::string names;
  for (Key const* const key : meant.keys) names += (names.empty() ? "" : " or ") + name_of(*key);
  return names.empty() ? names : "; did you mean " + names + (meant.note.empty() ? "?" : " (" + std::string(meant.note) + ")?");
}

std::string in_quotes(std::string_view name) { return "'" + std::string(name) + "'"; }

}  // namespace

std::string name_suggestion(std::string_view name, std::span<std::string_view const> names) {
  std::string_view const best = nearest(name, names);
  return best.empty() ? std::string() : "; did you mean " + in_quotes(best) + "?";
}

std::string key_suggestion(std::string_view name) {
  return suggestion(meant_by(name), [](Key const& key) { return in_quotes(key.name); });
}

std::string key_suggestion_in(std::string_view section, std::string_view name) {
  return suggestion(meant_by(std::string(section) + "." + std::string(name)), [section](Key const& key) {
    return in_quotes(key.leaf()) + (key.section() == section ? "" : " in [" + std::string(key.section()) + "]");
  });
}

}  // namespace clathra
