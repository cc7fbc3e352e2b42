#include "io/report/response_envelope.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "io/report/markup.hpp"
#include "io/results/shown_units.hpp"

namespace clathra {
namespace {

constexpr std::size_t least_directions = 6;

/// One stress increment and what it strained. Closing positive; the direction is 0 where sigma_1 alone rises.
struct Response {
  double direction = 0, axial = 0, lateral = 0;
};

/// Of a run of one stage that puts stresses on; none of others.
std::vector<Response> response_of(RunResults const& run) {
  auto const loading = run.record.find("loading");
  if (loading == run.record.end() || loading->size() != 1) return {};
  std::string const at = "/stages/" + loading->front().value("stage", "") + "/";
  if (loading->front().value("ended_by", "") != "rest") return {};
  auto const number = [&](char const* name) { return run.number(at + name).value_or(std::nan("")); };
  double const vertical = number("end_sigma1_Pa") - number("start_sigma1_Pa"),
               lateral = number("end_sigma3_Pa") - number("start_sigma3_Pa"), axial = number("strain_eps1");
  Response const response{std::atan2(lateral, vertical), axial, number("strain_eps_v") - axial};
  if (!std::isfinite(response.direction + response.axial + response.lateral)) return {};
  return {response};
}

}  // namespace

Piece response_envelopes(ShownRuns const& shown) {
  std::map<std::int64_t, std::vector<Response>> of_seeds;
  for (RunResults const& run : shown.runs)
    for (Response const& response : response_of(run))
      of_seeds[static_cast<std::int64_t>(run.number("/scene/run/seed").value_or(0))].push_back(response);
  Variable const x{"lateral strain ε₃ [%]", "eps3", percent}, y{"axial strain ε₁ [%]", "eps1", percent};
  Plot plot;
  Range over, values;
  for (auto& [seed, responses] : of_seeds) {
    if (responses.size() < least_directions) continue;
    std::sort(responses.begin(), responses.end(), [](Response const& a, Response const& b) { return a.direction < b.direction; });
    Curve curve{fmt::format("seed {}", seed), {}, {}, run_stroke(plot.curves.size()), true};
    for (std::size_t i = 0; i <= responses.size(); ++i) {
      curve.x.push_back(responses[i % responses.size()].lateral);
      curve.y.push_back(responses[i % responses.size()].axial);
    }
    over.include(curve.x);
    values.include(curve.y);
    plot.description += fmt::format("{}: {} directions, axial strain up to {:.3g} %. ", curve.name, responses.size(),
                                    *std::max_element(curve.y.begin(), curve.y.end()) * percent);
    plot.curves.push_back(std::move(curve));
  }
  if (plot.curves.empty()) return "";
  plot.title = "Axial against lateral strain under stress increments of all directions";
  plot.x = over.axis(x);
  plot.y = values.axis(y);
  plot.height = height_for_equal_scales(plot.x, plot.y);
  return figure(
      "Response envelope", drawing(plot) + legend(plot.curves),
      "Strains at rest after stress increments of one size, a point for each direction: an isotropic elastic sand shows "
      "an ellipse about the origin, and what it does not give back shifts and stretches it. Closing is positive.");
}

}  // namespace clathra
