/// `clathra bond`: every number of one bond, to be checked by hand.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>

#include "domain/scene/hydrate.hpp"
#include "domain/scene/units.hpp"
#include "io/scene/presets.hpp"
#include "io/scene/scene_value.hpp"
#include "io/scene/schema.hpp"
#include "terminal/json_text.hpp"
#include "terminal/option_value.hpp"
#include "terminal/print.hpp"
#include "verbs/verbs.hpp"

namespace clathra {
namespace {

/// Options as text, with units.
struct BondOptions {
  std::string saturation, d50 = "0.1694 mm", r1, r2, gap = "0 um", temperature = "5 degC", pore_pressure = "8 MPa";
  std::string density = "0.9 g/cm^3", normal_force = "0 N/m", preset = Scene{}.bond.preset, strength_from;
  bool json = false;
};

double read(char const* option, std::string const& text, Dimension dimension) {
  return option_value(option, [&] { return parse_quantity(text, dimension); });
}

/// The value of an option that is a key of a scene, within what a scene allows.
void set(char const* option, char const* key, std::string const& text, Scene& scene) {
  option_value(option, [&] { set_from_text(*find_key(key), scene, text); });
}

BondCard evaluate(BondOptions const& options) {
  Scene scene;
  scene.bond.preset = options.preset;
  apply_preset(bond_presets().of(options.preset), scene, [](std::string_view) { return false; });
  set("--saturation", "hydrate.saturation", options.saturation, scene);
  set("--temperature", "hydrate.temperature", options.temperature, scene);
  set("--pore-pressure", "hydrate.pore_pressure", options.pore_pressure, scene);
  set("--hydrate-density", "hydrate.density", options.density, scene);
  if (!options.strength_from.empty())
    scene.bond.strength_from = options.strength_from == "printed" ? StrengthFrom::printed : StrengthFrom::conditions;
  double const d50 = read("--d50", options.d50, Dimension::length);
  double const r1 = options.r1.empty() ? d50 / 2 : read("--r1", options.r1, Dimension::length);
  double const r2 = options.r2.empty() ? r1 : read("--r2", options.r2, Dimension::length);
  double const gap = read("--gap", options.gap, Dimension::length);
  double const force = read("--normal-force", options.normal_force, Dimension::line_force);
  for (auto const& [option, length] : {std::pair{"--d50", d50}, {"--r1", r1}, {"--r2", r2}})
    if (!(length > 0)) throw SceneProblems({{option, 0, 0, "must be above 0"}});
  if (std::string const problem = stability_problem(scene.hydrate); !problem.empty()) print_error("note: " + problem);
  if (std::string const problem = hydrate_problem(scene.hydrate); !problem.empty()) print_error("note: " + problem);
  if (std::string const warning = fit_warning(scene.hydrate); !warning.empty()) print_error("note: " + warning);
  if (std::string const warning = saturation_warning(scene.hydrate.saturation); !warning.empty()) print_error("note: " + warning);
  return evaluate_bond(scene, d50, r1, r2, gap, force);
}

/// Visits every number of the card but `bonded`: key, value, unit, what it is.
template <class Visit>
void for_each_number(BondCard const& card, Visit&& visit) {
  visit("h_max", card.h_max, "m", "critical thickness (Eq. 3)");
  visit("common_radius", card.common_radius, "m", "2 r1 r2 / (r1 + r2)");
  visit("gap", card.thickness, "m", "bond thickness h_cr: the gap, 0 for an overlap");
  visit("B", card.B, "m", "bond width (Eq. 2)");
  visit("h0", card.h0, "m", "effective thickness");
  visit("area", card.area, "m^2", "of the bond in the plane (Eq. 5)");
  visit("q_c", card.q_c, "Pa", "compressive strength of hydrate (Eq. 13a)");
  visit("q_t", card.q_t, "Pa", "tensile strength of hydrate (Eq. 13b)");
  visit("E_m", card.E_m, "Pa", "modulus of hydrate (Eq. 18)");
  visit("R_t", card.R_t, "N/m", "tensile strength of the bond (Eq. 15a)");
  visit("R_c", card.R_c, "N/m", "compressive strength of the bond (Eq. 15b)");
  visit("k_mh", card.k_mh, "N/m/m", "stiffness of the hydrate (Eq. 17)");
  visit("k_bn", card.k_bn, "N/m/m", "normal stiffness of the bond (Eq. 19)");
  visit("k_bs", card.k_bs, "N/m/m", "shear stiffness (Eq. 20)");
  visit("k_bm", card.k_bm, "N m/rad/m", "rolling stiffness (Eq. 21)");
  visit("f_s", card.f_s, "", "Eq. 10a");
  visit("K_s", card.K_s, "", "Eq. 10b");
  visit("f_r", card.f_r, "", "Eq. 10c");
  visit("K_r", card.K_r, "", "Eq. 10d");
  visit("R_s", card.R_s, "N/m", "shear strength at the normal force (Eq. 9a)");
  visit("R_r_per_length", card.R_r_per_length, "N/m", "rolling strength over L_r (Eq. 9b)");
}

/// A unit as names of numbers end in it.
std::string_view suffix_of(std::string_view unit) {
  constexpr std::pair<std::string_view, std::string_view> suffixes[] = {
      {"m", "_m"}, {"m^2", "_m2"}, {"Pa", "_Pa"}, {"N/m", "_N_per_m"}, {"N/m/m", "_N_per_m2"}, {"N m/rad/m", "_N_per_rad"},
      {"", ""}};
  return std::find_if(std::begin(suffixes), std::end(suffixes), [&](auto const& s) { return s.first == unit; })->second;
}

nlohmann::ordered_json json_of(BondCard const& card) {
  nlohmann::ordered_json json;
  json["bonded"] = card.bonded;
  for_each_number(card, [&](char const* key, double value, char const* unit, char const*) {
    json[fmt::format("{}{}", key, suffix_of(unit))] = value;
  });
  return json;
}

std::string table_text(BondCard const& card) {
  std::string text = fmt::format("{:<16} {}\n", "bonded", card.bonded ? "yes" : "no");
  for_each_number(card, [&](char const* key, double value, char const* unit, char const* meaning) {
    text += fmt::format("{:<16} {:>13.6g} {:<10} {}\n", key, value, unit, meaning);
  });
  return text;
}

ExitCode bond(BondOptions const& options) {
  BondCard const card = evaluate(options);
  return options.json ? print_json(json_text(json_of(card))) : print_result(table_text(card));
}

}  // namespace

void add_bond(CLI::App& program, Verb& chosen) {
  auto const options = std::make_shared<BondOptions>();
  CLI::App* const verb = program.add_subcommand("bond", "Evaluate the bond law between two particles");
  verb->add_option("--saturation", options->saturation, "hydrate saturation, 0.41 or \"41 %\"")->required();
  verb->add_option("--d50", options->d50, "median diameter of the sand")->capture_default_str();
  verb->add_option("--r1", options->r1, "radius of the first particle (default: d50/2)");
  verb->add_option("--r2", options->r2, "radius of the second particle (default: r1)");
  verb->add_option("--gap", options->gap, "distance of the surfaces; an overlap is negative")->capture_default_str();
  verb->add_option("--temperature", options->temperature, "temperature")->capture_default_str();
  verb->add_option("--pore-pressure", options->pore_pressure, "pore pressure")->capture_default_str();
  verb->add_option("--hydrate-density", options->density, "density of the hydrate")->capture_default_str();
  verb->add_option("--normal-force", options->normal_force, "normal bond force per metre, compression positive")
      ->capture_default_str();
  verb->add_option("--preset", options->preset, "bond.preset: model of what Jiang et al. (2017) leave open")
      ->capture_default_str()
      ->check(CLI::IsMember(std::vector<std::string>(bond_presets().names.begin(), bond_presets().names.end())));
  verb->add_option(
          "--strength-from", options->strength_from,
          "bond.strength_from: as printed (Eq. 15), or of temperature, pressure and density (Eq. 13) (default: the preset's)")
      ->check(CLI::IsMember({"printed", "conditions"}));
  verb->add_flag("--json", options->json, "one JSON object, SI units");
  verb->footer("Example: clathra bond --saturation 0.41 --gap \"2 um\" --normal-force \"200 N/m\"");
  verb->callback([options, &chosen] { chosen = [options] { return bond(*options); }; });
}

}  // namespace clathra
