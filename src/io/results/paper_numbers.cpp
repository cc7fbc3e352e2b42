#include "io/results/paper_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "domain/measurement/fabric.hpp"
#include "domain/measurement/shear_band.hpp"
#include "domain/measurement/strain_field.hpp"
#include "domain/measurement/test_numbers.hpp"
#include "io/results/events.hpp"
#include "io/results/run_results.hpp"
#include "io/results/snapshot_file.hpp"

namespace clathra {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

/// The paper counts bonded contacts among all contacts, so its contacts are those that press or hold each other.
constexpr ContactSet paper_contacts = ContactSet::mechanical;

/// How far the fabric points upward.
double vertical_deviator(Fabric const& fabric) { return fabric.yy - fabric.xx; }

/// Of the major axis from the vertical [degrees], -90 to 90.
double off_the_vertical(Fabric const& fabric) { return (fabric.direction - std::numbers::pi / 2) * degrees; }

/// The snapshot of a run at an axial strain. @throws FileProblem
std::optional<Snapshot> snapshot_at(std::vector<std::filesystem::path> const& files, double strain) {
  constexpr double near = 5e-4;
  for (std::filesystem::path const& file : files)
    if (Snapshot snapshot = read_snapshot(file); std::abs(snapshot.eps1 - strain) < near) return snapshot;
  return {};
}

void add_fabric(std::map<std::string, double>& numbers, Fabric const& start, Snapshot const& now, std::string const& at) {
  Fabric const fabric = rose_of(now, paper_contacts).fabric;
  numbers["fabric_growth_" + at] = vertical_deviator(fabric) - vertical_deviator(start);
  numbers["fabric_direction_" + at] = off_the_vertical(fabric);
}

/// Bonds broken after a step for each bond that there was, inside over outside the shear bands: the discs whose shear strain at
/// the end is above 1.5 times the mean of all. Each bond counts half for either of its discs.
std::optional<double> breakage_in_bands(Snapshot const& end, std::vector<BreakEvent> const& events, std::int64_t from_step) {
  constexpr double in_band = 1.5;
  std::vector<float> const strains = shear_strain(end);
  double sum = 0, count = 0;
  for (float const strain : strains)
    if (std::isfinite(strain)) sum += double(strain), count += 1;
  if (!(count > 0)) return {};
  std::map<int, std::size_t> place;
  double bonds[2] = {0, 0}, broken[2] = {0, 0};
  auto const inside = [&](std::size_t i) { return double(strains[i]) > in_band * sum / count ? 1 : 0; };
  for (std::size_t i = 0; i < end.id.size(); ++i) place[end.id[i]] = i, bonds[inside(i)] += 0.5 * end.bonds_initial[i];
  for (BreakEvent const& event : events)
    if (event.step > from_step)
      for (int const id : {event.id_a, event.id_b}) broken[inside(place.at(id))] += 0.5;
  if (!(bonds[0] > 0 && bonds[1] > 0 && broken[0] > 0)) return {};
  return (broken[1] / bonds[1]) / (broken[0] / bonds[0]);
}

/// The Gaussian's deviation across the shear band, in d50.
std::optional<double> band_deviation(Snapshot const& s) {
  std::optional<BandProfile> const band = fit_band(s.x, s.y, shear_strain(s), s.d50, smoothing_of_shear_strain(s));
  return band ? std::optional(band->gaussian_deviation / s.d50) : std::nullopt;
}

/// Of the test that the paper looks into; nothing where it has no snapshots at the paper's strains.
std::map<std::string, double> numbers_of_snapshots(std::filesystem::path const& folder, HistoryTable const& history) {
  std::vector<std::filesystem::path> const files = snapshot_files(folder);
  std::optional<Snapshot> const start = snapshot_at(files, 0), early = snapshot_at(files, paper_strains[0]),
                                end = snapshot_at(files, paper_end);
  std::map<std::string, double> numbers;
  if (!start || !early || !end) return numbers;
  Fabric const first = rose_of(*start, paper_contacts).fabric;
  add_fabric(numbers, first, *early, "2.54");
  add_fabric(numbers, first, *end, "15.04");
  if (auto const softened = snapshot_at(files, paper_strains[2])) {
    std::optional<double> const then = band_deviation(*softened), now = band_deviation(*end);
    if (then && now) numbers["band_thickening_d50"] = *now - *then;
  }
  auto const peak_step = static_cast<std::int64_t>(history["step"][test_numbers(history.curves()).peak]);
  if (auto const ratio = breakage_in_bands(*end, read_events(folder / "events.csv").rows, peak_step))
    numbers["band_breakage_ratio"] = *ratio;
  return numbers;
}

void add_envelopes(PaperNumbers& numbers, Study const& study, std::vector<MemberResult> const& members) {
  for (GroupNumbers const& material : envelopes_by_material(study, members))
    for (std::size_t i = 0; i < material.seeds.size(); ++i) {
      std::map<std::string, double> fits;
      for (char const* const number :
           {"peak_cohesion_Pa", "peak_friction_angle_deg", "residual_cohesion_Pa", "residual_friction_angle_deg"})
        if (auto const found = material.values.find(number);
            found != material.values.end() && found->second.size() == material.seeds.size())
          fits[number] = found->second[i];
      numbers.add(material.name, material.seeds[i], fits);
    }
}

}  // namespace

PaperNumbers numbers_of_members(Study const& study, std::vector<MemberResult> const& members,
                                std::vector<std::filesystem::path> const& folders) {
  PaperNumbers numbers;
  for (std::size_t i = 0; i < members.size(); ++i) {
    if (members[i].state != MemberState::finished) continue;
    std::string const& cell = study.groups[members[i].group].name;
    HistoryTable const history(folders[i] / "history.csv");
    numbers.add(cell, members[i].seed, numbers_of_history(history));
    if (cell == paper_cell(55, 3)) numbers.add(cell, members[i].seed, numbers_of_snapshots(folders[i], history));
  }
  add_envelopes(numbers, study, members);
  return numbers;
}

}  // namespace clathra
