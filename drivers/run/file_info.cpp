#include "run/file_info.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "domain/biaxial/scene_needs.hpp"
#include "domain/measurement/disc_grading.hpp"
#include "domain/scene/hydrate.hpp"
#include "io/results/export.hpp"
#include "io/results/run_record.hpp"
#include "io/results/stage_numbers.hpp"

namespace clathra {
namespace {

/// One line of a text: what it is, and its value.
std::string row(char const* name, std::string const& value) { return fmt::format("{:<18} {}\n", name, value); }

}  // namespace

std::string snapshot_text(Snapshot const& s) {
  std::array<std::size_t, contact_state_count> pairs{};
  for (std::uint8_t const state : s.state) ++pairs[state];
  std::string text;
  text += row("stage", s.stage);
  text += row("step", fmt::format("{}, {:.6g} s after the consolidation", s.step, s.time));
  text += row("strain", fmt::format("eps1 {:.4g} %, eps_v {:.4g} %", s.eps1 * 100, s.eps_v * 100));
  text += row("stress", fmt::format("sigma1 {:.5g} MPa, sigma3 {:.5g} MPa", s.sigma1 * 1e-6, s.sigma3 * 1e-6));
  text += row("particles", fmt::format("{}", s.id.size()));
  text += row("box", fmt::format("{:.6g} mm x {:.6g} mm", (s.right - s.left) * 1e3, (s.top - s.bottom) * 1e3));
  for (std::size_t state = 0; state < pairs.size(); ++state)
    text += row(std::string(contact_state_name(static_cast<std::uint8_t>(state))).c_str(), fmt::format("{} pairs", pairs[state]));
  text += row("events", fmt::format("{} bonds broke since the snapshot before", s.events.rows.size()));
  return text;
}

nlohmann::ordered_json snapshot_json(Snapshot const& s) {
  nlohmann::ordered_json pairs;
  for (std::size_t state = 0; state < contact_state_count; ++state)
    pairs[std::string(contact_state_name(static_cast<std::uint8_t>(state)))] =
        std::count(s.state.begin(), s.state.end(), static_cast<std::uint8_t>(state));
  return {{"kind", "snapshot"},
          {"stage", s.stage},
          {"step", s.step},
          {"time_s", s.time},
          {"eps1", s.eps1},
          {"eps_v", s.eps_v},
          {"sigma1_Pa", s.sigma1},
          {"sigma3_Pa", s.sigma3},
          {"particles", s.id.size()},
          {"width_m", s.right - s.left},
          {"height_m", s.top - s.bottom},
          {"pairs", pairs},
          {"breaks", s.events.rows.size()}};
}

namespace {

std::string number_text(nlohmann::json const& value) {
  if (value.is_string()) return value.get<std::string>();
  return value.is_number() ? fmt::format("{:.6g}", value.get<double>()) : value.dump();
}

/// The numbers of a stage, one a line under its name.
std::string stage_text(std::string const& stage, nlohmann::json const& numbers) {
  std::string text = stage + "\n";
  for (auto const& [name, value] : numbers.items()) {
    std::string const meaning = meaning_of(stage, name);
    text += meaning.empty() ? fmt::format("  {:<30} {}\n", name, number_text(value))
                            : fmt::format("  {:<30} {:<12}  {}\n", name, number_text(value), meaning);
  }
  return text;
}

/// What a specimen file says of its origin.
std::string origin_text(std::string const& provenance) {
  auto const json = nlohmann::json::parse(provenance, nullptr, false);
  if (!json.is_object()) return row("made by", provenance);
  std::string text;
  for (auto const& [name, value] : json.items())
    if (!value.is_object()) text += row(name.c_str(), value.is_string() ? value.get<std::string>() : value.dump());
  for (auto const& [name, value] : json.items())
    if (value.is_object()) text += stage_text(name, value);
  return text;
}

}  // namespace

std::string specimen_text(Specimen const& specimen, SpecimenFacts const& facts) {
  auto const bonds =
      std::count_if(specimen.contacts.begin(), specimen.contacts.end(), [](SpecimenContact const& c) { return c.bonded(); });
  auto const diameter = [&](double part) { return diameter_finer(specimen.radius, part) * 1e3; };
  std::string text;
  text += row("particles", fmt::format("{}", specimen.size()));
  text += row("box", fmt::format("{:.6g} mm x {:.6g} mm{}", specimen.width() * 1e3, specimen.height() * 1e3,
                                 specimen.periodic ? ", periodic" : ""));
  text += row("void ratio", fmt::format("{:.5g}", facts.outline.void_ratio));
  text += row("grading", fmt::format("d10 {:.4g} mm, d50 {:.4g} mm, d60 {:.4g} mm", diameter(0.1), diameter(0.5), diameter(0.6)));
  text += row("grain density", fmt::format("{:g} kg/m^3", specimen.density));
  text += row(specimen.axial_strain != 0 ? "rested under" : "rests under",
              specimen.stress > 0 ? fmt::format("{:.6g} MPa", specimen.stress * 1e-6) : "not stated");
  if (specimen.axial_strain != 0)
    text += row("sheared", fmt::format("to an axial strain of {:.4g} %", specimen.axial_strain * 100));
  text += row("contacts", fmt::format("{}", specimen.contacts.size()));
  text += row("bonds", fmt::format("{}", bonds));
  if (specimen.critical_thickness > 0) text += row("h_max", fmt::format("{:.4g} um", specimen.critical_thickness * 1e6));
  if (!specimen.provenance.empty()) text += origin_text(specimen.provenance);
  return text;
}

nlohmann::ordered_json specimen_json(Specimen const& specimen, SpecimenFacts const& facts) {
  auto const bonds =
      std::count_if(specimen.contacts.begin(), specimen.contacts.end(), [](SpecimenContact const& c) { return c.bonded(); });
  nlohmann::ordered_json json = {{"kind", "specimen"},
                                 {"particles", specimen.size()},
                                 {"width_m", specimen.width()},
                                 {"height_m", specimen.height()},
                                 {"periodic", specimen.periodic},
                                 {"void_ratio", facts.outline.void_ratio},
                                 {"density_kg_per_m3", specimen.density},
                                 {"stress_Pa", specimen.stress},
                                 {"axial_strain", specimen.axial_strain},
                                 {"contacts", specimen.contacts.size()},
                                 {"bonds", bonds},
                                 {"critical_thickness_m", specimen.critical_thickness}};
  for (auto const& [name, part] : {std::pair{"d10_m", 0.1}, {"d50_m", 0.5}, {"d60_m", 0.6}})
    json[name] = diameter_finer(specimen.radius, part);
  json["provenance"] = nlohmann::json::parse(specimen.provenance, nullptr, false);
  if (json["provenance"].is_discarded()) json["provenance"] = specimen.provenance;
  return json;
}

std::string run_text(nlohmann::json const& record) {
  std::string text = fmt::format("exit               {} (code {})\n", record.at("exit").at("reason").get<std::string>(),
                                 record.at("exit").at("code").dump());
  auto const& program = record.at("program");
  text += fmt::format("program            clathra {} ({}), {}, threads: {}\n", program.at("version").get<std::string>(),
                      program.at("git_hash").get<std::string>(), program.at("backend").get<std::string>(),
                      program.at("threads").dump());
  if (record.contains("scene")) {
    Scene const scene = scene_of(record.at("scene"));
    text += row("scene", fmt::format("{}, confining stress {:.4g} MPa, seed {}",
                                     has_bonds(scene) ? fmt::format("saturation {:.4g} %", 100 * scene.hydrate.saturation)
                                                      : std::string("clean sand"),
                                     scene.test.confining_stress * 1e-6, scene.run.seed));
  }
  auto const& stages = record.at("stages");
  std::vector<std::string> names{"generate", "prepare", "plan"};
  for (auto const& end : record.value("loading", nlohmann::json::array())) names.push_back(end.at("stage"));
  for (std::string const& stage : names)
    if (stages.contains(stage)) text += stage_text(stage, stages.at(stage));
  for (auto const& [stage, seconds] : record.at("wall_seconds").items())
    text += fmt::format("{:<18} {} s\n", "time of " + stage, number_text(seconds));
  if (double const rate = record.at("particle_steps_per_second"); rate > 0)
    text += fmt::format("{:<18} {:.4g} M\n", "particle-steps/s", rate * 1e-6);
  for (auto const& warning : record.at("warnings")) text += "warning: " + warning.get<std::string>() + "\n";
  if (record.contains("state_hash")) text += fmt::format("{:<18} {}\n", "state hash", record.at("state_hash").get<std::string>());
  return text;
}

/// What a scene keeps in memory and computes in each step, with the keys that ask for it.
std::string needs_text(Scene const& scene) {
  SceneNeeds const needs = needs_of(scene);
  std::string text;
  for (auto const& [of, name] : {std::pair{FieldOf::disc, "a particle"},
                                 {FieldOf::entry, "an entry of the neighbour rows (about 5 a particle)"},
                                 {FieldOf::bond, "a bond (about 2 a particle)"}}) {
    if (needs.bytes(of) == 0) continue;
    text += fmt::format("{} bytes {}\n", needs.bytes(of), name);
    for (NeededField const& field : needs.fields)
      if (field.of == of) text += fmt::format("  {:<18} {}  {}\n", field.name, field.bytes, field.asked_by);
  }
  text += "kernels in each step\n";
  for (NeededKernel const& kernel : needs.kernels)
    text += fmt::format("  {:<22} {}: {}\n", kernel.name, kernel.does, kernel.asked_by);
  return text;
}

}  // namespace clathra
