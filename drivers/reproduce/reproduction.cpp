#include "reproduce/reproduction.hpp"

#include <fmt/format.h>

#include <cmath>

#include "io/formats/text_file.hpp"

namespace clathra {
namespace {

constexpr char confining_stress[] = "test.confining_stress", saturation_key[] = "hydrate.saturation",
               snapshots_key[] = "output.snapshots_at";

/// Strains of the snapshots of the test that the paper looks into: its own, and more to see bands begin.
std::string snapshot_strains() {
  std::string text;
  for (double const percent : {1.0, 2.0, 2.54, 3.0, 3.38, 4.0, 5.0, 6.71, 8.0, 10.0, 12.5, 15.04})
    text += fmt::format("{}\"{:g} %\"", text.empty() ? "[" : ", ", percent);
  return text + "]";
}

std::string shared_keys(std::int64_t discs) {
  return fmt::format(
      "# What all tests of `clathra reproduce` share; the rest is the default of `clathra`.\n[specimen]\nparticles = "
      "{}\n\n[test]\n"
      "axial_strain = \"{:g} %\"\n\n[output]\nsnapshots = 0\nkeep_checkpoint = false\n",
      discs, 100 * paper_end);
}

StudyGroup group_of(int saturation, int stress) {
  StudyGroup group{paper_cell(saturation, stress), {}, paper_material(saturation)};
  group.settings = {{saturation_key, saturation == 0 ? "0" : fmt::format("{} %", saturation)},
                    {confining_stress, fmt::format("{} MPa", stress)}};
  if (saturation == 55 && stress == 3) {
    group.settings.emplace_back("output.snapshots", "1");  // the start, too
    group.settings.emplace_back(snapshots_key, snapshot_strains());
  }
  return group;
}

/// A test of Fig. 17 whose critical thickness is given; the hydrate is that of 55 %.
StudyGroup group_of(double thickness) {
  std::string const name = paper_cell(thickness);
  return {name,
          {{saturation_key, "55 %"},
           {confining_stress, "1 MPa"},
           {"bond.critical_thickness_from", "given"},
           {"bond.critical_thickness", fmt::format("{:g} um", std::round(thickness * 1e8) / 100)}},
          name.substr(0, name.find('_'))};
}

}  // namespace

Study reproduction_study(PaperDesign const& design, ReproductionSize const& size, std::filesystem::path const& folder,
                         std::filesystem::path const& scene) {
  Study study;
  study.folder = folder;
  study.scene = scene;
  study.file = folder / "scene.toml";
  study.seeds_stated = true;
  for (int k = 0; k < size.seeds; ++k) study.seeds.push_back(size.first_seed + static_cast<std::uint64_t>(k));
  for (int const stress : design.stresses) study.groups.push_back(group_of(0, stress));
  for (int const saturation : design.saturations)
    for (int const stress : design.stresses) study.groups.push_back(group_of(saturation, stress));
  for (double const thickness : design.thicknesses) study.groups.push_back(group_of(thickness));
  study.keys = {saturation_key,           confining_stress, "output.snapshots", snapshots_key, "bond.critical_thickness_from",
                "bond.critical_thickness"};
  replace_text_file(study.scene, shared_keys(size.discs));
  return study;
}

}  // namespace clathra
