/// How a stage of the loading goes on, and how it ends.
#include <algorithm>
#include <cmath>
#include <utility>

#include "domain/biaxial/biaxial_state.hpp"
#include "domain/generation/equilibration.hpp"
#include "domain/scene/short_number.hpp"

namespace clathra {

namespace {

constexpr std::int64_t steps_between_looks = 200;
constexpr std::int64_t checks_to_rest = 3;    // on end
constexpr RestCriterion rest_of_increment{};  // that of specimens
constexpr double stress_of_look = 0.05;       // of the confining stress, that q or p changes by between two rows
constexpr char no_stress_left[] = "no effective stress";
constexpr double rounding = 1e-9;  // of a strain, which is the sum of many steps

/// Of a dead load: what is called failure where it lasts longer than so many transits of a compression wave.
constexpr double failed_strain = 0.2, failed_inertia = 1e-3, failed_stress = 0.05, failed_rise = 0.01, transits = 10;

void add_hydrate(StageRecord& numbers, std::string const& when, HydrateState const& state) {
  numbers[when + "_temperature_degC"] = state.temperature;
  numbers[when + "_pore_pressure_Pa"] = state.pore_pressure;
  numbers[when + "_saturation"] = state.saturation;
}

/// Whether a value that began on one side of a mark has come to it.
bool has_come_to(double mark, double start, double value, double slack) {
  return is_given(mark) && (start < mark ? value >= mark - slack : value <= mark + slack);
}

/// Closes a range at a mark that it must not pass.
void bound(OpenRange& range, double mark, double start) {
  if (!is_given(mark)) return;
  if (start < mark)
    range.high = std::min(range.high, mark);
  else
    range.low = std::max(range.low, mark);
}

}  // namespace

bool BiaxialTest::State::looks() const { return place.sense == 0 || now().minds_stress(); }

std::int64_t BiaxialTest::State::steps_to_look() const {
  if (!looks()) return std::numeric_limits<std::int64_t>::max();
  return steps_between_looks - (simulation->assembly().steps() - place.first_step) % steps_between_looks;
}

/// Between these there is nothing to be seen to. The height is a hair off for the rounding, which costs a look at most.
StepLimits BiaxialTest::State::limits(double pause_at) const {
  StepLimits limits;
  StageEnd const& end = now().until;
  if (place.sense != 0) {
    double const longest = end.path > 0 ? end.path * (1 - rounding) : longest_path,
                 within = std::min({watch.next(), next_record() - place.path_before, pause_at - place.path_before, longest});
    double mark = place.eps1_at(within);
    if (auto const& turns = now().turn.axial_strain; !turns.empty())
      mark = place.sense > 0 ? std::min(mark, turns.back()) : std::max(mark, turns.front());
    if (place.sense > 0)
      limits.height.low = height0 * std::exp(-mark) * (1 + 1e-12);
    else
      limits.height.high = height0 * std::exp(-mark) * (1 - 1e-12);
  }
  if (is_given(end.axial_strain)) {
    bool const closing = place.start.eps1 < end.axial_strain;
    double const last = end.axial_strain * (1 - rounding);
    if (closing)
      limits.height.low = std::max(limits.height.low, height0 * std::exp(-last) * (1 + 1e-12));
    else
      limits.height.high = std::min(limits.height.high, height0 * std::exp(-last) * (1 - 1e-12));
  }
  if (is_given(end.volumetric_strain))
    bound(limits.area, area0 * std::exp(-end.volumetric_strain), area0 * std::exp(-place.start.eps_v));
  bound(limits.deviator, end.deviator_stress, place.start.q());
  bound(limits.mean, end.mean_stress, place.start.p());
  bound(limits.ratio, end.stress_ratio, place.start.q() / place.start.p());
  if (auto const& turns = now().turn.deviator_stress; !turns.empty()) {
    if (place.sense > 0)
      limits.deviator.high = std::min(limits.deviator.high, turns.back());
    else
      limits.deviator.low = std::max(limits.deviator.low, turns.front());
  }
  limits.of_stress = now().minds_stress();
  return limits;
}

/// Makes at most so many steps. What is looked at, and when, does not depend on how many.
bool BiaxialTest::State::advance(std::int64_t most_steps, double pause_at) {
  if (place.over && !is_last()) {
    begin_stage(place.index + 1);
    return true;
  }
  Simulation& s = *simulation;
  for (std::int64_t const last = s.assembly().steps() + most_steps; s.assembly().steps() < last;) {
    if (place.increment_is_due) put_increment_on();
    s.step(std::min(last - s.assembly().steps(), steps_to_look()), limits(pause_at));
    bool const is_look = steps_to_look() == steps_between_looks, stopped = s.assembly().now.stop == StepStop::at_limit;
    if (looks() && !is_look && !stopped) continue;
    if (watch.due(place.path_within(eps1()))) check();
    bool due = record_is_due();
    if (due && path() >= next_record()) ++records_due;
    if (turn_is_due()) {
      reverse();
      due = true;
    }
    if (looks() && is_look) due = look() || due;
    if (auto const end = end_reached()) {
      end_stage(*end);
      due = true;
    }
    if (!due && path() < pause_at) continue;
    s.assembly().throw_if_unstable();
    return due;
  }
  return false;
}

/// Of the path; where somebody looks, of the stresses, too. Stresses that are put on in increments have a row at the end of each.
bool BiaxialTest::State::record_is_due() const {
  if (now().increments > 1) return false;
  if (path() >= next_record()) return true;
  if (!looks()) return false;
  TestValues const v = values();
  return std::max(std::abs(v.q() - last_row.q()), std::abs(v.p() - last_row.p())) > stress_of_look * scene.test.confining_stress;
}

bool BiaxialTest::State::turn_is_due() const {
  StageTurn const& turn = now().turn;
  auto const passed = [&](std::vector<double> const& marks, double value, double slack) {
    if (marks.empty()) return false;
    return place.sense > 0 ? value >= marks.back() - slack : value <= marks.front() + slack;
  };
  return passed(turn.axial_strain, eps1(), rounding * std::abs(scene.test.axial_strain)) ||
         passed(turn.deviator_stress, values().q(), 0);
}

/// Every now and then where walls are steered. @return whether a row is due
bool BiaxialTest::State::look() {
  if (place.sense != 0) return false;
  TestValues const last = std::exchange(place.looked, values());
  double const vertical = place.looked.eps1 - last.eps1, lateral = place.looked.eps_v - last.eps_v - vertical,
               time = place.looked.time - last.time;
  double const strain_rate = time > 0 ? std::max(std::abs(vertical), std::abs(lateral)) / time : 0;  // on the average
  look_for_failure(strain_rate);
  place.turn(eps1());
  if (!now().has_stress_only()) return false;
  place.checks_slow = time > 0 && strain_rate < now().until.strain_rate ? place.checks_slow + 1 : 0;
  look_at_rest();
  return place.increment_is_due;
}

/// Whether the specimen rests under the stresses that are on; then the next increment is due. @throws Refused where it does not
/// within test.consolidation_steps
void BiaxialTest::State::look_at_rest() {
  Loading const& loading = simulation->assembly().now.walls.loading;
  auto const wanted = [](AxisDrive const& drive) {
    return drive.kind == AxisDrive::Kind::stress ? drive.target_stress : not_given;
  };
  std::string const why = unrest(*simulation, measures(), {wanted(loading.x), wanted(loading.y)}, rest_of_increment);
  place.checks_at_rest = why.empty() ? place.checks_at_rest + 1 : 0;
  bool const last = is_last_increment();
  bool rests = place.checks_at_rest >= checks_to_rest;
  if (!rests && !place.failed && now().until.rest &&
      simulation->assembly().steps() - place.increment_began >= scene.test.consolidation_steps) {
    std::string const text = "stage '" + now().name + "' did not come to rest within " +
                             std::to_string(scene.test.consolidation_steps) + " steps" + hydrate_words(hydrate) + ": " + why;
    if (!now().allow_unsettled && !scene.run.ignore_guards)
      throw Refused(text + "; test.consolidation_steps gives it more, allow_unsettled = true goes on" + ignore_hint);
    warnings.push_back(text);
    place.unsettled = rests = true;
    began_quasi_static = false;
    preparation["quasi_static"] = 0;
    if (last) place.checks_at_rest = checks_to_rest;
  }
  if (rests && last && !now().until.rest && now().until.strain_rate == 0)
    throw Refused("stage '" + now().name + "' has come to rest under its stresses without coming to its end");
  place.increment_is_due = rests && !last;
}

bool BiaxialTest::State::has_strained_far() const { return eps1() - place.start.eps1 >= failed_strain * (1 - rounding); }

/// The state where a specimen fails, or may begin to.
void BiaxialTest::State::fail_here() {
  TestValues const v = values();
  place.failed = true;
  place.failed_eps1 = v.eps1;
  place.failed_q = v.q();
  place.failed_p = v.p();
  place.hydrate_failed = hydrate;
}

/// A dead load that the specimen does not bear: the state where that began is kept, and the stage goes on.
void BiaxialTest::State::look_for_failure(double strain_rate) {
  if (place.failed || !bears_dead_load()) return;
  Assembly const& a = simulation->assembly();
  TestValues const v = values();
  AxisDrive const& load = a.now.walls.loading.y;
  double const inertia = strain_rate * d50 * std::sqrt(a.facts.moving_density() / std::max(v.p(), 1.0));
  bool const at_cap = std::abs(a.walls().velocity[bottom]) >= 0.999 * load.largest_speed;
  bool const failing = inertia > failed_inertia || (at_cap && v.sigma1 < (1 - failed_stress) * load.target_stress);
  if (has_strained_far()) return fail_here();
  bool const rising = v.sigma1 > place.risen_to + failed_rise * load.target_stress;
  if (rising) place.risen_to = v.sigma1;
  if (!failing || rising) {  // while the load is being put on the platens are at their largest speed, too
    place.failing_since = -1;
    return;
  }
  if (place.failing_since < 0) {
    fail_here();
    place.failing_since = v.time;
  }
  place.failed = v.time - place.failing_since > transits * wave_transit(*simulation);
}

/// What the stage ends by, if it does. @throws Refused where it has gone a long way without coming to anything that is stated
std::optional<std::string> BiaxialTest::State::end_reached() const {
  StageEnd const& end = now().until;
  TestValues const v = values(), &first = place.start;
  double const within = place.path_within(v.eps1);
  if (has_come_to(end.axial_strain, first.eps1, v.eps1, rounding * std::abs(end.axial_strain))) return "axial strain";
  if (has_come_to(end.volumetric_strain, first.eps_v, v.eps_v, rounding * std::abs(end.volumetric_strain)))
    return "volumetric strain";
  if (has_come_to(end.deviator_stress, first.q(), v.q(), 0)) return "deviator stress";
  if (has_come_to(end.mean_stress, first.p(), v.p(), 0)) return "mean stress";
  if (has_come_to(end.stress_ratio, first.q() / first.p(), v.q() / v.p(), 0)) return "stress ratio";
  if (end.cycles > 0 && place.turns >= 2 * end.cycles) return "cycles";
  if (end.path > 0 && within >= end.path * (1 - rounding)) return "path";
  bool const last = is_last_increment();
  if (has_lost_stress()) return no_stress_left;
  if (now().hydrate.any() && place.failed && v.eps1 - first.eps1 >= failed_strain) return "failed";
  if (end.strain_rate > 0 && last && place.checks_slow >= checks_to_rest) return "strain rate";
  if ((end.rest || end.strain_rate > 0) && last && place.checks_at_rest >= checks_to_rest)
    return place.unsettled ? "steps, not at rest" : "rest";
  double const lateral = std::abs((v.eps_v - v.eps1) - (first.eps_v - first.eps1));
  if (end.path == 0 && std::max(within, place.sense == 0 ? lateral : 0) >= longest_path)
    throw Refused("stage '" + now().name + "' has not come to its end within a path of " + short_number(100 * longest_path) +
                  " %: what it is to end by cannot be reached, or needs a longer until.path");
  return {};
}

void BiaxialTest::State::end_stage(std::string const& ended_by) {
  if (bears_dead_load() && !place.failed && has_strained_far()) fail_here();
  done.push_back(result(ended_by));
  place.over = true;
}

/// Where a dead load was not borne, and that it was not.
void BiaxialTest::State::add_failure(StageResult& result) const {
  StageRecord& numbers = result.numbers;
  numbers["failed_eps1"] = place.failed_eps1;
  numbers["failed_q_Pa"] = place.failed_q;
  numbers["failed_p_Pa"] = place.failed_p;
  if (now().hydrate.any()) add_hydrate(numbers, "failed", place.hydrate_failed);
  result.warnings.push_back("the specimen failed under its dead load at an axial strain of " +
                            short_number(100 * place.failed_eps1) + " %" + hydrate_words(place.hydrate_failed) +
                            "; the platens have a largest speed, so that its collapse is paced");
}

StageResult BiaxialTest::State::result(std::string const& ended_by) const {
  constexpr double said = 0.01, least_said = 1e-3;  // of the strain that was asked for; a strain
  TestValues const v = values(), &first = place.start;
  StageResult result{now().name, ended_by, watch.record(), watch.warnings(bonds0 > 0, preparation.at("at_rest") == 1)};
  StageRecord& numbers = result.numbers;
  numbers["steps"] = static_cast<double>(simulation->assembly().steps() - place.first_step);
  numbers["path"] = place.path_within(v.eps1);
  numbers["quasi_static"] = preparation.at("quasi_static");
  numbers["time_step_renewals"] = static_cast<double>(simulation->time_steps().updates());
  numbers["strain_eps1"] = v.eps1 - first.eps1;
  numbers["strain_eps_v"] = v.eps_v - first.eps_v;
  numbers["start_eps1"] = first.eps1;
  numbers["start_sigma1_Pa"] = first.sigma1;
  numbers["start_sigma3_Pa"] = first.sigma3;
  numbers["end_sigma1_Pa"] = v.sigma1;
  numbers["end_sigma3_Pa"] = v.sigma3;
  if (!holds_lateral_stress())
    for (char const* const of_stress : {"sigma3_held", "sigma3_held_to_peak", "sigma3_error", "sigma3_error_to_peak"})
      numbers.erase(of_stress);
  if (place.unsettled) numbers["unsettled"] = 1;
  if (now().hydrate.any()) add_hydrate(numbers, "end", hydrate);
  if (now().turn.any()) numbers["turns"] = static_cast<double>(place.turns);
  if (bears_dead_load() && (place.failed || ended_by == "rest" || ended_by == "strain rate"))
    numbers["failed"] = place.failed ? 1 : 0;
  if (place.failed) add_failure(result);
  if (ended_by == no_stress_left)
    result.warnings.push_back("the effective lateral stress is used up" + hydrate_words(hydrate) +
                              ": what follows of such a specimen is not what a soil does");
  if (bears_dead_load() && !place.failed && ended_by == "axial strain")
    result.warnings.push_back("the stage ends at an axial strain of " + short_number(100 * v.eps1, 3) +
                              " % before the specimen rests: whether it bears its load is not known");
  if (std::string const soft = stiffness_warning_at(scene, watch.largest_sigma1()); !soft.empty())
    result.warnings.push_back(soft);
  if (std::string const problem = collapse(simulation->assembly().void_ratio(), 0); scene.run.ignore_guards && !problem.empty())
    result.warnings.push_back(guard_ignored + problem);
  if (double const wanted = now().until.axial_strain;
      ended_by == "axial strain" && std::abs(v.eps1 - wanted) > said * std::max(std::abs(wanted), least_said))
    result.warnings.push_back("the stage ends at an axial strain of " + short_number(100 * v.eps1, 4) + " %, " +
                              short_number(100 * wanted, 4) +
                              " % was asked for: a single step strains it that far, lower the rate");
  return result;
}

std::vector<StageResult> BiaxialTest::stage_results() const {
  std::vector<StageResult> all = state_->done;
  if (consolidates()) return all;
  if (!state_->place.over) all.push_back(state_->result(""));
  return all;
}

/// As far as can be told: of the end that is nearest.
double BiaxialTest::State::fraction() const {
  if (!consolidation.over) return 0;
  if (place.over && is_last()) return 1;
  StageEnd const& end = now().until;
  TestValues const v = values(), &first = place.start;
  auto const part = [](double mark, double from, double value) {
    return is_given(mark) && mark != from ? (value - from) / (mark - from) : 0;
  };
  double within = std::max({part(end.axial_strain, first.eps1, v.eps1), part(end.volumetric_strain, first.eps_v, v.eps_v),
                            part(end.deviator_stress, first.q(), v.q()), part(end.mean_stress, first.p(), v.p())});
  if (end.cycles > 0) within = std::max(within, 0.5 * static_cast<double>(place.turns) / end.cycles);
  if (now().increments > 1) within = std::max(within, static_cast<double>(place.increment - 1) / now().increments);
  return (static_cast<double>(place.index) + std::clamp(within, 0.0, 1.0)) / static_cast<double>(stages.size());
}

/// Neither where it is on its way to another one.
bool BiaxialTest::State::holds_lateral_stress() const {
  constexpr double near = 0.02;
  double const stress = now().lateral.stress;
  return stress > 0 && now().increments == 1 && std::abs(place.start.sigma3 / stress - 1) < near;
}

/// Masses scaled further than usual must not carry the loads that contacts should: such a test ends.
void BiaxialTest::State::check() {
  double const within = place.path_within(eps1());
  ShearCheck seen = look_at_shear(*simulation, measures(), eps1());
  if (!holds_lateral_stress()) seen.stress_error = 0;
  watch.add(seen);
  if (stage == shear_stage) dilation.check(eps1(), eps_v());
  bool const is_sand = collapse(simulation->assembly().void_ratio(), seen.deep_share).empty();
  preparation["quasi_static"] = began_quasi_static && is_sand && watch.balanced(bonds0 > 0) ? 1 : 0;
  require_grains(seen.deep_share);
  if (!scene.run.scales_masses_further() || watch.is_slow(std::max(scene.test.axial_strain, within)) || scene.run.ignore_guards)
    return;
  throw Refused(watch.of_kinetic_energy() +
                "; scale less (run.rotational_inertia_factor, run.mass_scaled_fraction) or shear slower");
}

}  // namespace clathra
