#include "io/scene/readings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "io/scene/scene_value.hpp"

namespace clathra {
namespace {

// clang-format off
constexpr Reading table[] = {
  {"calibrated", "what fits the words of the seed paper best: hydrate forms under the confining stress; bonds act beside the grain contact and bend up to a quarter more than the plastic moment of their section, L_r = B/4; a grain is twice as stiff as a contact; half the rolling width of the text calibrates the sand",
   {{{"grains.shape_factor", "1"}, {"grains.particle_stiffness_ratio", "2"}, {"bond.composite", "parallel"}, {"bond.moment_scale", "similitude"}, {"bond.moment_ratio", "0.25"},
     {"bond.rod_thickness", "printed"}, {"bond.friction_floor", "false"}, {"bond.coefficients", "thm"}, {"bond.after_consolidation", "true"}}}},
  {"first_crack", "bonds fail in bending when their section cracks, L_r = B/14; hydrate forms at 50 kPa; stiffness of grains and rolling width of the text",
   {{{"grains.shape_factor", "2"}, {"grains.particle_stiffness_ratio", "1"}, {"bond.composite", "parallel"}, {"bond.moment_scale", "similitude"}, {"bond.moment_ratio", "0.07142857142857142"},
     {"bond.rod_thickness", "printed"}, {"bond.friction_floor", "false"}, {"bond.coefficients", "thm"}, {"bond.after_consolidation", "false"}}}},
  {"long_lever", "runner-up: as `calibrated`, but grains as stiff as contacts, L_r = B/3 and bond thicknesses scaled from grain to rod",
   {{{"grains.shape_factor", "1"}, {"grains.particle_stiffness_ratio", "1"}, {"bond.composite", "parallel"}, {"bond.moment_scale", "similitude"}, {"bond.moment_ratio", "0.3333333333333333"},
     {"bond.rod_thickness", "scaled"}, {"bond.friction_floor", "false"}, {"bond.coefficients", "thm"}, {"bond.after_consolidation", "true"}}}},
  {"short_lever", "runner-up: as `calibrated`, but grains as stiff as contacts and L_r = B/7",
   {{{"grains.shape_factor", "1"}, {"grains.particle_stiffness_ratio", "1"}, {"bond.composite", "parallel"}, {"bond.moment_scale", "similitude"}, {"bond.moment_ratio", "0.14285714285714285"},
     {"bond.rod_thickness", "printed"}, {"bond.friction_floor", "false"}, {"bond.coefficients", "thm"}, {"bond.after_consolidation", "true"}}}},
  {"replacing", "runner-up: bonds replace the grain contact at 50 kPa, L_r = B/14, bond thicknesses scaled from grain to rod",
   {{{"grains.shape_factor", "1"}, {"grains.particle_stiffness_ratio", "1"}, {"bond.composite", "replace"}, {"bond.moment_scale", "similitude"}, {"bond.moment_ratio", "0.07142857142857142"},
     {"bond.rod_thickness", "scaled"}, {"bond.friction_floor", "false"}, {"bond.coefficients", "thm"}, {"bond.after_consolidation", "false"}}}},
  {"literal", "the text as printed: a bond replaces the grain contact, L_r = 1 m, the strengths of Eq. 15",
   {{{"grains.shape_factor", "2"}, {"grains.particle_stiffness_ratio", "1"}, {"bond.composite", "replace"}, {"bond.moment_scale", "paper_si"}, {"bond.moment_ratio", "0.07142857142857142"},
     {"bond.rod_thickness", "printed"}, {"bond.friction_floor", "false"}, {"bond.coefficients", "printed"}, {"bond.after_consolidation", "false"}}}},
};
// clang-format on

constexpr auto names = [] {
  std::array<std::string_view, std::size(table)> all;
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = table[i].name;
  return all;
}();

}  // namespace

std::span<Reading const> readings() { return table; }
std::span<std::string_view const> reading_names() { return names; }

Reading const& reading_of(std::string_view name) {
  auto const found = std::find_if(std::begin(table), std::end(table), [&](Reading const& r) { return r.name == name; });
  if (found == std::end(table)) throw std::invalid_argument(fmt::format("no reading is called '{}'", name));
  return *found;
}

void apply_reading(Reading const& reading, Scene& scene, std::function<bool(std::string_view)> const& stated) {
  for (ReadingKey const& said : reading.keys)
    if (!stated(said.key)) set_from_text(*find_key(said.key), scene, said.value);
}

std::string readings_markdown() {
  std::string text;
  for (Reading const& reading : table) text += fmt::format("- `{}`: {}.\n", reading.name, reading.what);
  std::string rule = "|---|";
  text += "\n| key |";
  for (Reading const& reading : table) text += fmt::format(" `{}` |", reading.name), rule += "---|";
  text += "\n" + rule + "\n";
  for (std::size_t k = 0; k < table[0].keys.size(); ++k) {
    text += fmt::format("| `{}` |", table[0].keys[k].key);
    for (Reading const& reading : table) text += fmt::format(" {} |", reading.keys[k].value);
    text += "\n";
  }
  return text;
}

}  // namespace clathra
