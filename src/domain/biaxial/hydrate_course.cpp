/// Hydrate that changes in a stage: increment, equilibrate, next.
#include <algorithm>
#include <cmath>

#include "domain/biaxial/biaxial_state.hpp"
#include "domain/generation/bonding.hpp"
#include "domain/generation/equilibration.hpp"
#include "domain/scene/hydrate_loss.hpp"
#include "domain/scene/short_number.hpp"
#include "kernels/bond_law.hpp"

namespace clathra {

namespace {

constexpr double most_leaving = 0.02;       // of the mean stress, that bonds carry which leave in one increment
constexpr double least_share = 1.0 / 1024;  // of an increment of equal parts; a single bond of few may carry more
constexpr double least_effective = 0.05;    // of the lateral stress at the beginning

}  // namespace

HydrateScene BiaxialTest::State::hydrate_scene(HydrateState const& state) const {
  HydrateScene scene_now = scene.hydrate;
  scene_now.temperature = state.temperature;
  scene_now.pore_pressure = state.pore_pressure;
  scene_now.saturation = state.saturation;
  return scene_now;
}

BondLaw BiaxialTest::State::bond_law_of(HydrateState const& state) const {
  BondLaw const formed = make_bond_law(scene, d50, simulation->assembly().facts.critical_thickness);
  return changed_bond_law(scene, d50, formed, hydrate_scene(state));
}

/// @param part  of the way of the stage, 0 to 1
HydrateState BiaxialTest::State::hydrate_at(double part) const {
  return HydratePath{scene, d50, simulation->assembly().facts.critical_thickness, now().hydrate, place.hydrate_at_start}.at(part);
}

/// " at 12 degC, 8 MPa and a saturation of 30 %"; nothing in stages that leave the hydrate as it is.
std::string BiaxialTest::State::hydrate_words(HydrateState const& state) const {
  if (!now().hydrate.any()) return {};
  return " at " + short_number(state.temperature, 4) + " degC, " + short_number(state.pore_pressure * 1e-6, 4) +
         " MPa of pore pressure and a saturation of " + short_number(100 * state.saturation, 4) + " %";
}

/// By how much the pore pressure has risen since the stage began, where that is at the cost of the effective stresses [Pa].
double BiaxialTest::State::stress_lost() const {
  return now().hydrate.holds_total_stress() ? hydrate.pore_pressure - place.hydrate_at_start.pore_pressure : 0;
}

bool BiaxialTest::State::has_lost_stress() const {
  double const lateral = now().lateral.has_stress() ? now().lateral.stress : place.start.sigma3;
  return now().hydrate.any() && lateral - stress_lost() < least_effective * lateral;
}

/// The next part of the way, so small that the bonds that leave carry less than 2 % of the mean stress.
void BiaxialTest::State::put_hydrate_on() {
  Assembly const& a = simulation->assembly();
  double const equal = 1.0 / now().increments, mean = std::max(mean_stress(*simulation), 1.0);
  double step = std::min(equal, 1 - place.hydrate_part);
  auto const leaving = [&](double part) {
    return a.laws.contact.bond_kind == BondKind::none
               ? 0
               : a.force_of_leaving_bonds(bond_law_of(hydrate_at(part))) / (a.area() * mean);
  };
  while (step > equal * least_share && leaving(place.hydrate_part + step) > most_leaving) step *= 0.5;
  place.hydrate_part += step;
  if (place.hydrate_part > 1 - 1e-12) place.hydrate_part = 1;
  ++place.increment;
  change_hydrate(hydrate_at(place.hydrate_part));
  auto const put_on = [this](AxisDrive& drive, SideScene const& side) {
    if (side.has_stress()) drive.target_stress = std::max(side.stress - stress_lost(), 1.0);
  };
  put_on(simulation->loading().x, now().lateral);
  put_on(simulation->loading().y, now().vertical);
}

/// The bonds follow; what they hold less of elastic energy goes to an account of its own.
void BiaxialTest::State::change_hydrate(HydrateState const& next) {
  if (next == hydrate) return;
  hydrate = next;
  if (simulation->assembly().laws.contact.bond_kind == BondKind::none) return;
  double const before = accounted_energy();
  simulation->change_hydrate(bond_law_of(next));
  dissolved += before - accounted_energy();
  measured_after = -1;
}

/// Elastic and lost, of contacts and bonds, where there is a ledger [J/m].
double BiaxialTest::State::accounted_energy() {
  if (!simulation->assembly().laws.contact.ledger) return 0;
  Measures const m = simulation->assembly().measures();
  DissipationTotals const lost = simulation->assembly().losses();
  return m.grain_energy + m.bond_energy + lost.sliding + lost.rolling + lost.dashpot + lost.damping + lost.breakage;
}

/// Bonds form where discs are, stress-free; what a coupling lets a bond take over from its contact goes through the same account
/// as what it leaves.
void BiaxialTest::State::form_hydrate() {
  Specimen specimen = simulation->specimen();
  bond_specimen(scene, specimen, preparation, ranks);
  hydrate.saturation = scene.hydrate.saturation;
  if (!(specimen.critical_thickness > 0)) return;
  SimulationLaws const bonded = test_laws(scene, d50, specimen.critical_thickness);
  SimulationLaws laws = simulation->assembly().laws;
  laws.contact.bond_kind = bonded.contact.bond_kind;
  laws.contact.bond = bonded.contact.bond;
  double const before = accounted_energy();
  simulation->form_bonds(specimen, laws);
  dissolved += before - accounted_energy();
  measured_after = -1;
  bonds0 = std::llround(measures().bonded);
}

}  // namespace clathra
