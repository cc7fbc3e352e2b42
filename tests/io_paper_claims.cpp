/// The claims on Jiang et al. (2017), from planted tests; the scorecard; points of a laboratory.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "io/errors/problems.hpp"
#include "io/formats/text_file.hpp"
#include "io/results/laboratory_data.hpp"
#include "io/results/paper_claims.hpp"
#include "io/results/scorecard.hpp"

namespace clathra {
namespace {

constexpr double d50 = 0.1694e-3;

/// Tests as the paper describes them: three seeds with small scatter.
PaperNumbers obedient_tests() {
  PaperNumbers numbers;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    double const noise = 1 + 0.001 * static_cast<double>(seed);
    for (int const s : {0, 26, 41, 55}) {
      double const bonded = s > 0 ? s - 20.0 : 0;
      numbers.add(paper_material(s), seed, {{"peak_cohesion_Pa", s * 3e4 * noise}, {"peak_friction_angle_deg", 31 * noise}});
      for (int const stress : {1, 2, 3}) {
        double const peak = (2.2e6 * stress + 1e5 * bonded) * noise, top = stress == 3 ? 0.0338 : 0.02;
        numbers.add(paper_cell(s, stress), seed,
                    {{"peak_q_Pa", peak},
                     {"residual_q_Pa", (1.5e6 * stress + 1e3 * bonded) * noise},
                     {"brittleness", 0.3 + 0.01 * bonded * noise},
                     {"peak_eps1", top},
                     {"top_eps1", top * noise},
                     {"end_of_contraction_eps1", top * noise},
                     {"largest_eps_v", (0.01 * stress + 1e-4 * bonded) * noise},
                     {"dilation", (0.05 - 0.01 * stress + 1e-4 * bonded - 2e-7 * bonded * bonded) * noise},
                     {"q_share_at_6.71", 0.6 * noise},
                     {"residual_slope", 0.001 * noise},
                     {"breakage_place", 0.4 * noise},
                     {"band_breakage_ratio", 5 * noise},
                     {"band_thickening_d50", 2 * noise},
                     {"fabric_growth_2.54", 0.1 * noise},
                     {"fabric_growth_15.04", 0.1 * noise},
                     {"fabric_direction_2.54", noise},
                     {"fabric_direction_15.04", -noise}});
      }
    }
    for (double const h : PaperDesign{}.thicknesses)
      numbers.add(paper_cell(h), seed,
                  {{"peak_q_Pa", (h > 15e-6 ? 5.80e6 : 5.25e6) * noise},
                   {"residual_q_Pa", 1.53e6 * noise},
                   {"dilation", (h > 15e-6 ? 0.0436 : 0.0430) * noise}});
  }
  return numbers;
}

class Files : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder); }
  void TearDown() override { std::filesystem::remove_all(folder); }
  std::filesystem::path const folder =
      std::filesystem::temp_directory_path() / ("clathra_paper_claims_" + std::to_string(::getpid()));
};
class NumbersOfHistory : public Files {};
class LaboratoryPoints : public Files {};

Claim const& claim_of(std::vector<Claim> const& claims, std::string const& id) {
  for (Claim const& claim : claims)
    if (claim.id == id) return claim;
  throw std::out_of_range(id);
}

TEST(PaperClaims, TestsAsThePaperDescribesThemPassAll) {
  std::vector<Claim> const claims = paper_claims({}, obedient_tests(), d50);
  ASSERT_EQ(claims.size(), 17U);
  for (Claim const& claim : claims) {
    if (claim.id == "12") continue;  // its bends depend on the planted thicknesses; below
    for (ClaimPart const& part : claim.parts)
      EXPECT_EQ(part.verdict(), Verdict::pass)
          << claim.id << ": " << part.what << " " << mean_text(part) << " " << bounds_text(part);
  }
  EXPECT_EQ(claim_of(claims, "2").parts.size(), 12U);
  EXPECT_EQ(claim_of(claims, "3").parts.size(), 9U);
  EXPECT_EQ(claim_of(claims, "10").parts.size(), 15U);
}

/// Changes one number of one cell and looks at one claim.
struct Spoilt {
  char const *cell, *number;
  double value;
  char const* claim;
};

TEST(PaperClaims, EachClaimFallsWithItsNumber) {
  for (Spoilt const& spoilt : {Spoilt{"s41_2MPa", "peak_q_Pa", 1e6, "2"},
                               {"s26_3MPa", "peak_q_Pa", 1e6, "3"},
                               {"s55_1MPa", "brittleness", 0.1, "4"},
                               {"s55_2MPa", "residual_q_Pa", 9e6, "5"},
                               {"s41_1MPa", "top_eps1", 0.03, "6"},
                               {"s55_3MPa", "end_of_contraction_eps1", 0.045, "7"},
                               {"s55_3MPa", "residual_slope", -0.06, "7"},
                               {"s26", "peak_cohesion_Pa", -1e5, "8"},
                               {"s55", "peak_friction_angle_deg", 27, "9"},
                               {"s41_3MPa", "dilation", -0.001, "10"},
                               {"s55_1MPa", "largest_eps_v", 0.001, "11a"},
                               {"s55_1MPa", "dilation", 0.001, "11b"},
                               {"s41_1MPa", "breakage_place", 1.2, "13"},
                               {"s55_3MPa", "band_breakage_ratio", 2, "14"},
                               {"s55_3MPa", "fabric_direction_15.04", 25, "15"},
                               {"sand", "peak_friction_angle_deg", 37, "16"}}) {
    PaperNumbers numbers = obedient_tests();
    for (std::uint64_t seed = 1; seed <= 3; ++seed) numbers.add(spoilt.cell, seed, {{spoilt.number, spoilt.value}});
    Verdict const verdict = claim_of(paper_claims({}, numbers, d50), spoilt.claim).verdict();
    EXPECT_TRUE(verdict == Verdict::partial || verdict == Verdict::fail) << spoilt.claim << ": " << name_of(verdict);
  }
}

TEST(PaperClaims, TheSweepWantsAPeakThatRisesEverMoreSlowly) {
  for (double const bend : {-1.0, 1.0}) {
    PaperNumbers numbers;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      auto const test = [&](double h) {
        double const u = h * 1e6 - 12, noise = 1 + 0.001 * static_cast<double>(seed);
        return std::map<std::string, double>{{"peak_q_Pa", (4e6 + 2e5 * u + bend * 1e4 * u * u) * noise},
                                             {"dilation", (0.04 + 1e-3 * u - 2e-5 * u * u) * noise},
                                             {"residual_q_Pa", (1.5e6 + 1e4 * u) * noise}};
      };
      double const of_eq3[] = {3.9403e-6, 10.7746e-6, 14.9054e-6};  // of 26, 41, 55 %
      for (int i = 0; i < 3; ++i)
        numbers.add(paper_cell(PaperDesign{}.saturations[static_cast<std::size_t>(i)], 1), seed, test(of_eq3[i]));
      for (double const h : PaperDesign{}.thicknesses) numbers.add(paper_cell(h), seed, test(h));
    }
    Claim const claim = claim_of(paper_claims({}, numbers, d50), "12");
    EXPECT_EQ(claim.verdict(), bend < 0 ? Verdict::pass : Verdict::partial);
    EXPECT_NEAR(claim.parts[1].mean()->mean, bend * 0.01 * 1.002, 1e-5);  // MPa/um^2
  }
}

TEST(PaperClaims, WithoutTestsNothingIsDecidedButEquation3) {
  for (Claim const& claim : paper_claims({}, {}, d50))
    EXPECT_EQ(claim.verdict(), claim.id == "1" ? Verdict::pass : Verdict::undetermined) << claim.id;
}

TEST(Scorecard, SaysTheSameToPeopleAndPrograms) {
  Scorecard const card{"Title", {{"particles", "20000"}}, paper_claims({}, obedient_tests(), d50)};
  std::string const text = scorecard_markdown(card);
  EXPECT_NE(text.find("| (9) The friction angle has no trend with saturation | pass | 1 of 1 |"), std::string::npos);
  EXPECT_NE(text.find("- particles: 20000\n"), std::string::npos);
  nlohmann::json const json = nlohmann::json::parse(scorecard_json(card));
  ASSERT_EQ(json.at("claims").size(), 17U);
  nlohmann::json const& phi = json.at("claims").at(8).at("parts").at(0);
  EXPECT_EQ(phi.at("low"), -3);
  EXPECT_EQ(phi.at("values").size(), 3U);
  EXPECT_NEAR(phi.at("mean").get<double>(), 0, 1e-12);
  EXPECT_EQ(tally(std::vector<Claim>(3, card.claims[0])), "3 pass, 0 partial, 0 fail, 0 undetermined");
}

TEST_F(NumbersOfHistory, AreThoseOfAPlantedCurve) {
  std::ofstream file(folder / "history.csv");
  file << "step,eps1,eps_v,q_Pa,sigma3_Pa,bonds_intact_pct,broken_rolling\n";
  for (int i = 0; i <= 750; ++i) {
    double const e = 0.1504 * i / 750, after = std::max(0.0, e - 0.03);
    double const q = e < 0.03 ? 8e6 * (1 - std::pow(1 - e / 0.03, 2)) : 4e6 + 4e6 * std::exp(-after / 0.01);
    double const volume = e < 0.03 ? 0.5 * e : 0.015 - 0.3 * after;
    file << i << ',' << e << ',' << volume << ',' << q << ",3e6,50," << 1000 * (1 + std::tanh((e - 0.04) / 0.004)) << '\n';
  }
  file.close();
  std::map<std::string, double> const n = numbers_of_history(HistoryTable(folder / "history.csv"));
  EXPECT_NEAR(n.at("peak_q_Pa"), 8e6, 1e4);
  EXPECT_NEAR(n.at("peak_eps1"), 0.03, 3e-4);
  // 0.98 of the peak: at 0.03 (1 - sqrt(0.02)) and where 4 exp falls by 0.16.
  EXPECT_NEAR(n.at("top_eps1"), (0.03 * (1 - std::sqrt(0.02)) + 0.03 - 0.01 * std::log(0.96)) / 2, 3e-4);
  EXPECT_NEAR(n.at("brittleness"), 0.5, 2e-3);
  EXPECT_NEAR(n.at("end_of_contraction_eps1"), 0.03, 3e-4);
  EXPECT_NEAR(n.at("dilation"), 0.3 * 0.1204, 1e-4);
  EXPECT_NEAR(n.at("q_share_at_6.71"), 0.5 + 0.5 * std::exp(-3.71), 2e-3);
  EXPECT_NEAR(n.at("residual_slope"), 0, 1e-3);
  EXPECT_NEAR(n.at("breakage_place"), 0.01 / (0.01 * std::log(20)), 0.02);
}

TEST_F(LaboratoryPoints, AreReadAsSeriesInSiUnits) {
  auto const path = folder / "points.csv";
  std::ofstream(path) << "# mine\nfigure,name,saturation_pct,confining_stress_MPa,x,y\nq,test 1,26,1,0.5,1.2\nq,test 1,26,1,1,2\n"
                         "phi,angles,,,26,30.5\n";
  LaboratoryData const data = read_laboratory_data(path);
  ASSERT_EQ(data.series.size(), 2U);
  EXPECT_EQ(data.series[0].x, (std::vector<double>{0.005, 0.01}));
  EXPECT_EQ(data.series[0].y, (std::vector<double>{1.2e6, 2e6}));
  EXPECT_EQ(data.series[0].confining_stress, 1e6);
  EXPECT_EQ(data.series[1].x, (std::vector<double>{26}));
  EXPECT_EQ(data.series[1].y, (std::vector<double>{30.5}));
}

TEST_F(LaboratoryPoints, MistakesAreNamedWithTheirLine) {
  auto const path = folder / "points.csv";
  std::string const head = "figure,name,saturation_pct,confining_stress_MPa,x,y\n";
  auto const message = [&](std::string const& text) -> std::string {
    std::ofstream(path) << text;
    try {
      (void)read_laboratory_data(path);
    } catch (FileProblem const& problem) {
      return problem.what();
    }
    return "no problem";
  };
  EXPECT_NE(message("a,b\n").find("line 1 must be the header"), std::string::npos);
  EXPECT_NE(message(head + "q,a,26,1,1,1\nq,a,26,1,x,1\n").find("line 3: column 'x' must be a number, got 'x'"),
            std::string::npos);
  EXPECT_NE(message(head + "tau,a,26,1,1,1\n").find("line 2: column 'figure' must be q, eps_v, c or phi, got 'tau'"),
            std::string::npos);
  EXPECT_NE(message(head + "q,a,126,1,1,1\n").find("column 'saturation_pct' must lie between 0 and 100, got 126"),
            std::string::npos);
  EXPECT_NE(message(head + "q,a,26\n").find("line 2: has 3 cells, not 6"), std::string::npos);
  EXPECT_NE(message(head).find("holds no points"), std::string::npos);
}

}  // namespace
}  // namespace clathra
