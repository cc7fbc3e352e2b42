#include "run/expected_error.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "domain/scene/hydrate.hpp"

namespace clathra {
namespace {

// Peak q of specimens of 2,000 discs at 1 MPa, each compared with itself in the reference of docs/explanation/accuracy.md (I =
// 1e-5, half the step, double precision): what perf/tradeoff/expected_error.py prints of data.csv (local damping 0.3, default
// law, 0.95 of the limit; five to twenty specimens a number).
// clang-format off
constexpr RateEffect rates[] = {
    {2e-05, {0.0002, 0.0032}, {0.0035, 0.0070}},
    {5e-05, {0.0041, 0.0079}, {0.0037, 0.0154}},
    {0.0001, {0.0023, 0.0050}, {0.0072, 0.0062}},
    {0.0002, {0.0074, 0.0050}, {0.0061, 0.0048}},
    {0.0005, {0.0254, 0.0065}, {0.0129, 0.0057}},
    {0.001, {0.0557, 0.0081}, {0.0250, 0.0078}},
    {0.003, {0.1507, 0.0237}, {0.0691, 0.0253}},
    {0.005, {0.3298, 0.0250}, {0.1020, 0.0391}},
};
constexpr SettingEffect mixed = {{0.0020, 0.0036}, {0.0006, 0.0042}};  // of twenty: sand at I = 5e-4, 55 % at 2e-4
// Moments of inertia times 3 beside true ones at the same rate.
constexpr RateEffect heavier_rotation[] = {
    {0.0002, {-0.0009, 0.0057}, {0.0004, 0.0056}},
    {0.001, {0.0117, 0.0314}, {-0.0080, 0.0031}},
};
// clang-format on
constexpr double saturation = 0.55, most_inertia = 3, most_wave = 2, number_slack = 1e-6;

bool are_close(double a, double b) { return std::fabs(a - b) <= number_slack * std::fabs(b); }

std::string text_of(char const* format, double a) {
  char text[160];
  std::snprintf(text, sizeof text, format, a);
  return text;
}

/// Between two rows by the logarithm of the rate.
MeasuredError between(MeasuredError const& a, MeasuredError const& b, double part) {
  return {a.error + part * (b.error - a.error), a.half_width + part * (b.half_width - a.half_width)};
}

/// Of one material at a rate within a table or below it.
MeasuredError error_at(std::span<RateEffect const> table, double rate, MeasuredError RateEffect::*material) {
  auto const above =
      std::find_if(table.begin(), table.end(), [&](auto const& row) { return row.inertial_number * (1 + number_slack) >= rate; });
  if (above == table.begin()) return table.front().*material;
  RateEffect const& slow = *(above - 1);
  if (above == table.end()) return slow.*material;
  double const part = std::log(rate / slow.inertial_number) / std::log(above->inertial_number / slow.inertial_number);
  return between(slow.*material, *above.*material, part);
}

MeasuredError sum(MeasuredError const& a, MeasuredError const& b) {
  return {a.error + b.error, std::hypot(a.half_width, b.half_width)};
}

bool is_faster(double rate, std::span<RateEffect const> table) {
  return rate > table.back().inertial_number * (1 + number_slack);
}

bool is_same(double a, double b) { return a == b || are_close(a, b); }
template <class T>
bool is_same(T const& a, T const& b) {
  return a == b;
}

/// Which scenes a key has an effect in.
enum class Of { all, bonded, made };  // made: whose specimen is not read from a file
bool has_effect(Of which, Scene const& scene) {
  if (which == Of::bonded) return has_bonds(scene);
  return which == Of::all || !scene.specimen.is_read();
}

/// A key of the model, and whether it says the same in two scenes.
struct ModelKey {
  char const* name;
  bool (*same)(Scene const& a, Scene const& b);
  Of which = Of::all;
};
template <auto Section, auto Member>
constexpr bool same_in(Scene const& a, Scene const& b) {
  return is_same((a.*Section).*Member, (b.*Section).*Member);
}
#define CLATHRA_MODEL(section, member) #section "." #member, same_in < &Scene::section, &decltype(Scene::section)::member>

/// All that was the same in every test of the table, beside what it has columns and rows for.
constexpr ModelKey model[] = {
    {CLATHRA_MODEL(grains, density)},
    {CLATHRA_MODEL(grains, normal_stiffness)},
    {CLATHRA_MODEL(grains, shear_stiffness)},
    {CLATHRA_MODEL(bond, grain_stiffness_factor), Of::bonded},
    {CLATHRA_MODEL(grains, friction)},
    {CLATHRA_MODEL(grains, rolling_width_factor)},
    {CLATHRA_MODEL(damping, viscous_ratio)},
    {CLATHRA_MODEL(grading, table), Of::made},
    {CLATHRA_MODEL(grading, file), Of::made},
    {CLATHRA_MODEL(hydrate, temperature), Of::bonded},
    {CLATHRA_MODEL(hydrate, pore_pressure), Of::bonded},
    {CLATHRA_MODEL(hydrate, density), Of::bonded},
    {CLATHRA_MODEL(bond, law), Of::bonded},
    {CLATHRA_MODEL(bond, contact_coupling), Of::bonded},
    {CLATHRA_MODEL(bond, rolling_lever), Of::bonded},
    {CLATHRA_MODEL(bond, thickness_mapping), Of::bonded},
    {CLATHRA_MODEL(bond, friction_floor), Of::bonded},
    {CLATHRA_MODEL(bond, strength_from), Of::bonded},
    {CLATHRA_MODEL(bond, strength_modulus), Of::bonded},
    {CLATHRA_MODEL(bond, critical_thickness_from), Of::bonded},
    {CLATHRA_MODEL(bond, after_consolidation), Of::bonded},
    {CLATHRA_MODEL(specimen, preparation_stress)},
    {CLATHRA_MODEL(test, kind)},
    {CLATHRA_MODEL(test, confining_stress)},
    {CLATHRA_MODEL(test, wall_friction)},
    {CLATHRA_MODEL(test, consolidation_steps)},
    {CLATHRA_MODEL(specimen, width), Of::made},
    {CLATHRA_MODEL(specimen, height), Of::made},
    {CLATHRA_MODEL(specimen, aspect_ratio), Of::made},
    {CLATHRA_MODEL(specimen, generator), Of::made},
    {CLATHRA_MODEL(specimen, compaction_layers), Of::made},
    {CLATHRA_MODEL(specimen, void_ratio_at), Of::made},
    {CLATHRA_MODEL(damping, local)},
    {CLATHRA_MODEL(run, mass_scaled_fraction)},
    {CLATHRA_MODEL(run, time_step_rule)},
};
#undef CLATHRA_MODEL

/// Keys of which more than one value is as good as what was measured: size, void ratio and median diameter of a specimen that is
/// made, and a strain beyond the peak.
std::vector<std::string> other_keys(Scene const& scene) {
  constexpr double void_ratio = 0.24, d50 = 0.1694e-3;
  constexpr std::int64_t fewest = 1000, most = 30000;         // discs: 2,000 were measured, and the default with 20,000
  constexpr double past_the_peak = 0.05, least_step = 0.475;  // half of the usual share of the limit was measured
  std::vector<std::string> keys;
  if (scene.test.axial_strain < past_the_peak) keys.emplace_back("test.axial_strain");
  if (scene.run.step_choice().safety < least_step * (1 - number_slack)) keys.emplace_back("run.time_step_safety");
  if (scene.specimen.is_read()) {
    keys.emplace_back("specimen.file");
    return keys;
  }
  if (std::int64_t const discs = scene.specimen.particles; discs > 0 && (discs < fewest || discs > most))
    keys.emplace_back("specimen.particles");
  bool const box = scene.specimen.width > 0 && scene.specimen.height > 0 && scene.specimen.particles > 0;  // the fourth follows
  if (scene.specimen.void_ratio > 0 ? !are_close(scene.specimen.void_ratio, void_ratio) : box)
    keys.emplace_back("specimen.void_ratio");
  if (scene.grading.d50 > 0 ? !are_close(scene.grading.d50, d50) : box && scene.specimen.void_ratio > 0)
    keys.emplace_back("grading.d50");
  return keys;
}

/// Why the table says nothing of a scene; empty where it does.
std::string out_of_range(Scene const& scene, RateNumbers const& n) {
  Scene const usual;
  std::vector<std::string> keys = other_keys(scene);
  for (ModelKey const& key : model)
    if (has_effect(key.which, scene) && !key.same(scene, usual)) keys.emplace_back(key.name);
  if (!keys.empty()) {
    std::string names;
    for (std::string const& key : keys) names += (names.empty() ? "" : ", ") + key;
    return names;
  }
  if (has_bonds(scene) && scene.hydrate.saturation > saturation * (1 + number_slack)) return "only up to a saturation of 55 %";
  if (scene.run.rotational_inertia_factor > most_inertia * (1 + number_slack)) return "only up to moments of inertia times 3";
  if (is_faster(n.inertial_number, rates)) return text_of("only up to I = %.3g", std::end(rates)[-1].inertial_number);
  if (scene.run.rotational_inertia_factor > 1 && is_faster(n.inertial_number, heavier_rotation))
    return text_of("only up to I = %.3g with heavier rotation", std::end(heavier_rotation)[-1].inertial_number);
  if (n.platen_wave_stress > most_wave * (1 + number_slack)) return text_of("only up to W = %.3g", most_wave);
  return {};
}

/// Of one material.
MeasuredError error_of(RunScene const& run, double rate, MeasuredError RateEffect::*material, MeasuredError const& of_mixed) {
  MeasuredError total = error_at(rates, rate, material);
  if (run.rotational_inertia_factor > 1) total = sum(total, error_at(heavier_rotation, rate, material));
  return run.precision == Precision::mixed ? sum(total, of_mixed) : total;
}

}  // namespace

std::span<RateEffect const> rate_effects() { return rates; }
std::span<RateEffect const> inertia_effects() { return heavier_rotation; }
SettingEffect mixed_precision_effect() { return mixed; }

ExpectedError expected_error(Scene const& scene, RateNumbers const& n) {
  if (std::string why = out_of_range(scene, n); !why.empty()) return {{}, std::move(why)};
  MeasuredError const sand = error_of(scene.run, n.inertial_number, &RateEffect::sand, mixed.sand),
                      bonded = error_of(scene.run, n.inertial_number, &RateEffect::bonded, mixed.bonded);
  auto const farthest = [](MeasuredError const& e) { return std::fabs(e.error) + e.half_width; };
  bool const with_bonds = has_bonds(scene), full = with_bonds && are_close(scene.hydrate.saturation, saturation);
  MeasuredError const worse = farthest(sand) > farthest(bonded) ? sand : bonded;
  ExpectedError result{!with_bonds ? sand : full ? bonded : worse, "2000 particles at 1 MPa"};
  if (with_bonds && !full) result.range += ", the worse of sand and 55 %";
  return result;
}

}  // namespace clathra
