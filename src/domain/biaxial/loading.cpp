/// The loading of a test: how its stages begin, and what walls and discs are given for them.
#include <algorithm>
#include <cmath>

#include "domain/biaxial/biaxial_state.hpp"
#include "domain/generation/equilibration.hpp"
#include "domain/scene/hydrate.hpp"
#include "domain/scene/scene_laws.hpp"
#include "domain/scene/short_number.hpp"

namespace clathra {

namespace {

/// Cap on the speed of the servo walls over that of a platen. A brittle specimen that fails widens ten times as fast as the
/// platens close it; at 4 such walls let sigma_3 rise by 70 % over a burst of breaking bonds.
constexpr double largest_lateral_speed = 40;

constexpr double elastic_lateral_ratio = 0.25;  // lateral expansion per axial compression at the start: the servo's first guess

}  // namespace

TestValues BiaxialTest::State::values() const {
  WallStress const stress = simulation->assembly().stress();
  return {simulation->assembly().time() - start_time, path(), eps1(), eps_v(), stress.y, stress.x};
}

/// The laws of the loading, its first stage, and the accounts.
void BiaxialTest::State::begin_loading() {
  Simulation& s = *simulation;
  SimulationLaws laws = s.assembly().laws;
  laws.motion.damping = scene.damping.local;
  s.set_laws(laws);
  s.choose_time_step(scene.run.step_choice());
  double const frequency = s.assembly().largest_frequency();
  preparation["time_step_s"] = s.time_step;
  double const damped = 2 / std::sqrt(1 + scene.damping.local);
  preparation["time_step_margin"] = frequency > 0 ? damped / frequency / s.time_step : 0;
  preparation["time_step_limit_s"] = s.assembly().stable_limit();
  preparation["added_mass_share"] = s.assembly().facts.added_mass;
  count_from_here(stages.front().name.c_str());
  preparation["quasi_static"] = preparation.at("at_rest");
  begin_stage(0);
  if (scene.run.scales_masses_further()) warnings.push_back(text_of_scaling());
  if (scene.output.energy) s.set_ledger(true);
  record_interval = planned_path(scene) / scene.output.records;
  if (scene.output.takes_event_details() && has_bonds(scene)) s.keep_breaks(BreakRecord::details);
  events_taken = static_cast<int>(s.assembly().break_events(0).size());
  int const broken = s.assembly().broken_bonds();
  if (scene.output.takes_snapshots()) s.mark_start();
  s.watch_deviator();
  preparation["broken_in_consolidation"] = broken;
  constexpr double many = 0.2;
  if (broken > many * static_cast<double>(bonds0))
    warnings.push_back(short_number(100.0 * broken / static_cast<double>(bonds0)) +
                       " % of the bonds broke before the test: the specimen is no longer the one that was bonded");
  preparation["bytes_per_particle"] = static_cast<double>(ranks.sum(static_cast<std::int64_t>(s.bytes()))) / s.assembly().discs();
  preparation["strain_rate_per_s"] = rate.strain_rate;
  if (rate.share < 1) preparation["rate_share"] = rate.share;
  if (scene.output.energy) start = energy();
}

/// Platens, discs and servo are set in motion together, so that a stage starts without a wave.
void BiaxialTest::State::begin_stage(std::int64_t index) {
  if (stages[static_cast<std::size_t>(index)].forms_hydrate) form_hydrate();
  Assembly const& a = simulation->assembly();
  StrainRates const present = index > 0 ? present_rates() : StrainRates{};
  StagePlace next;
  next.index = index;
  next.first_step = a.steps();
  if (index > 0) {
    next.start = values();
    next.path_before = next.start.path;
  } else {
    next.start = {0, 0, 0, 0, a.stress().y, a.stress().x};
  }
  next.turned_at = next.start.eps1;
  next.hydrate_at_start = hydrate;
  next.looked = next.start;
  place = next;
  place.sense = now().vertical.has_rate() ? now().vertical.sense() : 0;
  stage = now().name;
  rate = rate_numbers(scene, now(), d50, a.walls().height(), a.void_ratio(), a.facts.added_mass);
  for (std::string const& warning : check_rate(scene, rate))
    if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end()) warnings.push_back(warning);
  require_end_ahead();
  set_in_motion(present);
  put_increment_on();
  watch = {};
  last_row = place.start;
  began_quasi_static = preparation.at("quasi_static") == 1 && is_quasi_static(scene, rate);
  preparation["quasi_static"] = began_quasi_static ? 1 : 0;
}

/// @throws Refused where a rate leads away from the axial strain that alone ends the stage
void BiaxialTest::State::require_end_ahead() const {
  StageEnd const& end = now().until;
  StageEnd others = end;
  others.axial_strain = not_given;
  if (place.sense == 0 || now().turn.any() || !is_given(end.axial_strain) || others.any()) return;
  if (place.sense * (end.axial_strain - place.start.eps1) > 0) return;
  throw Refused("stage '" + now().name + "' begins at an axial strain of " + short_number(100 * place.start.eps1, 4) +
                " % and goes away from " + short_number(100 * end.axial_strain, 4) + " %, where it is to end");
}

/// How the box closes now: servo walls go on at the speed that has held their stress.
StrainRates BiaxialTest::State::present_rates() const {
  Loading const& loading = simulation->assembly().now.walls.loading;
  Walls const& walls = simulation->assembly().walls();
  auto const of = [](AxisDrive const& drive, double span) {
    if (drive.kind == AxisDrive::Kind::rate) return drive.strain_rate;
    return drive.kind == AxisDrive::Kind::hold ? 0 : 2 * drive.integral / span;
  };
  StrainRates rates{of(loading.x, walls.width()), of(loading.y, walls.height())};
  if (loading.x.follows_area()) rates.lateral = -rates.vertical;
  if (loading.y.follows_area()) rates.vertical = -rates.lateral;
  return rates;
}

/// Whether the walls press with a stress already, so that it is to be held.
bool BiaxialTest::State::is_on(double stress, bool lateral) const {
  constexpr double near = 0.02;
  WallStress const present = simulation->assembly().stress();
  return std::abs((lateral ? present.x : present.y) / stress - 1) < near;
}

/// @param strain_rate  of a side that has one, closing positive [1/s];  @param present  motion, which a servo takes over
AxisDrive BiaxialTest::State::drive_of(SideScene const& side, double strain_rate, bool lateral,
                                       StrainRates const& present) const {
  Assembly const& a = simulation->assembly();
  double const span = lateral ? a.walls().width() : a.walls().height(), going = lateral ? present.lateral : present.vertical;
  SideScene const& other = lateral ? now().vertical : now().lateral;
  if (side.hold) return AxisDrive::held();
  if (side.has_rate()) return AxisDrive::at_rate(strain_rate);
  WallStress const stress = a.stress();
  double const opposite = lateral ? a.walls().height() : a.walls().width(),
               answering = largest_lateral_speed * 0.5 * rate.strain_rate * opposite;
  double const servo_speed = other.has_rate() ? -0.5 * elastic_lateral_ratio * signed_rate(other) * span : 0.5 * going * span;
  if (side.follow == Follow::constant_volume) {
    if (side.fluid_modulus == 0) return AxisDrive::at_constant_area(a.area());
    double const porosity = a.void_ratio() / (1 + a.void_ratio()), stiffness = side.fluid_modulus / porosity,
                 own = lateral ? stress.x : stress.y;
    if (stiffness > packing_modulus(a.laws.contact.grain))
      return AxisDrive::at_area_of_fluid(a.area(), stiffness, own, wave_transit(*simulation));
    AxisDrive drive = AxisDrive::at_stress_of_fluid(a.area(), stiffness, own, answering);
    drive.integral = servo_speed;
    return drive;
  }
  // A servo that holds a stress may outrun a platen; one that puts a load on may not.
  bool const holds = other.has_rate() || side.follow != Follow::nothing || is_on(side.stress, lateral);
  double const cap = holds ? answering : 0.5 * rate.strain_rate * span;
  AxisDrive drive = AxisDrive::at_stress(side.stress, cap);
  if (side.follow == Follow::constant_mean_stress) {
    drive =
        AxisDrive::at_constant_mean(0.5 * (stress.x + stress.y), lateral ? stress.y : stress.x, wave_transit(*simulation), cap);
  }
  drive.integral = servo_speed;
  return drive;
}

/// The rate of a side that has one, closing positive [1/s].
double BiaxialTest::State::signed_rate(SideScene const& side) const {
  bool const vertical = &side == &now().vertical;
  return (vertical ? place.sense : side.sense()) * rate.strain_rate;
}

void BiaxialTest::State::set_in_motion(StrainRates const& present) {
  SideScene const &vertical = now().vertical, &lateral = now().lateral;
  double const rate_y = vertical.has_rate() ? signed_rate(vertical) : 0, rate_x = lateral.has_rate() ? signed_rate(lateral) : 0;
  // What the specimen will be closing at, as far as is known: a pair that answers begins elastically.
  auto const motion = [](SideScene const& side, double own, SideScene const& other, double of_other, double present_one) {
    if (side.has_rate()) return own;
    if (side.hold) return 0.0;
    if (side.follow == Follow::constant_volume && side.fluid_modulus == 0) return -of_other;
    return other.has_rate() ? -elastic_lateral_ratio * of_other : present_one;
  };
  StrainRates next;
  next.vertical = motion(vertical, rate_y, lateral, rate_x, present.vertical);
  next.lateral = motion(lateral, rate_x, vertical, next.vertical, present.lateral);
  bool const books = scene.output.energy && place.index + place.turns > 0;  // the first motion comes before the ledger
  double const kinetic = books ? measures().kinetic : 0;
  simulation->drive(drive_of(lateral, rate_x, true, present), drive_of(vertical, rate_y, false, present),
                    next.lateral - present.lateral, next.vertical - present.vertical);
  measured_after = -1;
  if (books) work_of_turns += measures().kinetic - kinetic;
}

/// The rate turns round.
void BiaxialTest::State::reverse() {
  StrainRates const present = present_rates();
  place.turn(eps1());
  place.sense = -place.sense;
  ++place.turns;
  set_in_motion(present);
}

/// The next of the equal factors, one or more, by which a stress goes from that of the beginning to its target.
void BiaxialTest::State::put_increment_on() {
  place.checks_at_rest = 0;
  place.increment_is_due = false;
  place.increment_began = simulation->assembly().steps();
  if (now().hydrate.any() && place.increment > 0) return put_hydrate_on();  // under all of the stress
  ++place.increment;
  double const part = now().hydrate.any() ? 1 : static_cast<double>(place.increment) / now().increments;
  auto const put_on = [part](AxisDrive& drive, double from, SideScene const& side) {
    if (!side.has_stress()) return;
    drive.target_stress = part >= 1 ? side.stress : std::max(from, 1.0) * std::pow(side.stress / std::max(from, 1.0), part);
  };
  put_on(simulation->loading().x, place.start.sigma3, now().lateral);
  put_on(simulation->loading().y, place.start.sigma1, now().vertical);
}

}  // namespace clathra
