/// Points of a laboratory: read from their file, laid over the figures of pages.
#include <gtest/gtest.h>

#include <fstream>

#include "command.hpp"
#include "io/errors/problems.hpp"
#include "io/report/laboratory_overlay.hpp"
#include "io/results/laboratory_data.hpp"
#include "report_page.hpp"

namespace clathra {
namespace {

constexpr char head[] = "figure,name,strain,saturation_pct,confining_stress_MPa,x,y\n";

class LaboratoryPoints : public ReportPageTest {
 protected:
  LaboratoryData read(std::string const& text) const {
    auto const path = folder / "points.csv";
    std::ofstream(path) << text;
    return read_laboratory_data(path);
  }
  std::string message(std::string const& text) const {
    try {
      (void)read(text);
    } catch (FileProblem const& problem) {
      return problem.what();
    }
    return "no problem";
  }
  void expect_message(std::string const& text, std::string const& words) const {
    EXPECT_NE(message(text).find(words), std::string::npos) << message(text);
  }
};

TEST_F(LaboratoryPoints, AreReadAsSeriesInSiUnits) {
  LaboratoryData const data = read(std::string("# mine\n") + head +
                                   "q,test 1,natural,26,1,0.5,1.2\nq,test 1,natural,26,1,1,2\nphi,angles,,,,26,30.5\n"
                                   "stress_path,test 1,,26,,1,0.5\n");
  ASSERT_EQ(data.series.size(), 3U);
  EXPECT_EQ(data.series[0].x, (std::vector<double>{0.005, 0.01}));
  EXPECT_EQ(data.series[0].y, (std::vector<double>{1.2e6, 2e6}));
  EXPECT_EQ(data.series[0].confining_stress, 1e6);
  EXPECT_EQ(data.series[1].x, (std::vector<double>{26}));
  EXPECT_EQ(data.series[1].y, (std::vector<double>{30.5}));
  EXPECT_FALSE(data.series[2].confining_stress);
  EXPECT_EQ(data.series[2].x, (std::vector<double>{1e6}));
}

/// An axial strain of 15 % is a natural one of 16.25 %, a volumetric one of -10 % one of -9.53 %.
TEST_F(LaboratoryPoints, OfEngineeringStrainBecomeNatural) {
  LaboratoryData const data =
      read(std::string(head) + "q,a,engineering,,,15,1\neps_v,a,engineering,,,15,-10\neps_v,b,natural,,,15,-10\n");
  EXPECT_NEAR(data.series[0].x[0], 0.16251893, 1e-8);
  EXPECT_NEAR(data.series[1].x[0], 0.16251893, 1e-8);
  EXPECT_NEAR(data.series[1].y[0], -0.09531018, 1e-8);
  EXPECT_NEAR(data.series[2].y[0], -0.1, 1e-15);
}

TEST_F(LaboratoryPoints, MistakesAreNamedWithTheirLine) {
  expect_message("a,b\n", "line 1 must be the header");
  std::string const h = head;
  expect_message(h + "q,a,natural,26,1,1,1\nq,a,natural,26,1,x,1\n", "line 3: column 'x' must be a number, got 'x'");
  expect_message(h + "tau,a,,26,1,1,1\n", "line 2: column 'figure' must be one of q, eps_v, pore_pressure");
  expect_message(h + "q,a,natural,126,1,1,1\n", "column 'saturation_pct' must lie between 0 and 100, got 126");
  expect_message(h + "q,a,,26,1,1,1\n", "column 'strain' must be natural or engineering, got ''");
  expect_message(h + "stress_path,a,natural,26,1,1,1\n", "column 'strain' must be empty for a figure without strains");
  expect_message(h + "q,a,engineering,26,1,100,1\n", "column 'x' must lie below 100 for an engineering strain, got 100");
  expect_message(h + "phi,a,,26,,26,30\n", "must be empty for phi");
  expect_message(h + "q,a,26\n", "line 2: has 3 cells, not 7");
  expect_message(h, "holds no points");
}

TEST_F(LaboratoryPoints, BelongToTestsOfTheirSaturationAndStress) {
  LaboratoryOverlay overlay(
      read(std::string(head) + "q,here,natural,41,1,1,2\nq,elsewhere,natural,55,1,1,2\nq,any,natural,,,1,2\n"
                               "q,other stress,natural,41,3,1,2\nlateral_stress,undrawn,,,,1,2\n"),
      {{41.2, 1.02e6}});
  std::vector<std::string> names;
  for (Curve const& curve : overlay.over(axial_strain, {"q", "q_Pa", 1e-6})) names.push_back(curve.name);
  EXPECT_EQ(names, (std::vector<std::string>{"here", "any"}));
  std::string const note = overlay.note();
  EXPECT_NE(note.find("elsewhere (q, of another saturation or confining stress)"), std::string::npos) << note;
  EXPECT_NE(note.find("undrawn (lateral_stress, for which there is no figure)"), std::string::npos) << note;
  EXPECT_EQ(note.find("any (q"), std::string::npos) << note;
}

TEST_F(LaboratoryPoints, LieInTheFiguresOfAReport) {
  LaboratoryData const data =
      read(std::string(head) + "q,my triaxial test,natural,,,1,2\nq,my triaxial test,natural,,,2,3.5\nphi,b,,,,41,30\n");
  write_report({made("run")}, folder / "report.html", data);
  std::string const page = content_of(folder / "report.html");
  auto const curves = curves_of(page, "Deviator stress against axial strain");
  ASSERT_EQ(curves.size(), 2u);
  ASSERT_EQ(curves[1].size(), 2u);
  EXPECT_NEAR(curves[1][0].first, 1, 0.02);
  EXPECT_NEAR(curves[1][0].second, 2, 0.02);
  EXPECT_NEAR(curves[1][1].second, 3.5, 0.02);
  EXPECT_NE(page.find("</svg>my triaxial test</li>"), std::string::npos) << "in the legend";
  EXPECT_NE(page.find("no figure shows: b (phi"), std::string::npos);
  EXPECT_EQ(page_on({folder / "run"}).find("my triaxial test"), std::string::npos);
}

/// Also of tests that are not one compression, which have no bands over the axial strain alone.
TEST_F(LaboratoryPoints, LieOnThePageOfAStudy) {
  std::ofstream(folder / "base.toml") << "[specimen]\nparticles = 100\nvoid_ratio = 0.28\ncompaction_layers = 1\n"
                                         "[test]\nkind = \"constant_volume\"\naxial_strain = \"0.4 %\"\n[output]\nrecords = 10\n";
  std::ofstream(folder / "many.toml") << "scene = \"base.toml\"\nseeds = 2\n[matrix]\n"
                                         "test.confining_stress = [\"1 MPa\", \"2 MPa\"]\n";
  fs::path const out = folder / "out";
  std::ofstream(folder / "points.csv") << "figure,name,strain,saturation_pct,confining_stress_MPa,x,y\n"
                                          "stress_path,my undrained test,,,2,1.5,0.5\nstress_path,my undrained test,,,2,1.6,0.7\n"
                                          "q,of another stress,natural,,5,1,2\n";
  CommandResult const result = run_clathra("study '" + (folder / "many.toml").string() + "' --output '" + out.string() +
                                           "' --data '" + (folder / "points.csv").string() + "'");
  ASSERT_EQ(result.code, 0) << result.output;
  std::string const page = content_of(out / "study.html");
  std::string const plot = page.substr(page.find("<title>Deviator stress against mean stress"));
  std::string const drawn = plot.substr(0, plot.find("</figure>"));
  std::size_t lines = 0;
  for (std::size_t at = drawn.find("<polyline"); at != drawn.npos; at = drawn.find("<polyline", at + 1)) ++lines;
  EXPECT_GE(lines, 5u) << "four members and the points";
  EXPECT_EQ(drawn.find("</svg>1MPa</li>"), drawn.rfind("</svg>1MPa</li>")) << "one entry for both seeds";
  EXPECT_NE(drawn.find("</svg>my undrained test</li>"), std::string::npos);
  EXPECT_NE(page.find("no figure shows: of another stress (q, of another"), std::string::npos);
}

}  // namespace
}  // namespace clathra
