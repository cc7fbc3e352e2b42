#include "io/results/paper_claims.hpp"

#include <fmt/format.h>

#include <cmath>

#include "domain/measurement/curve_features.hpp"
#include "domain/measurement/test_numbers.hpp"
#include "domain/scene/hydrate.hpp"

namespace clathra {

std::string paper_material(int saturation) { return saturation == 0 ? "sand" : fmt::format("s{}", saturation); }
std::string paper_cell(int saturation, int stress) { return fmt::format("{}_{}MPa", paper_material(saturation), stress); }
std::string paper_cell(double thickness) { return fmt::format("h{:g}um_1MPa", std::round(thickness * 1e8) / 100); }

std::string paper_label(std::string const& cell) {
  std::size_t const bar = cell.find('_');
  std::string const material = cell.substr(0, bar), stress = cell.substr(bar + 1);
  std::string const words = material == "sand"   ? material
                            : material[0] == 's' ? material.substr(1) + " %"
                                                 : "h_max = " + material.substr(1, material.size() - 3) + " um";
  return words + ", " + stress.substr(0, stress.size() - 3) + " MPa";
}

void PaperNumbers::add(std::string const& cell, std::uint64_t seed, std::map<std::string, double> const& numbers) {
  for (auto const& [name, value] : numbers)
    if (std::isfinite(value)) numbers_[cell][name][seed] = value;
}

SeedNumbers const& PaperNumbers::of(std::string const& cell, std::string const& name) const {
  static SeedNumbers const none;
  auto const found = numbers_.find(cell);
  if (found == numbers_.end()) return none;
  auto const number = found->second.find(name);
  return number == found->second.end() ? none : number->second;
}

std::map<std::string, double> numbers_of_history(HistoryTable const& history) {
  constexpr double top = 0.98, softened = 0.95, breaking_width = 0.005, low_strain = paper_strains[2];
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
  if (n.end_eps1 > low_strain) numbers["q_share_at_6.71"] = value_at(eps1, q, low_strain) / n.peak_q;
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

namespace {

constexpr double mega = 1e-6, percent = 100;

SeedNumbers scaled(SeedNumbers numbers, double factor) {
  for (auto& [seed, value] : numbers) value *= factor;
  return numbers;
}

std::string saturation_name(int saturation) { return saturation == 0 ? "sand" : fmt::format("{} %", saturation); }

/// Makes the claims of one set of tests.
class Claims {
 public:
  Claims(PaperDesign const& design, PaperNumbers const& numbers, double d50) : design_(design), numbers_(numbers), d50_(d50) {}

  std::vector<Claim> all() {
    return {critical_thickness(),
            peaks_rise(),
            not_below_sand(),
            brittleness(),
            residual_slope(),
            top_at_1(),
            softening_at_3(),
            cohesion(),
            friction_angle(),
            contraction_then_dilation(),
            contraction(),
            dilation(),
            sweep(),
            breakage(),
            bands(),
            fabric(),
            sand()};
  }

 private:
  SeedNumbers of(int saturation, int stress, std::string const& name, double factor = 1) const {
    return scaled(numbers_.of(paper_cell(saturation, stress), name), factor);
  }

  /// Differences of a number over saturation, stress by stress.
  void over_saturation(Claim& claim, std::string const& what, std::string const& name, std::string const& unit, double factor,
                       double low = 0, double high = no_bound) const {
    for (int const stress : design_.stresses)
      for (std::size_t i = 1; i < design_.saturations.size(); ++i) {
        int const a = design_.saturations[i - 1], b = design_.saturations[i];
        claim.parts.push_back({fmt::format("{}, {} % less {} %, {} MPa", what, b, a, stress), unit,
                               rise(of(a, stress, name, factor), of(b, stress, name, factor)), low, high});
      }
  }

  /// The same over stress, saturation by saturation.
  void over_stress(Claim& claim, std::string const& what, std::string const& name, std::string const& unit, double factor,
                   double low = 0, double high = no_bound) const {
    for (int const saturation : design_.saturations)
      for (std::size_t i = 1; i < design_.stresses.size(); ++i) {
        int const a = design_.stresses[i - 1], b = design_.stresses[i];
        claim.parts.push_back({fmt::format("{}, {} less {} MPa, {} %", what, b, a, saturation), unit,
                               rise(of(saturation, a, name, factor), of(saturation, b, name, factor)), low, high});
      }
  }

  Claim critical_thickness() const {
    struct Image {
      double saturation, thickness, d50;
    };
    Claim claim{"1", "Eq. 3 follows the three images within 15 %", {}};
    for (Image const image : {Image{0.30, 8.13e-6, 0.2e-3}, {0.50, 15.6e-6, 0.2e-3}, {0.863, 30.7e-6, 0.32e-3}}) {
      double const ratio = critical_thickness_ratio(image.saturation) * image.d50 / image.thickness;
      claim.parts.push_back(
          {fmt::format("Eq. 3 over image, {:g} %", image.saturation * percent), "", {{0, ratio}}, 0.85, 1.15, true});
    }
    return claim;
  }

  Claim peaks_rise() const {
    Claim claim{"2", "Peak q rises with saturation at each stress and with stress at each saturation", {}};
    over_saturation(claim, "peak q", "peak_q_Pa", "MPa", mega);
    over_stress(claim, "peak q", "peak_q_Pa", "MPa", mega);
    return claim;
  }

  Claim not_below_sand() const {
    Claim claim{"3", "No bonded sand is weaker at its peak than clean sand", {}};
    for (int const stress : design_.stresses)
      for (int const saturation : design_.saturations)
        claim.parts.push_back({fmt::format("peak q, {} % less sand, {} MPa", saturation, stress), "MPa",
                               rise(of(0, stress, "peak_q_Pa", mega), of(saturation, stress, "peak_q_Pa", mega)), 0});
    return claim;
  }

  Claim brittleness() const {
    Claim claim{"4", "Softening, (peak - residual) / peak, is the more obvious the more hydrate", {}};
    over_saturation(claim, "softening", "brittleness", "", 1);
    return claim;
  }

  /// Slope over saturation of a number [per % of saturation].
  SeedNumbers slope(int stress, std::string const& name) const {
    return slope_over_cells(name,
                            [&] {
                              std::vector<std::pair<double, std::string>> places;
                              for (int const saturation : design_.saturations)
                                places.emplace_back(saturation, paper_cell(saturation, stress));
                              return places;
                            }())
        .first;
  }

  /// Slope and bend of a number over places, for each seed that has it in all cells.
  std::pair<SeedNumbers, SeedNumbers> slope_over_cells(std::string const& name,
                                                       std::vector<std::pair<double, std::string>> const& places) const {
    std::pair<SeedNumbers, SeedNumbers> result;
    for (auto const& [seed, first] : numbers_.of(places.front().second, name)) {
      std::vector<double> x, y;
      for (auto const& [place, cell] : places) {
        SeedNumbers const& values = numbers_.of(cell, name);
        if (auto const at = values.find(seed); at != values.end()) x.push_back(place), y.push_back(at->second);
      }
      if (x.size() < places.size()) continue;
      if (auto const line = slope_over(x, y, x.front(), x.back())) result.first[seed] = *line;
      if (auto const parabola = fitted_parabola(x, y)) result.second[seed] = parabola->bend;
    }
    return result;
  }

  Claim residual_slope() const {
    Claim claim{"5", "Residual q depends little on saturation: its slope is a third of that of peak q at most", {}};
    for (int const stress : design_.stresses)
      claim.parts.push_back({fmt::format("slope of residual q less a third of that of peak q, {} MPa", stress), "MPa per 10 %",
                             scaled(paired(slope(stress, "residual_q_Pa"), slope(stress, "peak_q_Pa"),
                                           [](double residual, double peak) { return residual - peak / 3; }),
                                    10 * mega),
                             -no_bound, 0});
    return claim;
  }

  Claim top_at_1() const {
    Claim claim{"6", "At 1 MPa the peak (the middle of q >= 0.98 peak) is at an axial strain of about 2 %", {}};
    for (int const saturation : design_.saturations)
      if (saturation > 26)
        claim.parts.push_back(
            {fmt::format("strain at the peak, {} %", saturation), "%", of(saturation, 1, "top_eps1", percent), 1.5, 2.5});
    return claim;
  }

  Claim softening_at_3() const {
    Claim claim{
        "7",
        "At 55 % and 3 MPa the peak is at 3.38 %, where contraction ends; q has dropped by 6.71 % and is constant by 15 %",
        {}};
    SeedNumbers const top = of(55, 3, "top_eps1", percent);
    claim.parts = {
        {"strain at the peak", "%", top, 2.9, 3.9},
        {"end of contraction less strain at the peak", "%", rise(top, of(55, 3, "end_of_contraction_eps1", percent)), -0.5, 0.5},
        {"q at 6.71 % over the peak", "", of(55, 3, "q_share_at_6.71"), -no_bound, 0.85},
        {"change of q over 3 % strain at the end, over q", "%", of(55, 3, "residual_slope", percent), -5, 5}};
    return claim;
  }

  Claim cohesion() const {
    Claim claim{"8", "Cohesion rises about linearly with saturation", {}};
    int before = 0;
    std::vector<std::pair<double, std::string>> places{{0, paper_material(0)}};
    for (int const saturation : design_.saturations) {
      claim.parts.push_back({fmt::format("cohesion, {} less {}", saturation_name(saturation), saturation_name(before)), "MPa",
                             rise(scaled(numbers_.of(paper_material(before), "peak_cohesion_Pa"), mega),
                                  scaled(numbers_.of(paper_material(saturation), "peak_cohesion_Pa"), mega)),
                             0});
      places.emplace_back(saturation, paper_material(saturation));
      before = saturation;
    }
    double const half = places.back().first / 2;
    SeedNumbers const bend = slope_over_cells("peak_cohesion_Pa", places).second;
    claim.parts.push_back({"bow of the parabola through c over that of 55 %", "%",
                           paired(bend, numbers_.of(paper_material(before), "peak_cohesion_Pa"),
                                  [&](double b, double c) { return percent * std::abs(b) * half * half / c; }),
                           -no_bound, 15});
    return claim;
  }

  Claim friction_angle() const {
    int const low = design_.saturations.front(), high = design_.saturations.back();
    return {"9",
            "The friction angle has no trend with saturation",
            {{fmt::format("phi, {} less {} %", high, low), "degrees",
              rise(numbers_.of(paper_material(low), "peak_friction_angle_deg"),
                   numbers_.of(paper_material(high), "peak_friction_angle_deg")),
              -3, 3}}};
  }

  Claim contraction_then_dilation() const {
    Claim claim{"10", "Each bonded test contracts, then dilates, the less the higher the stress", {}};
    for (int const stress : design_.stresses)
      for (int const saturation : design_.saturations)
        claim.parts.push_back({fmt::format("dilation after the largest contraction, {} %, {} MPa", saturation, stress), "%",
                               of(saturation, stress, "dilation", percent), 0});
    over_stress(claim, "dilation", "dilation", "%", percent, -no_bound, 0);
    return claim;
  }

  Claim contraction() const {
    Claim claim{"11a", "Contraction grows with saturation (conclusions)", {}};
    over_saturation(claim, "largest eps_v", "largest_eps_v", "%", percent);
    return claim;
  }

  Claim dilation() const {
    Claim claim{"11b", "Dilation grows with saturation (section 5.2)", {}};
    over_saturation(claim, "dilation", "dilation", "%", percent);
    return claim;
  }

  Claim sweep() const {
    Claim claim{"12", "Fig. 17: peak and dilation rise with critical thickness, ever more slowly; residual q does not", {}};
    std::vector<std::pair<double, std::string>> places;
    for (int const s : design_.saturations)
      places.emplace_back(1e6 * critical_thickness_ratio(s / percent) * d50_, paper_cell(s, 1));
    for (double const h : design_.thicknesses) places.emplace_back(1e6 * h, paper_cell(h));
    std::sort(places.begin(), places.end());
    auto const [peak, peak_bend] = slope_over_cells("peak_q_Pa", places);
    auto const [dilation, dilation_bend] = slope_over_cells("dilation", places);
    SeedNumbers const residual = slope_over_cells("residual_q_Pa", places).first;
    claim.parts = {{"slope of peak q", "MPa/um", scaled(peak, mega), 0},
                   {"bend of peak q", "MPa/um^2", scaled(peak_bend, mega), -no_bound, 0},
                   {"slope of dilation", "%/um", scaled(dilation, percent), 0},
                   {"bend of dilation", "%/um^2", scaled(dilation_bend, percent), -no_bound, 0},
                   {"slope of residual q less a third of that of peak q", "MPa/um",
                    scaled(paired(residual, peak, [](double r, double p) { return r - p / 3; }), mega), -no_bound, 0}};
    return claim;
  }

  Claim breakage() const {
    constexpr double latest_peak = 0.05;
    Claim claim{
        "13", "Bonds break fastest between the peak (0) and the end of softening (1), where the peak is before 5 % strain", {}};
    for (int const stress : design_.stresses)
      for (int const saturation : design_.saturations) {
        SeedNumbers places = of(saturation, stress, "breakage_place");
        SeedNumbers const peaks = of(saturation, stress, "peak_eps1");
        std::erase_if(places, [&](auto const& place) { return !(peaks.at(place.first) < latest_peak); });
        if (places.empty()) continue;
        claim.parts.push_back({fmt::format("place of the fastest breakage, {} %, {} MPa", saturation, stress), "", places, 0, 1});
      }
    return claim;
  }

  Claim bands() const {
    return {"14",
            "Bonds break in the shear band, and the band thickens (55 %, 3 MPa)",
            {{"bonds broken after the peak, inside over outside the bands", "", of(55, 3, "band_breakage_ratio"), 3},
             {"deviation of the Gaussian across the band, 15.04 less 6.71 %", "d50", of(55, 3, "band_thickening_d50"), 0}}};
  }

  Claim fabric() const {
    Claim claim{"15", "Contacts turn to the vertical (55 %, 3 MPa)", {}};
    claim.parts = {{"vertical deviator of the fabric, 2.54 less 0 %", "", of(55, 3, "fabric_growth_2.54"), 0},
                   {"the same, 15.04 less 0 %", "", of(55, 3, "fabric_growth_15.04"), 0},
                   {"direction off the vertical, 2.54 %", "degrees", of(55, 3, "fabric_direction_2.54"), -10, 10},
                   {"direction off the vertical, 15.04 %", "degrees", of(55, 3, "fabric_direction_15.04"), -10, 10}};
    return claim;
  }

  Claim sand() const {
    return {"16",
            "Clean sand has no cohesion and a friction angle of 31 degrees at the peak",
            {{"cohesion", "MPa", scaled(numbers_.of("sand", "peak_cohesion_Pa"), mega), -0.1, 0.1},
             {"phi", "degrees", numbers_.of("sand", "peak_friction_angle_deg"), 29.5, 32.5}}};
  }

  PaperDesign const& design_;
  PaperNumbers const& numbers_;
  double d50_;
};

}  // namespace

std::vector<Claim> paper_claims(PaperDesign const& design, PaperNumbers const& numbers, double d50) {
  return Claims(design, numbers, d50).all();
}

}  // namespace clathra
