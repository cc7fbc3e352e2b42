#include "io/results/test_quantities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "domain/measurement/curve_features.hpp"
#include "domain/measurement/fabric.hpp"
#include "domain/measurement/shear_band.hpp"
#include "domain/measurement/strain_field.hpp"
#include "domain/measurement/test_numbers.hpp"
#include "io/results/events.hpp"
#include "io/results/shown_units.hpp"
#include "io/results/snapshot_file.hpp"

namespace clathra {
namespace {

/// A fabric counts what presses or holds each other.
constexpr ContactSet counted_contacts = ContactSet::mechanical;

/// How far the fabric points upward.
double vertical_deviator(Fabric const& fabric) { return fabric.yy - fabric.xx; }

/// Of the major axis from the vertical [degrees], -90 to 90.
double off_the_vertical(Fabric const& fabric) { return (fabric.direction - std::numbers::pi / 2) * degrees; }

constexpr Quantity all_quantities[] = {{"peak_q_Pa", "Pa", QuantityOf::history, false},
                                       {"peak_eps1", "", QuantityOf::history, false},
                                       {"top_eps1", "", QuantityOf::history, false},
                                       {"residual_q_Pa", "Pa", QuantityOf::history, false},
                                       {"brittleness", "", QuantityOf::history, false},
                                       {"largest_eps_v", "", QuantityOf::history, false},
                                       {"end_of_contraction_eps1", "", QuantityOf::history, false},
                                       {"dilation", "", QuantityOf::history, false},
                                       {"q_share", "", QuantityOf::history, true},
                                       {"residual_slope", "", QuantityOf::history, false},
                                       {"breakage_place", "", QuantityOf::history, false},
                                       {"fabric_growth", "", QuantityOf::snapshots, true},
                                       {"fabric_direction", "degrees", QuantityOf::snapshots, true},
                                       {"band_deviation", "d50", QuantityOf::snapshots, true},
                                       {"band_breakage_ratio", "", QuantityOf::snapshots, false},
                                       {"peak_cohesion_Pa", "Pa", QuantityOf::material, false},
                                       {"peak_friction_angle_deg", "degrees", QuantityOf::material, false},
                                       {"residual_cohesion_Pa", "Pa", QuantityOf::material, false},
                                       {"residual_friction_angle_deg", "degrees", QuantityOf::material, false}};

/// Units in which numbers can be shown, with the unit that they have.
struct ShownUnit {
  std::string_view shown, from;
  double factor;
};
constexpr ShownUnit shown_units[] = {{"Pa", "Pa", 1}, {"kPa", "Pa", 1e-3},       {"MPa", "Pa", 1e-6}, {"", "", 1},
                                     {"%", "", 100},  {"degrees", "degrees", 1}, {"d50", "d50", 1}};

std::string named(std::string_view quantity, double strain) { return fmt::format("{}_at_{:g}", quantity, 100 * strain); }

/// Bonds broken after a step for each bond that there was, inside over outside the shear bands: the discs whose shear strain in
/// the last snapshot is above 1.5 times the mean of all. Each bond counts half for either of its discs.
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

/// Of the last of the strains there is that of the bands; nothing where there is no snapshot of the start.
std::map<std::string, double> numbers_of_snapshots(std::filesystem::path const& folder, HistoryTable const& history,
                                                   std::vector<double> const& strains) {
  std::map<std::string, double> numbers;
  std::optional<Fabric> first;
  for (std::filesystem::path const& file : snapshot_files(folder)) {
    Snapshot const now = read_snapshot(file);
    if (now.eps1 == 0) first = rose_of(now, counted_contacts).fabric;
    auto const strain = std::find_if(strains.begin(), strains.end(), [&](double at) { return is_near(now.eps1, at); });
    if (!first || strain == strains.end()) continue;
    Fabric const fabric = rose_of(now, counted_contacts).fabric;
    numbers[named("fabric_growth", *strain)] = vertical_deviator(fabric) - vertical_deviator(*first);
    numbers[named("fabric_direction", *strain)] = off_the_vertical(fabric);
    if (auto const deviation = band_deviation(now)) numbers[named("band_deviation", *strain)] = *deviation;
    if (strain + 1 != strains.end()) continue;
    auto const peak_step = static_cast<std::int64_t>(history["step"][test_numbers(history.curves()).peak]);
    if (auto const ratio = breakage_in_bands(now, read_events(folder / "events.csv").rows, peak_step))
      numbers["band_breakage_ratio"] = *ratio;
  }
  return numbers;
}

void add_envelopes(TestQuantities& numbers, Study const& study, std::vector<MemberResult> const& members) {
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

std::span<Quantity const> quantities() { return all_quantities; }

std::optional<double> factor_to(std::string_view unit, Quantity const& quantity) {
  for (ShownUnit const& one : shown_units)
    if (one.shown == unit && one.from == quantity.unit) return one.factor;
  return {};
}

std::string units_of(Quantity const& quantity) {
  std::string text;
  for (ShownUnit const& one : shown_units)
    if (one.from == quantity.unit) text += fmt::format("{}'{}'", text.empty() ? "" : ", ", one.shown);
  return text;
}

std::string number_name(Quantity const& quantity, double strain) {
  return quantity.at_strain ? named(quantity.name, strain) : std::string(quantity.name);
}

bool is_near(double strain, double wanted) {
  constexpr double near = 5e-4;
  return std::abs(strain - wanted) < near;
}

void TestQuantities::add(std::string const& group, std::uint64_t seed, std::map<std::string, double> const& numbers) {
  for (auto const& [name, value] : numbers)
    if (std::isfinite(value)) numbers_[group][name][seed] = value;
}

SeedNumbers const& TestQuantities::of(std::string const& group, std::string const& name) const {
  static SeedNumbers const none;
  auto const found = numbers_.find(group);
  if (found == numbers_.end()) return none;
  auto const number = found->second.find(name);
  return number == found->second.end() ? none : number->second;
}

std::map<std::string, double> numbers_of_history(HistoryTable const& history, std::vector<double> const& strains) {
  constexpr double top = 0.98, softened = 0.95, breaking_width = 0.005;
  TestCurves const curves = history.curves();
  std::vector<double> const &eps1 = curves.eps1, &q = curves.q;
  TestNumbers const n = test_numbers(curves);
  std::map<std::string, double> numbers{{"peak_q_Pa", n.peak_q},
                                        {"peak_eps1", n.peak_eps1},
                                        {"top_eps1", middle_of_top(eps1, q, top)},
                                        {"residual_q_Pa", n.residual_q},
                                        {"brittleness", (n.peak_q - n.residual_q) / n.peak_q},
                                        {"largest_eps_v", n.largest_eps_v},
                                        {"end_of_contraction_eps1", n.largest_eps_v_eps1},
                                        {"dilation", n.largest_eps_v - n.eps_v_end}};
  for (double const strain : strains)
    if (n.end_eps1 > strain) numbers[named("q_share", strain)] = value_at(eps1, q, strain) / n.peak_q;
  if (auto const slope = slope_over(eps1, q, n.residual_from, n.end_eps1))
    numbers["residual_slope"] = *slope * 0.03 / n.residual_q;
  std::vector<double> broken(eps1.size());
  for (BreakModeNames const& mode : break_modes)
    if (history.has(mode.broken))
      for (std::size_t i = 0; i < broken.size(); ++i) broken[i] += history[mode.broken][i];
  auto const fastest = fastest_growth(eps1, broken, breaking_width);
  auto const end = end_of_fall(eps1, q, n.residual_q, softened);
  if (fastest && end && *end > n.peak_eps1) numbers["breakage_place"] = (*fastest - n.peak_eps1) / (*end - n.peak_eps1);
  return numbers;
}

TestQuantities quantities_of_members(Study const& study, std::vector<MemberResult> const& members,
                                     std::vector<std::filesystem::path> const& folders, std::vector<double> const& strains) {
  TestQuantities numbers;
  for (std::size_t i = 0; i < members.size(); ++i) {
    if (members[i].state != MemberState::finished) continue;
    std::string const& group = study.groups[members[i].group].name;
    HistoryTable const history(folders[i] / "history.csv");
    numbers.add(group, members[i].seed, numbers_of_history(history, strains));
    numbers.add(group, members[i].seed, numbers_of_snapshots(folders[i], history, strains));
  }
  add_envelopes(numbers, study, members);
  return numbers;
}

}  // namespace clathra
