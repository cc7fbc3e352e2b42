#include "io/results/specimen_label.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "domain/scene/hydrate.hpp"
#include "io/errors/problems.hpp"
#include "io/formats/hdf5_file.hpp"
#include "io/results/run_record.hpp"
#include "io/scene/scene_value.hpp"
#include "io/scene/schema.hpp"

namespace clathra {
namespace {

using Json = nlohmann::json;

constexpr double rounding = 1e-12;  // a quantity may have been written in another unit

/// What a label's key says something of.
/// In the label of a specimen whose bonds are no longer those that formed: the names of the stages.
constexpr char hydrate_changed_in[] = "stages that changed the hydrate";

enum class Part {
  making,     ///< how the specimen was made: the scene that reads it cannot change it any more
  stiffness,  ///< may be chosen anew, but the specimen came to rest with it
  bonds,      ///< fixed when bonds form
  climate     ///< in which bonds formed; may be chosen anew
};
struct Item {
  std::string_view key;
  Part part;
};
constexpr Item items[] = {{"specimen.preparation_stress", Part::making},
                          {"run.seed", Part::making},
                          {"grains.normal_stiffness", Part::stiffness},
                          {"grains.shear_stiffness", Part::stiffness},
                          {"hydrate.saturation", Part::bonds},
                          {"hydrate.density", Part::bonds},
                          {"bond.law", Part::bonds},
                          {"bond.contact_coupling", Part::bonds},
                          {"bond.critical_thickness_from", Part::bonds},
                          {"bond.critical_thickness", Part::bonds},
                          {"bond.constant_thickness", Part::bonds},
                          {"bond.strength_from", Part::bonds},
                          {"bond.rolling_lever", Part::bonds},
                          {"bond.thickness_mapping", Part::bonds},
                          {"bond.friction_floor", Part::bonds},
                          {"bond.strength_modulus", Part::bonds},
                          {"bond.strength_seed", Part::bonds},
                          {"hydrate.temperature", Part::climate},
                          {"hydrate.pore_pressure", Part::climate},
                          {"bond.grain_stiffness_factor", Part::climate}};

bool is_of_bonds(Part part) { return part == Part::bonds || part == Part::climate; }

/// Whether a key has a meaning in a scene.
bool has_effect(std::string_view key, Scene const& scene) {
  if (key == "bond.critical_thickness") return scene.bond.critical_thickness_from == CriticalThicknessFrom::given;
  if (key == "bond.strength_seed") return scene.bond.strength_modulus > 0;
  if (key == "bond.constant_thickness") return scene.bond.law == BondLawKind::constant_thickness;
  return true;
}

std::string shown(Key const& key, Scene const& scene) { return unquoted(value_text(key, scene)); }

bool nearly_equal(double a, double b) { return std::abs(a - b) <= rounding * std::max(std::abs(a), std::abs(b)); }

/// Whether a label's text states the value of a scene.
bool states(Key const& key, std::string const& text, Scene const& scene) {
  if (text == shown(key, scene)) return true;
  auto const* const at = std::get_if<double& (*)(Scene&)>(&key.field);
  if (!at) return false;
  Scene then, now = scene;
  try {
    set_from_text(key, then, text);
  } catch (std::invalid_argument const&) {
    return false;
  }
  return nearly_equal((*at)(then), (*at)(now));
}

/// "; hydrate.saturation was 55 %, is 26 %" for each key of a kind with another value.
std::string differences(SceneTexts const& label, Scene const& scene, Part part) {
  std::string text;
  for (Item const& item : items) {
    auto const kept = label.find(std::string(item.key));
    if (item.part != part || kept == label.end() || !has_effect(item.key, scene)) continue;
    Key const& key = *find_key(item.key);
    if (!states(key, kept->second, scene))
      text += fmt::format("{}{} was {}, is {}", text.empty() ? "" : "; ", item.key, kept->second, shown(key, scene));
  }
  return text;
}

std::string micrometres(double length) { return fmt::format("{:.4g} um", length * 1e6); }

/// The saturation to which Eq. 3 gives a critical thickness, as text.
std::string saturation_of(double ratio) {
  if (ratio >= critical_thickness_ratio(0.7)) return "0.7 or more";
  return fmt::format("{:.4g}", (0.4879 - std::sqrt(0.4879 * 0.4879 - 4 * 0.3268 * (0.0815 + ratio))) / (2 * 0.3268));
}

/// What the bonds themselves show to be another scene's: h_max, and whether they act beside the grain contacts.
std::string contradiction(Specimen const& specimen, Scene const& scene) {
  double const h_max = specimen.critical_thickness;
  Key const& saturation = *find_key("hydrate.saturation");
  if (!has_bonds(scene))
    return fmt::format("they have h_max = {}, the scene makes none (hydrate.saturation is {}, bond.law is {})",
                       micrometres(h_max), shown(saturation, scene), shown(*find_key("bond.law"), scene));
  if (specimen.separate_bonds != (scene.bond.contact_coupling == ContactCoupling::parallel))
    return fmt::format("they {}act in parallel to the grain contacts, bond.contact_coupling is {}",
                       specimen.separate_bonds ? "" : "do not ", shown(*find_key("bond.contact_coupling"), scene));
  if (scene.bond.critical_thickness_from == CriticalThicknessFrom::given && !nearly_equal(h_max, scene.bond.critical_thickness))
    return fmt::format("they have h_max = {}, bond.critical_thickness is {}", micrometres(h_max),
                       micrometres(scene.bond.critical_thickness));
  double const wanted = critical_thickness_ratio(scene.hydrate.saturation) * specimen.d50;
  if (scene.bond.critical_thickness_from == CriticalThicknessFrom::saturation && !nearly_equal(h_max, wanted))
    return fmt::format("they have h_max = {}, which Eq. 3 gives at a saturation of {}; hydrate.saturation is {}, which gives {}",
                       micrometres(h_max), saturation_of(h_max / specimen.d50), shown(saturation, scene), micrometres(wanted));
  return {};
}

void require_agreement(std::filesystem::path const& file, Specimen const& specimen, SceneTexts const& label, Scene const& scene) {
  if (!nearly_equal(specimen.density, scene.grains.density))
    throw FileProblem(ExitCode::refused, file,
                      fmt::format("its grains have a density of {}, grains.density is {}: state that of the file",
                                  format_quantity(specimen.density, Dimension::density),
                                  format_quantity(scene.grains.density, Dimension::density)));
  if (!(specimen.critical_thickness > 0)) return;
  for (LoadingStage const& stage : stages_of(scene))
    if (stage.forms_hydrate)
      throw FileProblem(
          ExitCode::refused, file,
          fmt::format("has bonds already, and hydrate is to form in the stage '{}': take a specimen without bonds", stage.name));
  if (auto const changed = label.find(hydrate_changed_in); changed != label.end())
    throw FileProblem(ExitCode::refused, file,
                      fmt::format("its hydrate changed in the stages {}, and the file has the thickness with which its bonds "
                                  "formed: they would be stronger than they were left. Go on with that run itself (--resume), or "
                                  "take a specimen without bonds; --ignore-guards does not help",
                                  changed->second));
  std::string different = differences(label, scene, Part::bonds);
  if (different.empty()) different = contradiction(specimen, scene);
  if (different.empty()) return;
  throw FileProblem(
      ExitCode::refused, file,
      fmt::format("holds bonds of another scene: {}. Read it with the keys that made its bonds, or take a "
                  "specimen without bonds (specimen.h5 of a run, or `clathra generate`); --ignore-guards does not help",
                  different));
}

}  // namespace

SceneTexts specimen_label(Scene const& scene, bool bonded) {
  SceneTexts label;
  for (Item const& item : items)
    if (bonded || !is_of_bonds(item.part)) label[std::string(item.key)] = shown(*find_key(item.key), scene);
  return label;
}

SceneTexts label_of(Specimen const& specimen) {
  SceneTexts label;
  Json const json = Json::parse(specimen.provenance, nullptr, false);
  if (!json.is_object()) return label;
  if (auto const made = json.find("made_of"); made != json.end()) {
    for (auto const& [key, value] : made->items())
      if (value.is_string()) label[key] = value.get<std::string>();
    return label;
  }
  if (auto const seed = json.find("seed"); seed != json.end() && seed->is_number_integer()) label["run.seed"] = seed->dump();
  if (json.contains("generate")) label["specimen.preparation_stress"] = format_quantity(specimen.stress, Dimension::pressure);
  return label;
}

std::string program_of_specimen(std::filesystem::path const& file) {
  constexpr std::string_view name = "clathra ";
  Json json;
  try {
    json = Json::parse(Hdf5File::open(file).read_text("provenance"), nullptr, false);
  } catch (FileProblem const&) {
    return {};
  }
  if (!json.is_object() || !json.contains("program") || !json["program"].is_string()) return {};
  std::string const program = json["program"].get<std::string>();
  Json const hash = json.value("git_hash", Json());
  if (!program.starts_with(name)) return {};
  return version_text(program.substr(name.size()), hash.is_string() ? hash.get<std::string>() : "");
}

SceneTexts label_after(SceneTexts const& before, Scene const& scene, bool bonded) {
  SceneTexts label = specimen_label(scene, bonded);
  for (Item const& item : items) {
    if (item.part != Part::making) continue;
    std::string const key(item.key);
    label.erase(key);
    if (auto const kept = before.find(key); kept != before.end()) label.insert(*kept);
  }
  std::string changed;
  for (LoadingStage const& stage : stages_of(scene))
    if (bonded && stage.hydrate.any()) changed += (changed.empty() ? "'" : ", '") + stage.name + "'";
  if (!changed.empty()) label[hydrate_changed_in] = changed;
  return label;
}

std::vector<std::string> compare_with_scene(std::filesystem::path const& file, Specimen const& specimen, Scene const& scene) {
  SceneTexts const label = label_of(specimen);
  require_agreement(file, specimen, label, scene);
  std::vector<std::string> warnings;
  auto const warn = [&](Part part, std::string_view meaning) {
    if (std::string const text = differences(label, scene, part); !text.empty())
      warnings.push_back(fmt::format("{}: {}; {}", file.string(), text, meaning));
  };
  warn(Part::making, "what the scene says has no effect, the specimen is made already");
  warn(Part::stiffness, "the specimen came to rest with the stiffness that was");
  bool const bonded = specimen.critical_thickness > 0;
  if (bonded) warn(Part::climate, "the bonds formed as it was and hold as it is");
  if (bonded && !label.contains("hydrate.saturation"))
    warnings.push_back(
        fmt::format("{}: says nothing of what its bonds are made of but h_max = {}; bond.law, bond.strength_from, "
                    "bond.rolling_lever and hydrate are those of the scene",
                    file.string(), micrometres(specimen.critical_thickness)));
  if (specimen.axial_strain != 0)
    warnings.push_back(
        fmt::format("{}: was sheared already, to an axial strain of {:.4g} %: it is consolidated and sheared from "
                    "there",
                    file.string(), specimen.axial_strain * 100));
  return warnings;
}

}  // namespace clathra
