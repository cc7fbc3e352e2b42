#include "domain/biaxial/scene_needs.hpp"

#include <map>

#include "domain/biaxial/biaxial_state.hpp"
#include "domain/scene/hydrate.hpp"

namespace clathra {

namespace {

constexpr char const* every_scene = "every scene";
constexpr char const* hydrate = "hydrate.saturation, bond.law";

template <class T>
int bytes_of(Field<T> const&, Precision) {
  return static_cast<int>(sizeof(T));
}
int bytes_of(RealField const&, Precision precision) { return kept_by_discs(precision).bytes(); }

void add_discs(Scene const& scene, Precision precision, std::vector<NeededField>& fields) {
  ParticleSoA particles;
  auto const state = [&](DiscField const& about, auto const& field) {
    if (precision == Precision::mixed && about.mirror_at >= 0) return;
    fields.push_back({about.name, bytes_of(field, precision), FieldOf::disc, every_scene});
  };
  if (precision == Precision::mixed)
    fields.push_back({"mirror", static_cast<int>(2 * DiscMirror::row * sizeof(float)), FieldOf::disc, "run.precision"});
  if (for_gpu && precision == Precision::full)
    fields.push_back({"disc_rows", static_cast<int>(sizeof(DiscRow)), FieldOf::disc, "run.precision on a GPU"});
  for_each_field(particles, state);
  for_each_derived_field(particles, state);
  for (char const* const name : {"x_at_update", "y_at_update"})
    fields.push_back({name, sizeof(Coord), FieldOf::disc, every_scene});
  if (!scene.output.takes_snapshots()) return;
  for (char const* const name : {"start_x", "start_y"})
    fields.push_back({name, sizeof(Coord), FieldOf::disc, "output.snapshots, output.snapshots_at"});
}

void add_accounts(SimulationLaws const& laws, std::vector<NeededField>& fields) {
  std::map<std::string, std::string> const with{{"lost_sliding", "grains.friction, test.wall_friction"},
                                                {"lost_rolling", "grains.rolling_width_factor"},
                                                {"lost_dashpot", "damping.viscous_ratio"},
                                                {"lost_breakage", "hydrate.saturation"},
                                                {"lost_damping", "damping.local"}};
  Dissipation losses;
  for_each_dissipation(losses, laws.losses(), [&](char const* name, Field<Accum> const&, bool needed) {
    if (needed) fields.push_back({name, sizeof(Accum), FieldOf::disc, "output.energy with " + with.at(name)});
  });
}

void add_entries(SimulationLaws const& laws, std::vector<NeededField>& fields) {
  bool const replace = laws.contact.bond_kind == BondKind::replace;
  std::map<std::string, std::string> const keys{{"shear", replace ? "grains.friction, bond.contact_coupling" : "grains.friction"},
                                                {"moment", laws.features().rolling ? "grains.rolling_width_factor" : hydrate},
                                                {"formation_overlap", hydrate},
                                                {"bond_shear", "bond.contact_coupling"},
                                                {"bond_moment", "bond.contact_coupling"},
                                                {"reference_branch", "run.precision"}};
  ContactRows rows;
  HistoryFormat format;
  format.precision = laws.precision;
  fields.push_back({"neighbour", sizeof(int), FieldOf::entry, every_scene});
  for_each_possible_history(
      laws.features(),
      [&](HistoryField const& about, bool needed, RealField const&) {
        if (needed) fields.push_back({about.name, kept(format, about.quantity).bytes(), FieldOf::entry, keys.at(about.name)});
      },
      rows);
  if (laws.features().bonds)
    fields.push_back({"width", kept(format, HistoryField::Quantity::length).bytes(), FieldOf::entry, hydrate});
}

/// The variant of the contact kernel that these laws run, in words.
NeededKernel contact_kernel(Scene const& scene, SimulationLaws const& laws) {
  ContactFeatures const f = laws.features();
  NeededKernel kernel{f.bonds ? "contact_forces_bonded" : "contact_forces", "normal force", every_scene};
  auto const add = [&](bool present, char const* what, char const* key) {
    if (!present) return;
    kernel.does += std::string(", ") + what;
    kernel.asked_by += std::string(", ") + key;
  };
  add(f.shear, "friction", "grains.friction");
  add(f.rolling, "rolling", "grains.rolling_width_factor");
  add(f.bonds, f.separate_bond ? "bonds beside contacts" : "bonds in place of contacts", hydrate);
  add(laws.contact.grain.damping_ratio > 0, "dashpots", "damping.viscous_ratio");
  add(scene.output.energy, "accounts", "output.energy");
  return kernel;
}

}  // namespace

SceneNeeds needs_of(Scene const& scene) {
  constexpr double any_d50 = 1e-4, any_thickness = 1e-5;
  SimulationLaws laws = test_laws(scene, any_d50, has_bonds(scene) ? any_thickness : 0);
  laws.motion.damping = scene.damping.local;
  SceneNeeds needs;
  add_discs(scene, laws.precision, needs.fields);
  if (scene.output.energy) add_accounts(laws, needs.fields);
  if (laws.wall.friction > 0)
    for (char const* const wall : {"shear_left", "shear_right", "shear_bottom", "shear_top"})
      needs.fields.push_back({wall, sizeof(Real), FieldOf::disc, "test.wall_friction, of particles at the walls"});
  add_entries(laws, needs.fields);
  if (scene.output.takes_event_details() && has_bonds(scene))
    needs.fields.push_back({"break_details", sizeof(BreakDetails) + sizeof(Coord), FieldOf::bond,
                            "output.event_details, written where bonds break"});
  bool const damped = laws.motion.damping > 0;
  needs.kernels.push_back(
      {"kick_and_drift", damped ? "leapfrog, local damping" : "leapfrog", damped ? "every scene, damping.local" : every_scene});
  needs.kernels.push_back(contact_kernel(scene, laws));
  needs.kernels.push_back({"wall_forces", laws.wall.friction > 0 ? "four walls, friction" : "four walls",
                           laws.wall.friction > 0 ? "every scene, test.wall_friction" : every_scene});
  return needs;
}

}  // namespace clathra
