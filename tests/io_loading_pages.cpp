/// What pages draw of stress increments of all directions, and of specimens that fail while their hydrate changes.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "io/report/response_envelope.hpp"
#include "io/report/sand_strength.hpp"
#include "report_runs.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

class LoadingPages : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  /// A run whose history has the rows of a text.
  RunResults run_of(std::string const& name, nlohmann::json record, std::string const& rows) const {
    std::ofstream(folder_ / name) << rows;
    return {name, folder_, HistoryTable(folder_ / name), std::move(record), {}};
  }
  /// Strained by one increment of the stresses, with a stiffness of its own for either direction.
  RunResults increment(int degrees, int seed, double stiffness) const {
    double const angle = degrees * std::numbers::pi / 180, sigma1 = 1e4 * std::cos(angle), sigma3 = 1e4 * std::sin(angle);
    nlohmann::json const stage = {{"start_sigma1_Pa", 1e6},
                                  {"end_sigma1_Pa", 1e6 + sigma1},
                                  {"start_sigma3_Pa", 1e6},
                                  {"end_sigma3_Pa", 1e6 + sigma3},
                                  {"strain_eps1", sigma1 / stiffness},
                                  {"strain_eps_v", sigma1 / stiffness + sigma3 / (2 * stiffness)}};
    return run_of("increment",
                  {{"scene", {{"run", {{"seed", seed}}}}},
                   {"loading", {{{"stage", "increment"}, {"ended_by", "rest"}}}},
                   {"stages", {{"increment", stage}}}},
                  "step,eps1,q_Pa\n0,0,0\n1,0,0\n");
  }
  static std::string rows_of_change() {
    return "stage,step,eps1,eps_v,sigma1_Pa,sigma3_Pa,q_Pa,p_Pa,temperature_degC,pore_pressure_Pa,saturation_pct\n"
           "load,0,0,0,1e6,1e6,0,1e6,5,8e6,41\nwarming,1,0,0,1e6,1e6,0,1e6,5,8e6,41\nwarming,2,0,0,5e6,4e6,1e6,4.5e6,5,8e6,41\n"
           "warming,3,0.01,0,4e6,3e6,1e6,3.5e6,8,8e6,30\nwarming,4,0.02,0,3e6,2e6,1e6,2.5e6,9,8e6,22\n"
           "shear,5,0.02,0,2e6,1e6,1e6,1.5e6,9,8e6,22\nshear,6,0.03,0,9e6,1e6,8e6,5e6,9,8e6,22\n";
  }
  static ShownRuns shown(std::vector<RunResults> const& runs, LaboratoryOverlay& data) {
    return {runs, data, [&runs](std::size_t i) { return Curve{runs[i].name, {}, {}, {}}; }};
  }
  static std::string csv_of(Piece const& piece) { return piece.figures.empty() ? "" : csv_file(piece.figures.front()); }

  fs::path const folder_ = fs::temp_directory_path() / ("clathra_loading_pages_" + std::to_string(::getpid()));
};

TEST_F(LoadingPages, DrawAClosedEnvelopeForEachSeedInTheOrderOfTheDirections) {
  std::vector<RunResults> runs;
  for (int const degrees : {180, 0, 90, 300, 45, 250}) {
    runs.push_back(increment(degrees, 1, 1e8));
    if (degrees != 45) runs.push_back(increment(degrees, 2, 1e8));  // five are too few
  }
  LaboratoryOverlay none;
  std::string const csv = csv_of(response_envelopes(shown(runs, none)));
  EXPECT_EQ(csv.find("seed 2"), std::string::npos);
  std::vector<double> axial, lateral;
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::istringstream cells(line.substr(line.find(',') + 1));
    double x = 0, y = 0;
    char comma = 0;
    cells >> x >> comma >> y;
    lateral.push_back(x);
    axial.push_back(y);
  }
  ASSERT_EQ(axial.size(), 7u) << csv;
  EXPECT_EQ(axial.front(), axial.back()) << "closed";
  double turned = 0;  // round the origin, once
  for (std::size_t i = 1; i < axial.size(); ++i) {
    double const step =
        std::remainder(std::atan2(2 * lateral[i], axial[i]) - std::atan2(2 * lateral[i - 1], axial[i - 1]), 2 * std::numbers::pi);
    EXPECT_GT(step, 0) << i;
    turned += step;
  }
  EXPECT_NEAR(turned, 2 * std::numbers::pi, 1e-6);
  EXPECT_NEAR(*std::max_element(axial.begin(), axial.end()), 1e-4, 1e-9);
}

TEST_F(LoadingPages, DrawNoEnvelopeOfOtherTests) {
  std::vector<RunResults> runs;
  for (int degrees = 0; degrees < 360; degrees += 40) {
    runs.push_back(increment(degrees, 1, 1e8));
    runs.back().record["loading"][0]["ended_by"] = "axial strain";
  }
  LaboratoryOverlay none;
  EXPECT_TRUE(response_envelopes(shown(runs, none)).empty());
}

/// sigma_3* = (q - 2 c sqrt(N)) / (N - 1): 1.84 MPa for 3.8 MPa, 29.3 deg and 0.08 MPa.
TEST(SandStrength, SaysWhereItBearsALoadNoMore) {
  SandStrength const sand{0.08e6, 29.3 * std::numbers::pi / 180};
  double const lateral = sand.lateral_stress(3.8e6);
  EXPECT_NEAR(lateral, 1.84e6, 0.005e6);
  EXPECT_NEAR(sand.deviator_at_mean(lateral + 3.8e6 / 2), 3.8e6, 1) << "the same line in q and p";
}

TEST_F(LoadingPages, SayWhereSpecimensFailBesideWhatTheSandBears) {
  nlohmann::json failed = {{"loading", {{{"stage", "warming"}, {"ended_by", "failed"}}}},
                           {"stages", {{"warming", {{"failed_p_Pa", 2.9e6}, {"failed_q_Pa", 1e6}, {"failed_eps1", 0.015}}}}}};
  nlohmann::json const stood = {{"loading", {{{"stage", "warming"}, {"ended_by", "rest"}}}},
                                {"stages", {{"warming", {{"failed", 0}}}}}};
  nlohmann::json cut = stood;
  cut["loading"][0]["ended_by"] = "axial strain";
  std::vector<RunResults> const runs = {run_of("fallen", failed, rows_of_change()), run_of("standing", stood, rows_of_change()),
                                        run_of("cut off", cut, rows_of_change())};
  LaboratoryOverlay none;
  SandStrength const sand{0, std::numbers::pi / 6};  // N = 3
  std::string const table = failure_table(shown(runs, none), sand).html;
  for (std::string const row :
       {"<td>fallen</td><td>1</td><td>0.5</td><td>1 of 1</td><td>3</td><td>2.4</td><td>0 of 1</td><td>–</td>",
        "<td>standing</td><td>1</td><td>0.5</td><td>0 of 1</td><td>–</td><td>–</td><td>1 of 1</td><td>2</td>",
        "<td>cut off</td><td>1</td><td>0.5</td><td>0 of 1</td><td>–</td><td>–</td><td>0 of 1</td><td>–</td>"})
    EXPECT_NE(table.find(row), std::string::npos) << row << table;
  std::string const csv = csv_of(failure_figure(shown(runs, none), sand));
  EXPECT_NE(csv.find("failed here,2900000,1000000"), std::string::npos) << csv;
  EXPECT_NE(csv.find("strength of the clean sand,0,0"), std::string::npos) << csv;
  EXPECT_EQ(csv.find("nan"), std::string::npos);
  EXPECT_EQ(csv_of(failure_figure(shown(runs, none), {})).find("strength of the clean sand"), std::string::npos);
}

}  // namespace
}  // namespace clathra
