#include "io/results/numbers_file.hpp"

#include "io/formats/text_file.hpp"
#include "io/results/shown_units.hpp"
#include "io/results/strength_groups.hpp"

namespace clathra {
namespace {

using OrderedJson = nlohmann::ordered_json;

OrderedJson json_of(std::optional<double> const& value, double factor = 1) {
  return value ? OrderedJson(*value * factor) : OrderedJson();
}

OrderedJson json_of(PairedStrength const& strength, TestStresses const& tests) {
  std::optional<Envelope> const& fit = strength.envelope;
  std::optional<EnvelopeErrors> const errors = fit ? fit->errors : std::nullopt;
  auto const of_errors = [&](double EnvelopeErrors::*number) { return errors ? std::optional((*errors).*number) : std::nullopt; };
  auto const half_of = [](std::optional<MeanInterval> const& mean) { return mean ? mean->half_width : std::nullopt; };
  return {{"cohesion_Pa", json_of(fit ? std::optional(fit->cohesion) : std::nullopt)},
          {"cohesion_half_width_Pa", json_of(half_of(strength.cohesion))},
          {"cohesion_fit_error_Pa", json_of(of_errors(&EnvelopeErrors::cohesion))},
          {"friction_angle_deg", json_of(fit ? std::optional(fit->friction_angle) : std::nullopt, degrees)},
          {"friction_angle_half_width_deg", json_of(half_of(strength.friction_angle), degrees)},
          {"friction_angle_fit_error_deg", json_of(of_errors(&EnvelopeErrors::friction_angle), degrees)},
          {"r_squared", json_of(of_errors(&EnvelopeErrors::r_squared))},
          {"curvature_per_Pa", json_of(fit ? fit->curvature : std::nullopt)},
          {"seeds", strength.seeds},
          {"incomplete_seeds", strength.incomplete},
          {"still_rising", tests.rising}};
}

OrderedJson json_of(StrengthGroup const& group, std::vector<RunResults> const& runs) {
  OrderedJson tests = OrderedJson::array();
  for (std::size_t const run : group.members) tests.push_back(runs[run].name);
  return {{"saturation", group.saturation / 100},
          {"tests", std::move(tests)},
          {"peak", json_of(group.at_peak, group.peaks)},
          {"residual", json_of(group.residual, group.residuals)}};
}

}  // namespace

OrderedJson numbers_of(std::vector<RunResults> const& runs) {
  OrderedJson of_runs = OrderedJson::array(), strength = OrderedJson::array();
  for (RunResults const& run : runs)
    of_runs.push_back({{"name", run.name},
                       {"folder", run.folder.string()},
                       {"saturation", json_of(run.number("/scene/hydrate/saturation"))},
                       {"confining_stress_Pa", json_of(run.number("/scene/test/confining_stress"))},
                       {"seed", json_of(run.number("/scene/run/seed"))},
                       {"numbers", run.has_peak() ? record_of(test_numbers(run.history.curves())) : StageRecord()}});
  for (StrengthGroup const& group : strength_groups(runs))
    if (group.at_several_stresses()) strength.push_back(json_of(group, runs));
  return {{"format", "clathra numbers"}, {"runs", std::move(of_runs)}, {"strength", std::move(strength)}};
}

void write_numbers(std::vector<RunResults> const& runs, std::filesystem::path const& path) {
  replace_text_file(path, numbers_of(runs).dump(2) + '\n');
}

}  // namespace clathra
